#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/color/quadrature/panel_tree.hpp"

namespace irido {

/// Indices of a stack at points of its panels: memory for colours of any stacks.
class PointIndices {
public:
    /// At the points of several parts, one after the other.
    ///   constant  of a stack whose indices are constant; nullptr if every part has indices
    const IndexTable& at(std::span<const SpectralPoints* const> parts, const IndexTable* constant);

    /// At points with which many colours begin.
    ///   owner  number of the stack, of which there may be no other with this number
    const IndexTable& at_first(const SpectralPoints& first, const IndexTable* constant,
                               std::size_t owner);

private:
    static const IndexTable& assign(std::optional<IndexTable>& table, const IndexTable& constant,
                                    std::span<const std::vector<double>* const> wavelengths);

    std::optional<IndexTable> first_, several_;
    const SpectralPoints* first_points_ = nullptr;  ///< of first_, and its owner
    std::size_t first_owner_ = 0;
    std::vector<const IndexTable*> tables_;
    std::vector<const std::vector<double>*> wavelengths_;
};

}  // namespace irido
