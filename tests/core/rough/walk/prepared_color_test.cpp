#include "core/rough/walk/prepared_color.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/layered_color.hpp"
#include "tests/support/sample_surfaces.hpp"

using namespace irido;
using namespace irido::test;
using Catch::Matchers::WithinAbs;

namespace {

PreparedColor::Direction direction(double theta_deg, double phi_deg) {
    const double theta = theta_deg * kDegree, phi = phi_deg * kDegree;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

TEST_CASE("prepared colours are near exact ones", "[rough][layered]") {
    const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    std::vector<ScatterPair> pairs;
    for (const double i : {0.0, 35.0, 80.0})
        for (const double o : {0.0, 30.0, 36.0, 70.0, 88.0})
            for (const double phi : {180.0, 60.0}) pairs.push_back({i, o, phi});
    for (const char* json :
         {R"({"layers": [{"stack": "1 | (1@250 | 1.5@250)^10 | 1", "alpha": 0.1}],
              "base": {"albedo": 0.5}})",
          R"({"layers": [{"stack": "1 | 1.5@400 | 0.2+3i", "alpha": 0.3}]})"}) {
        const LayeredSurface surface = surface_of(json);
        const PreparedColor prepared(tables, surface, Paths::all, Crossings::single, Execution(1));
        const auto exact = LayeredColor(tables, surface, Crossings::single, 1e-4, Execution(0))
                               .brdf(pairs, Paths::all);
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const Triple xyz = prepared(direction(pairs[p].theta_i_deg, 0),
                                        direction(pairs[p].theta_o_deg, pairs[p].phi_deg));
            for (std::size_t c = 0; c < 3; ++c)
                CHECK_THAT(kPi * xyz[c],
                           WithinAbs(exact[p].xyz[c], 4e-4 * std::max(1.0, exact[p].xyz[c])));
        }
    }
    CHECK_THROWS_AS(PreparedColor(tables, surface_of(R"({"inside": 1.5, "base": {"albedo": 0.5}})"),
                                  Paths::all, Crossings::single, Execution(1)),
                    DomainError);
}
