#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "schemas/stack_document.hpp"

namespace irido {

/// A stack some of whose numbers vary, each named by its dotted path in the document
/// ("layers.0.thickness_nm").
class VariedStack {
public:
    /// Throws InputError if a path names no number of the stack.
    VariedStack(StackSource source, std::vector<std::string> paths);

    /// The stack with those values, one for each path. Throws InputError if it cannot be.
    /// Safe from many threads.
    Stack at(std::span<const double> values) const;

    /// True if all paths are thicknesses: materials and structure are then always the same.
    bool varies_thickness_only() const { return places_.size() == paths_.size(); }

private:
    StackSource source_;
    std::vector<std::string> paths_;
    Stack stack_;  ///< with the document's own values
    /// Indices of elements from the outermost to a layer, one for each path that is a thickness.
    std::vector<std::vector<std::size_t>> places_;
};

}  // namespace irido
