#include "core/scratch/scratched_scattering.hpp"

#include <catch2/catch.hpp>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/ggx.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/builder.hpp"
#include "tests/core/scratch/support.hpp"

using namespace irido;
using namespace irido::test;

namespace {

const Sensitivity& noon() {
    static const Sensitivity sensitivity(observer(2), illuminant("D65"));
    return sensitivity;
}

ScratchedSurface worked_surface() {
    return {std::nullopt, std::nullopt, kVertical, 1, {worked_scratch()}, {}};
}

ScratchedScattering seen_from(const ScratchedSurface& surface, const ScratchSight& sight,
                              const ScratchSum& sum = {}) {
    return {surface, sight, sum, Execution(1)};
}

const SkyPair kPair{direction_of(19.704, 206.496), direction_of(20, 40)};
const LightCone kLamp(SphereLight{{-303.3, -128.2, 944.2}, 60});

}  // namespace

TEST_CASE("colours of a scratch have the values of exact integrals", "[scratch]") {
    const ScratchedScattering scattering = seen_from(worked_surface(), SurfacePoint{});
    const Triple xyz = scattering.colors(std::array{kPair}, noon())[0];
    const Triple exact{65.42336721553863, 72.4667544571869, 87.2064058408174};
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(xyz[c], exact[c]) < 1e-11);
    const Triple ratio = scattering.light_colors(std::array{kLamp}, std::vector{kPair.view}, noon(),
                                                 {LightIntegral::Kind::band})[0];
    const Triple band{0.01771093295481027, 0.019305930860964205, 0.018300180568327586};
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(ratio[c], band[c]) < 1e-11);
    const std::vector<double> wavelength_nm{450, 550};
    const std::vector<double> f = scattering.brdf(std::array{kPair}, wavelength_nm);
    CHECK(relative(f[0], 80.8220661071697) < 1e-12);
    const Footprint footprint{Footprint::Kind::ellipse, {}, 150, 80, 20};
    CHECK(relative(seen_from(worked_surface(), footprint).density(), 0.012719706554316024) < 1e-12);
}

