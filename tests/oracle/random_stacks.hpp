#pragma once

#include <cstdint>
#include <string_view>

#include "core/complex.hpp"
#include "core/stack/stack.hpp"

namespace irido::oracle {

/// Numbers that are the same on every machine (splitmix64).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits();
    double uniform(double from, double to);
    std::size_t below(std::size_t count);

private:
    std::uint64_t state_;
};

/// A stack that is written down layer by layer.
class StackBuilder {
public:
    explicit StackBuilder(Complex incident = 1);
    std::size_t material(Complex index);
    std::size_t material(Material material);
    Element layer(Complex index, double thickness_nm);
    Element layer_of(std::size_t material, double thickness_nm);
    static Element group(std::uint64_t repeat, std::vector<Element> elements);
    void add(Element element) { stack_.elements.push_back(std::move(element)); }
    Stack over(Complex substrate);
    Stack over_material(std::size_t substrate);

private:
    Stack stack_;
};

enum class Kind {
    film,             ///< one dielectric film on a dielectric
    film_on_metal,    ///< one or two dielectric films on a metal of constant index
    multilayer,       ///< 2 to 9 films, some of them absorbing
    tabulated_metal,  ///< films on a metal of the library
    kinked_table,     ///< a film with a coarse table of n and k
    bragg,            ///< two-layer periods, 2 to 30 of them
    thick_film,       ///< 2 to 20 um
    metal_cavity,     ///< a dielectric between two thin metals
};
inline constexpr std::size_t kKinds = 8;
std::string_view name_of(Kind kind);

Stack random_stack(Kind kind, Random& random);

/// 0 to 89, every fifth above 75.
double random_angle(Random& random);

/// One line that says it all, for messages.
std::string text_of(const Stack& stack);

}  // namespace irido::oracle
