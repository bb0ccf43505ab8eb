#include "core/math/simplex_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace irido;
using Catch::WithinAbs;

TEST_CASE("simplices descend to minima inside the cube and on its faces", "[math]") {
    const auto valley = [](std::span<const double> x) {  // Rosenbrock's function, at 0.3, 0.09
        const double a = x[0] - 0.3, b = x[1] - x[0] * x[0];
        return a * a + 100 * b * b;
    };
    const SimplexMinimum inside = simplex_search(valley, {0.9, 0.1}, 0.1, 4000);
    CHECK_THAT(inside.x[0], WithinAbs(0.3, 1e-3));
    CHECK_THAT(inside.x[1], WithinAbs(0.09, 1e-3));
    CHECK(inside.value < 1e-6);

    const auto beyond = [](std::span<const double> x) {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            sum += std::abs(x[i] - (i % 2 == 0 ? 1.5 : 0.25));
        return sum;
    };
    const SimplexMinimum face = simplex_search(beyond, {0.5, 0.5, 0.5}, 0.2, 4000);
    CHECK_THAT(face.x[0], WithinAbs(1, 1e-6));
    CHECK_THAT(face.x[1], WithinAbs(0.25, 1e-3));
    CHECK_THAT(face.x[2], WithinAbs(1, 1e-6));

    const auto line = [](std::span<const double> x) { return std::cosh(x[0] - 0.7); };
    CHECK_THAT(simplex_search(line, {0.0}, 0.5, 300).x[0], WithinAbs(0.7, 1e-3));
}

TEST_CASE("simplices keep to their budget and to the cube", "[math]") {
    std::size_t calls = 0;
    const auto count = [&](std::span<const double> x) {
        ++calls;
        for (const double value : x) CHECK((value >= 0 && value <= 1));
        return std::sin(40 * x[0]) + std::cos(30 * x[1]);
    };
    const SimplexMinimum found = simplex_search(count, {1, 0}, 0.3, 200);
    CHECK(calls <= 200);
    CHECK(found.value <= std::sin(40.0) + 1);
}