TEST_CASE("a base multiplies by its reflectance and its share of the light", "[scratch]") {
    // a film whose reflectance depends on the angle
    StackBuilder b(1);
    b.add(b.layer(1.4, 300));
    const Stack film = b.over(Complex(2, 3));
    ScratchedSurface surface = worked_surface();
    surface.base = film;
    surface.scratches.front().width_um = 12;  // 11 % of the area
    const std::vector<double> wavelength_nm{430, 610};
    const ScratchedScattering scattering = seen_from(surface, SurfacePoint{});
    const std::vector<double> f = scattering.brdf(std::array{kPair}, wavelength_nm);
    ScratchedSurface bare = surface;
    bare.base.reset();
    const std::vector<double> alone =
        seen_from(bare, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const double both = kPair.light[0] * kPair.view[0] + kPair.light[1] * kPair.view[1] +
                        kPair.light[2] * kPair.view[2];
    const StackPower power(film);
    for (std::size_t i = 0; i < 2; ++i) {
        const IndexTable table(film, {wavelength_nm[i]});
        const std::array cosine{std::sqrt((1 + both) / 2)};
        const Spectra spectrum = spectra(power, table, cosine, {});
        const double reflectance = (spectrum.s.R[0] + spectrum.p.R[0]) / 2;
        CHECK(relative(f[i], alone[i] * reflectance * (1 - scattering.density())) < 1e-12);
    }
    // a rough base adds facets, attenuated by the light that the scratches take
    surface.alpha = 0.3;
    const std::vector<double> rough =
        seen_from(surface, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    ScratchedSurface smooth_only = surface;
    smooth_only.scratches.clear();
    const std::vector<double> facets =
        seen_from(smooth_only, SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const double rho = scattering.density();
    for (std::size_t i = 0; i < 2; ++i) {
        const double kept = 1 - groove_power(0.28, 1000 / wavelength_nm[i]) * rho * (1 - rho);
        CHECK(facets[i] > 0);
        CHECK(relative(rough[i] - f[i], facets[i] * kept) < 1e-10);
    }
    // for a light small enough to be a single direction
    const LightCone star(SphereLight{{kPair.light[0], kPair.light[1], kPair.light[2]}, 1e-5});
    surface.alpha.reset();
    const std::vector<double> ratio =
        seen_from(surface, SurfacePoint{})
            .light_ratios(std::array{star}, std::vector{kPair.view}, wavelength_nm, {});
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(relative(ratio[i], f[i] * kPi * 1e-10 * kPair.light[2]) < 5e-5);
    CHECK_THROWS_AS(seen_from(surface, SurfacePoint{}, {ScratchSum::Kind::coherent})
                        .light_ratios(std::array{star}, std::vector{kPair.view}, wavelength_nm, {}),
                    DomainError);
}

TEST_CASE("coherent sums of one scratch are its power, of many at a point their interference",
          "[scratch]") {
    const std::vector<double> wavelength_nm{450, 550, 650};
    const Footprint footprint{Footprint::Kind::ellipse, {5, 5}, 90, 30, 70};
    for (const ScratchSight& sight : {ScratchSight(SurfacePoint{}), ScratchSight(footprint)}) {
        ScratchedSurface surface = worked_surface();
        surface.scratches.front().start_um = -100;
        const auto separate = seen_from(surface, sight).brdf(std::array{kPair}, wavelength_nm);
        const auto coherent = seen_from(surface, sight, {ScratchSum::Kind::coherent})
                                  .brdf(std::array{kPair}, wavelength_nm);
        for (std::size_t i = 0; i < 3; ++i) CHECK(relative(coherent[i], separate[i]) < 1e-9);
    }
    // two identical scratches at one place: twice the amplitude
    ScratchedSurface twins = worked_surface();
    twins.scratches.push_back(twins.scratches.front());
    const auto one =
        seen_from(worked_surface(), SurfacePoint{}).brdf(std::array{kPair}, wavelength_nm);
    const auto two = seen_from(twins, SurfacePoint{}, {ScratchSum::Kind::coherent})
                         .brdf(std::array{kPair}, wavelength_nm);
    CHECK(relative(two[0], 4 * one[0]) < 1e-12);
    // the colour of two at a distance, by a sum over many wavelengths
    twins.scratches.back().point = {-60, 40};
    const auto scattering = seen_from(twins, SurfacePoint{}, {ScratchSum::Kind::coherent});
    const Triple xyz = scattering.colors(std::array{kPair}, noon())[0];
    Triple sum{};
    std::vector<double> fine;
    for (int i = 0; i < 47000; ++i) fine.push_back(360.005 + 0.01 * i);
    const std::vector<double> f = scattering.brdf(std::array{kPair}, fine);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const Triple s = noon().at(fine[i]);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += 0.01 * s[c] * f[i];
    }
    for (std::size_t c = 0; c < 3; ++c) CHECK(relative(xyz[c], sum[c]) < 1e-6);
}

TEST_CASE("the mean over places of a field is its ensemble", "[scratch]") {
    ScratchedSurface surface;
    surface.optics = {30, DepthPhase::slanted};
    surface.fields = {{60, {2000, 2000}, {0.8, 2}, {0.1, 0.3}, {-90, 90}}};
    const std::vector<double> wavelength_nm{550};
    // so far from the mirror direction that lobes are much wider than the gaps between angles
    const SkyPair pair{{-kPair.view[0] + 0.02, -kPair.view[1] + 0.01, kPair.light[2]}, kPair.view};
    const ScratchedScattering mean =
        seen_from(surface, SurfacePoint{}, {ScratchSum::Kind::ensemble});
    const double expected = mean.brdf(std::array{pair}, wavelength_nm)[0];
    double sum = 0, density = 0;
    constexpr int kPlaces = 1500;
    Random random(61);
    for (int i = 0; i < kPlaces; ++i) {
        const SurfacePoint at{random.uniform(-2e4, 2e4), random.uniform(-2e4, 2e4)};
        const ScratchedScattering scattering = seen_from(surface, at);
        sum += scattering.brdf(std::array{pair}, wavelength_nm)[0] / kPlaces;
        density += scattering.density() / kPlaces;
    }
    CHECK(relative(mean.density(), 60e-6 * 2000 * 1.4) < 1e-12);
    CHECK(relative(density, mean.density()) < 0.05);
    CHECK(relative(sum, expected) < 0.3);
}
