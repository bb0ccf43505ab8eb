#include "tests/support/simd_levels.hpp"

#include <catch2/catch.hpp>

namespace irido {

std::string lacking_levels(bool (*has)(SimdLevel)) {
    std::string names;
    for (const SimdLevel level : kSimdLevels)
        if (!has(level)) names += (names.empty() ? "" : ", ") + std::string(name_of(level));
    return names.empty() ? "" : "not run: " + names + " (instructions that this machine lacks)";
}

std::vector<SimdLevel> tested_levels() {
    static std::string last;
    const std::string test = Catch::getResultCapture().getCurrentTestName();
    const std::string lacking = lacking_levels(is_available);
    if (!lacking.empty() && test != last) WARN(lacking);
    last = test;
    std::vector<SimdLevel> levels;
    for (const SimdLevel level : kSimdLevels)
        if (is_available(level)) levels.push_back(level);
    return levels;
}

std::vector<SimdLevel> tested_vector_levels() {
    std::vector<SimdLevel> levels = tested_levels();
    std::erase(levels, SimdLevel::plain);
    return levels;
}

}  // namespace irido
