#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// Limit of a layer's thickness, and of the standard deviation of a thickness distribution.
inline constexpr double kLargestThickness_nm = 1e9;
/// Limit of a group's repeat count.
inline constexpr std::uint64_t kMostRepeats = 1'000'000'000;

/// One homogeneous plane layer.
struct Layer {
    std::size_t material = 0;       ///< index into Stack::materials
    double thickness_nm = 0;        ///< [0, 1e9]
    double thickness_sigma_nm = 0;  ///< standard deviation of a Gaussian thickness distribution,
                                    ///< [0, 1e9]
    bool coherent = true;           ///< false: powers, not amplitudes, add across it
    std::uint32_t part = 0;  ///< 1, 2, ... from the top for the slices of one layer, which are
                             ///< listed as one layer; else 0
    bool operator==(const Layer&) const = default;
};

struct Element;

/// Layers repeated as a unit, from the incident side to the substrate.
struct Group {
    std::uint64_t repeat = 1;  ///< [1, 1e9]
    std::vector<Element> elements;
    bool operator==(const Group&) const = default;
};

/// Position of a layer: indices into nested elements, from the outermost to the layer itself.
using LayerPlace = std::vector<std::size_t>;

struct Element {
    std::variant<Layer, Group> value;
    bool operator==(const Element&) const = default;
};

/// A stack of films between two half-spaces, as plain values. Equal materials are stored once.
struct Stack {
    std::vector<Material> materials;
    std::size_t incident = 0;       ///< index into materials; must be real
    std::vector<Element> elements;  ///< from the incident side to the substrate
    std::size_t substrate = 0;      ///< index into materials
    bool operator==(const Stack&) const = default;
};

}  // namespace irido
