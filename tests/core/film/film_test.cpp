#include "core/film/film.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/math/random.hpp"
#include "core/spectrum/stack_power.hpp"
#include "core/stack/builder.hpp"

using namespace irido;

namespace {

constexpr std::array kBoth{Polarization::s, Polarization::p};

/// The series, summed until it no longer changes.
Power summed(const FilmSeries& series, double wavelength_nm) {
    const double turns = series.opd_nm / wavelength_nm;
    const double phase = 2 * std::numbers::pi * (turns - std::round(turns)) + series.phase_rad();
    double R = series.coefficient(false, 0), T = series.coefficient(true, 0);
    for (int m = 1; std::pow(series.ratio(), m) > 1e-18 && m < 20000; ++m) {
        R += 2 * series.coefficient(false, m) * std::cos(m * phase);
        T += 2 * series.coefficient(true, m) * std::cos(m * phase);
    }
    return {R, T, 0};
}

/// The general kernel.
Power kernel(const Film& film, double wavelength_nm, double cosine, Polarization polarization) {
    StackBuilder b(film.incident);
    b.add(b.layer(film.film, film.thickness_nm));
    const Stack stack = b.over(film.base);
    std::vector<Medium> media;
    for (const Material& material : stack.materials)
        media.push_back(medium(index_at(material, wavelength_nm), film.incident, cosine));
    media.push_back(medium(film.incident, film.incident, cosine));
    return StackPower(stack)(media, 2 * std::numbers::pi / wavelength_nm, polarization).power;
}

}  // namespace

TEST_CASE("a film's series is the power of the general kernel", "[film]") {
    Random random(11);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        Film film{random.one_in(4) ? random.uniform(1, 1.6) : 1, random.uniform(1, 2.6),
                  random.uniform(0.8, 4), random.uniform(0, 1500)};
        if (random.one_in(2)) film.base = {random.uniform(0.05, 4), random.uniform(0, 6)};
        if (random.one_in(4)) film.thickness_nm *= 20;
        if (random.one_in(9)) film.thickness_nm = 0;
        if (random.one_in(9)) film.film = film.incident;
        const double cosine = cos_of_incidence(random.one_in(9) ? 0 : random.uniform(0, 89));
        const double wavelength = random.uniform(360, 830);
        for (const Polarization polarization : kBoth) {
            const auto series = film_series(film, cosine, polarization);
            const bool passes = film.film > film.incident * std::sqrt(1 - cosine * cosine);
            REQUIRE(series.has_value() == passes);
            if (!series) continue;
            CAPTURE(film.incident, film.film, film.base, film.thickness_nm, cosine);
            const Power sum = summed(*series, wavelength);
            const Power power = kernel(film, wavelength, cosine, polarization);
            // a film d / lambda waves thick has that many times the rounding error of a single
            // phase, and rho^m has m times that of rho
            const double rounding = 1e-14 + 2e-15 * series->opd_nm / wavelength;
            CHECK(std::abs(sum.R - power.R) < rounding / (1 - series->ratio()));
            CHECK(std::abs(sum.T - power.T) < rounding / (1 - series->ratio()));
            worst = std::max({worst, std::abs(sum.R - power.R), std::abs(sum.T - power.T)});
        }
    }
    CAPTURE(worst);
    CHECK(worst < 1e-12);
}

TEST_CASE("nothing is lost in the film", "[film]") {
    for (const Complex base : {Complex(1.5), Complex(0.2, 3.4), Complex(1.05)}) {
        for (const double angle : {0.0, 40.0, 75.0, 89.99}) {
            for (const Polarization polarization : kBoth) {
                const auto series =
                    film_series({1, 1.38, base, 250}, cos_of_incidence(angle), polarization);
                CHECK(std::abs(series->R + series->T - 1) < 4e-15);
                for (const double m : {1.0, 5.0})
                    CHECK(series->coefficient(false, m) == -series->coefficient(true, m));
            }
        }
    }
}

TEST_CASE("a film of a neighbour's index has no fringes", "[film]") {
    for (const Polarization polarization : kBoth) {
        for (const Film& film : {Film{1, 1, 1.5, 300}, Film{1, 1.5, 1.5, 300}}) {
            const auto series = film_series(film, 1, polarization);
            CHECK(series->ratio() == 0);
            CHECK(std::abs(series->R - 0.04) < 1e-16);
            CHECK(series->coefficient(false, 1) == 0);
        }
    }
}

TEST_CASE("light that cannot enter the base is all reflected", "[film]") {
    for (const Polarization polarization : kBoth) {
        // past the base's critical angle, but not the film's
        const auto frustrated = film_series({1.5, 1.6, 1, 300}, cos_of_incidence(60), polarization);
        CHECK(frustrated->R == 1);
        CHECK(frustrated->T == 0);
        CHECK(std::abs(frustrated->coefficient(false, 1)) == 0);
        // at 90 degrees everything is reflected, unless there is no interface
        for (const double film : {1.0, 1.4}) {
            const auto grazing = film_series({1, film, 1.5, 300}, 0, polarization);
            CHECK(grazing->R == 1);
            CHECK(grazing->T == 0);
        }
        CHECK(film_series({1, 1, 1, 300}, 0, polarization)->T == 1);
    }
}

TEST_CASE("a film past its critical angle has no series", "[film]") {
    for (const Polarization polarization : kBoth) {
        CHECK_FALSE(film_series({1.5, 1.2, 2, 300}, cos_of_incidence(60), polarization));
        CHECK_FALSE(film_series({1.5, 1.2, 2, 300}, 0, polarization));
        CHECK(film_series({1.5, 1.2, 2, 300}, cos_of_incidence(50), polarization));
        // nor has a film that returns all of its light, between an amplifying base and a mirror
        CHECK_FALSE(film_series({1, 3, {0.01, -3}, 300}, cos_of_incidence(89.999), polarization));
    }
}
