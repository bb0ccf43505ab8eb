#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/math/random.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Stacks of the same materials and structure, each asked at all the angles.
struct ColorFamily {
    std::vector<Stack> variants;  ///< they differ in their thicknesses
    std::vector<double> angles_deg;
};

/// Colours to compare methods with.
struct ColorCase {
    std::string_view name;     ///< one word
    std::string_view summary;  ///< what is asked, one line
    bool is_set;               ///< of random stacks, each a family of one stack and one angle
    ColorFamily (*make)(Random& random);
};

/// Published cases, batches and random sets, in the order in which they are reported.
std::span<const ColorCase> color_cases();

/// One family; of a set `count` ones, number i made from the seed + i.
std::vector<ColorFamily> color_families(const ColorCase& of, std::uint64_t count,
                                        std::uint64_t seed);

}  // namespace irido
