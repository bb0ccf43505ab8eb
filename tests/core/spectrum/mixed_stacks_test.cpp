// Stacks that combine everything: coherent and incoherent layers, thickness distributions, groups
// and nested groups, metals, gaps past their critical angles.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "core/spectrum/spectrum.hpp"
#include "tests/oracle/random_stacks.hpp"
#include "tests/support/simd_levels.hpp"

using namespace irido;
using oracle::StackBuilder;

namespace {

/// IRIDO_TEST_MIXED=10000 selects the long run, which takes minutes.
std::size_t stacks_to_try() {
    const char* const text = std::getenv("IRIDO_TEST_MIXED");
    return text ? std::strtoull(text, nullptr, 10) : 400;
}

struct Question {
    Stack stack;
    double wavelength_nm, angle_deg;
};

/// Adds elements to a stack; at most one of its layers has a thickness distribution.
class Mixer {
public:
    explicit Mixer(Random& random)
        : random_(random), stack_(random.one_in(2) ? 1 : random.uniform(1.2, 2.8)) {}

    Question question() {
        for (std::size_t left = 2 + random_.below(4); left > 0; --left) stack_.add(element());
        const Complex below = random_.one_in(3) ? metal() : Complex(random_.uniform(1, 2.5));
        const double angle = random_.one_in(4) ? 0 : random_.uniform(0, 89);
        return {stack_.over(below), random_.uniform(350, 900), angle};
    }

private:
    Complex metal() {
        const double n = random_.uniform(0.1, 3);
        return {n, random_.uniform(1.5, 6)};
    }

    Element film() {
        if (random_.one_in(8)) return stack_.layer(metal(), random_.uniform(1, 30));
        const double k = random_.one_in(3) ? random_.log_uniform(1e-9, 0.1) : 0;
        return stack_.layer({random_.uniform(1, 2.7), k}, random_.log_uniform(1, 1500));
    }

    Element plate() {
        const double k = random_.one_in(2) ? random_.log_uniform(1e-12, 1e-5) : 0;
        const Complex index{random_.uniform(1.3, 2.5), k};
        return oracle::incoherent(stack_.layer(index, random_.log_uniform(1e4, 1e7)));
    }

    Element spread() {
        spread_ = true;
        const double nm = random_.uniform(20, 1000);
        const Complex index{random_.uniform(1.3, 2.5), random_.one_in(2) ? 0.01 : 0};
        return oracle::spread(stack_.layer(index, nm), nm * random_.log_uniform(1e-3, 0.3));
    }

    Element group() {
        const Element inner = random_.one_in(3)
                                  ? StackBuilder::group(2 + random_.below(5), {film(), film()})
                                  : film();
        return StackBuilder::group(2 + random_.below(12), {film(), inner});
    }

    Element element() {
        switch (random_.below(8)) {
            case 0:
                return plate();
            case 1:
            case 2:
                return group();
            case 3:
                return StackBuilder::group(1 + random_.below(3), {film(), plate()});
            case 4:
                return spread_ ? film() : spread();
            default:
                return film();
        }
    }

    Random& random_;
    StackBuilder stack_;
    bool spread_ = false;
};

Spectra answer(const Question& question, SimdLevel level) {
    const IndexTable table(question.stack, {question.wavelength_nm});
    const IncidentAngle at = incident_angle(question.angle_deg);
    return spectra(StackPower(question.stack), table, std::span(&at, 1), {}, {1, level});
}

}  // namespace

TEST_CASE("mixed stacks keep energy, and all levels agree", "[levels]") {
    Random random(171);
    double off = 0, lowest = 0, apart = 0;
    const std::size_t stacks = stacks_to_try();
    for (std::size_t i = 0; i < stacks; ++i) {
        const Question question = Mixer(random).question();
        const Spectra plain = answer(question, SimdLevel::plain);
        for (const SimdLevel level : tested_levels()) {
            const Spectra at = answer(question, level);
            for (const auto polarization : {&Spectra::s, &Spectra::p}) {
                const Power power = (at.*polarization).power(0);
                const Power expected = (plain.*polarization).power(0);
                const double sum = std::abs(power.R + power.T + power.A - 1);
                const double low = std::min({power.R, power.T, power.A});
                const double differs =
                    std::max(std::abs(power.R - expected.R), std::abs(power.T - expected.T));
                off = std::max(off, sum);
                lowest = std::min(lowest, low);
                apart = std::max(apart, differs);
                // resonances of up to 100 layers amplify rounding errors that much
                if (low >= 0 && sum < 1e-12 && differs < 1e-9) continue;
                CAPTURE(i, oracle::text_of(question.stack), question.wavelength_nm,
                        question.angle_deg, name_of(level), expected.R, expected.T);
                FAIL_CHECK(power.R << " " << power.T << " " << power.A);
            }
        }
    }
    if (stacks > 1000)
        WARN("R + T + A off by " << off << ", lowest " << lowest << ", levels apart by " << apart);
}
