#include "core/color/quadrature/smooth_index.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/colorimetry/illuminant.hpp"
#include "core/math/random.hpp"
#include "core/stack/builder.hpp"

using namespace irido;

namespace {

const Sensitivity& d65() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

/// A film whose n and k have rows roughly every `step_nm`.
Stack film_of_rows(double step_nm, double noise, Random& random) {
    Table n, k;
    for (double nm = 350; nm < 850; nm += step_nm * random.uniform(0.7, 1.3)) {
        n.wavelength_nm.push_back(nm);
        n.value.push_back(1.5 + 1e4 / (nm * nm) + noise * random.uniform(-1, 1));
        k.wavelength_nm.push_back(nm);
        k.value.push_back(std::max(0.0, (420 - nm) / 300));
    }
    Material film;
    film.name = "film";
    film.model = RefractiveIndex{n, k};
    film.outside = Outside::clamp;
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(film), 300));
    return b.over(1.5);
}

}  // namespace

TEST_CASE("fitted indices lose no more of the colour than they say") {
    Random random(7);
    for (int run = 0; run < 30; ++run) {
        const Stack stack = film_of_rows(random.log_uniform(0.7, 20), 1e-3 * (run % 3), random);
        const double first = random.uniform(370, 600);
        const WavelengthRange panel{first, first + random.log_uniform(25, 200)};
        const SmoothIndices indices(stack, d65());
        REQUIRE(indices.has_rows(panel));
        const double middle = indices.middle_row(panel);
        CHECK((middle > panel.first_nm && middle < panel.last_nm));
        const auto fit = indices.fit(panel);
        std::vector<double> wavelengths{panel.first_nm, panel.last_nm};
        constexpr int kCount = 4000;
        for (int i = 0; i < kCount; ++i)
            wavelengths.push_back(panel.first_nm +
                                  (panel.last_nm - panel.first_nm) * (i + 0.5) / kCount);
        const IndexTable exact(stack, wavelengths);
        IndexTable smooth(stack, wavelengths);
        fit->replace(smooth);
        const std::size_t film = std::get<Layer>(stack.elements[0].value).material;
        for (std::size_t end = 0; end < 2; ++end)
            CHECK(std::abs(exact.index(film, end) - smooth.index(film, end)) < 1e-14);
        CHECK_FALSE(smooth.amplifies()[film]);
        // error in functions of the wavelength like dR/dn, at most 1, caused by that of n
        for (const double turns : {0.0, 0.5, 1.5}) {
            Triple lost{};
            for (std::size_t w = 2; w < wavelengths.size(); ++w) {
                const Triple s = d65().at(wavelengths[w]);
                const double x =
                    (wavelengths[w] - panel.first_nm) / (panel.last_nm - panel.first_nm);
                for (std::size_t c = 0; c < 3; ++c)
                    lost[c] += s[c] * std::cos(turns * 3.14159 * x + run) *
                               (exact.n(film, w) - smooth.n(film, w)) / kCount *
                               (panel.last_nm - panel.first_nm);
            }
            const IndexFit::Error error = fit->errors(1, 0).front();
            CAPTURE(run, panel.first_nm, panel.last_nm, turns);
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(std::abs(lost[c]) <= error.first[c] + 1e-8);  // for the sum over 4000
        }
    }
}

TEST_CASE("rows on a line in 1 / lambda lose nothing") {
    Material film;
    Table n;
    for (double nm = 350; nm < 850; nm += 1) {
        n.wavelength_nm.push_back(nm);
        n.value.push_back(1.5);
    }
    film.model = RefractiveIndex{n, Constant{0}};
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(film), 300));
    const Stack stack = b.over(1.5);
    const SmoothIndices indices(stack, d65());
    const auto fit = indices.fit({400, 700});
    CHECK(fit->errors(1, 0).front().first[1] < 1e-15);
    CHECK_FALSE(indices.has_rows({400, 401}));
    CHECK(indices.is_tabulated(std::get<Layer>(stack.elements[0].value).material));
    CHECK_FALSE(indices.is_tabulated(stack.substrate));
}
