#pragma once

#include <utility>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Builds a stack layer by layer, from the incident side to the substrate.
class StackBuilder {
public:
    explicit StackBuilder(Complex incident = 1);

    /// Index of the material in Stack::materials; equal materials are stored once.
    std::size_t material(Complex index);
    std::size_t material(Material material);

    Element layer(Complex index, double thickness_nm);
    static Element layer_of(std::size_t material, double thickness_nm);
    static Element group(std::uint64_t repeat, std::vector<Element> elements);

    void add(Element element) { stack_.elements.push_back(std::move(element)); }
    Stack over(Complex substrate);
    Stack over_material(std::size_t substrate);

private:
    Stack stack_;
};

}  // namespace irido
