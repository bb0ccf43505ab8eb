// Compares the instruction sets with each other in every regime: an error in only one of them shows
// here.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/truth/stability.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;

namespace {

/// Smaller differences are not examined.
constexpr double kSame = 1e-12;

/// IRIDO_TEST_LEVELS=100000 selects the long run.
std::uint64_t stacks_of(const Regime& regime) {
    const char* wanted = std::getenv("IRIDO_TEST_LEVELS");
    const std::uint64_t count = wanted ? std::strtoull(wanted, nullptr, 10) : 60;
    return regime.name == "thousand_layers" ? 1 + count / 100 : count;
}

/// {s, p} at one level; nothing at a laser threshold.
std::vector<Power> powers(const StackCase& c, SimdLevel level) {
    const IndexTable table(c.stack, std::vector<double>{c.wavelength_nm});
    const IncidentAngle angle = incident_angle(c.angle_deg);
    try {
        const Spectra at =
            spectra(StackPower(c.stack), table, std::span(&angle, 1), {}, {1, level});
        return {at.s.power(0), at.p.power(0)};
    } catch (const DomainError&) {
        return {};
    }
}

bool agree(const std::vector<Power>& a, const std::vector<Power>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double scale = std::max(1.0, a[i].R);
        if (!(std::abs(a[i].R - b[i].R) <= kSame * scale)) return false;
        if (!(std::abs(a[i].T - b[i].T) <= kSame * std::max(1.0, std::abs(a[i].T)))) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("levels that differ are within the bounds of the question, in every regime",
          "[stability][slow]") {
    const std::vector<SimdLevel> levels = tested_levels();
    for (const Regime& regime : regimes()) {
        std::uint64_t differ = 0, wrong = 0, first = 0;
        for (std::uint64_t i = 0; i < stacks_of(regime); ++i) {
            const std::uint64_t seed = 1000000 + i;
            const StackCase c = stability_case(regime, seed);
            const std::vector<Power> plain = powers(c, levels.front());
            bool same = true;
            for (const SimdLevel level : levels) same = same && agree(plain, powers(c, level));
            if (same) continue;
            ++differ;
            bool right = true;
            for (const SimdLevel level : levels)
                right = right && stability_violation(c, regime.passive, level).empty();
            if (!right && wrong++ == 0) first = seed;
        }
        if (std::getenv("IRIDO_TEST_LEVELS"))
            WARN(regime.name << ": " << differ << " differ by more than 1e-12, " << wrong
                             << " of them beyond their bound; the first is seed " << first);
        CAPTURE(regime.name, differ, first);
        CHECK(wrong == 0);
    }
}
