#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/math/random.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// Stacks of the same materials and structure, all evaluated at all the angles.
struct ColorFamily {
    std::vector<Stack> variants;  ///< differ in thickness only
    std::vector<double> angles_deg;
};

/// One test case for comparing colour methods.
struct ColorCase {
    std::string_view name;     ///< one word
    std::string_view summary;  ///< what it tests, one line
    bool is_set;               ///< random stacks, each a family of one stack and one angle
    ColorFamily (*make)(Random& random);
};

/// Published cases, batches and random sets, in reporting order.
std::span<const ColorCase> color_cases();

/// The families of a case: one, or for a set `count` of them, number i made from seed + i.
std::vector<ColorFamily> color_families(const ColorCase& of, std::uint64_t count,
                                        std::uint64_t seed);

}  // namespace irido
