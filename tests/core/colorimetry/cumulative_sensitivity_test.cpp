#include "core/colorimetry/cumulative_sensitivity.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/random.hpp"

using namespace irido;

TEST_CASE("cumulative integrals are those of the sensitivity", "[cumulative]") {
    Random random(1);
    for (const auto light : illuminant_names()) {
        const Sensitivity sensitivity(observer(10), illuminant(light));
        const CumulativeSensitivity cumulative(sensitivity);
        const WavelengthRange support = sensitivity.support();
        CHECK(largest_difference(cumulative(support.last_nm), sensitivity.white()) < 1e-15);
        CHECK(largest_difference(cumulative(support.last_nm - 1e-9), sensitivity.white()) < 1e-12);
        CHECK(largest_difference(cumulative(support.first_nm), {}) == 0);
        for (int i = 0; i < 40; ++i) {
            const double nm = random.uniform(support.first_nm, support.last_nm);
            CHECK(largest_difference(cumulative(nm), sensitivity.integral({support.first_nm, nm})) <
                  1e-14);
        }
    }
}

TEST_CASE("cumulative integrals of uneven rows", "[cumulative]") {
    const Table light{{350.2, 401.75, 402.25, 402.3, 640, 811.1}, {1, 3, 0.5, 2, 2, 1}};
    const Sensitivity sensitivity(observer(2), light);
    const CumulativeSensitivity cumulative(sensitivity);
    for (const double nm : {360.0, 401.8, 402.26, 402.29999, 402.31, 500.5, 811.05})
        CHECK(largest_difference(cumulative(nm), sensitivity.integral({360, nm})) < 1e-14);
}

TEST_CASE("cumulative integrals end where the support does", "[cumulative]") {
    const Sensitivity sensitivity(observer(2), illuminant("D65"));
    const CumulativeSensitivity cumulative(sensitivity);
    CHECK(cumulative(100) == Triple{});
    CHECK(cumulative(1e6) == sensitivity.white());
    CHECK(cumulative(std::numeric_limits<double>::infinity()) == sensitivity.white());
}
