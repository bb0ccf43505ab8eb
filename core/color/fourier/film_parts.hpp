#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/color/color_request.hpp"
#include "core/color/fourier/film_color.hpp"
#include "core/error.hpp"
#include "core/film/film.hpp"
#include "core/stack/index_table.hpp"
#include "core/stack/stack.hpp"

/// Code shared by the two kinds of film_color().
namespace irido {

/// Wavelengths at which BB17 takes the indices for X, Y and Z (section 4, Validation).
inline constexpr std::array<double, 3> kPeaks_nm{600, 560, 450};

inline DomainError no_series(double angle_deg) {
    return DomainError("there is no Fourier series at " + to_text(angle_deg) +
                       " degrees, past the film's critical angle or over a base that amplifies");
}

/// Share of the light in s and in p.
inline std::array<double, 2> weights(Light light, double cos_theta) {
    if (light == Light::s || cos_theta == 1) return {1, 0};  // both are one at normal incidence
    if (light == Light::p) return {0, 1};
    return {0.5, 0.5};
}

/// Film with its three indices at one wavelength; the thickness is left to be filled in.
inline Film film_at(const IndexTable& table, const Stack& stack, std::size_t wavelength) {
    return {table.n(stack.incident, wavelength), table.n(only_film(stack).material, wavelength),
            table.index(stack.substrate, wavelength), 0};
}

/// The film's thickness distribution, a Gaussian.
struct Thickness {
    double mean_nm, sigma_nm;

    explicit Thickness(const Layer& layer)
        : mean_nm(layer.thickness_nm), sigma_nm(layer.thickness_sigma_nm) {
        require_in_range("thickness_nm", mean_nm, 0, kLargestThickness_nm);
        require_in_range("thickness_sigma_nm", sigma_nm, 0, kLargestThickness_nm);
        mean_nm = std::max(mean_nm, 1e-9 * sigma_nm);  // the standard deviation is taken relative
                                                       // to the mean
    }
    bool vanishes() const { return mean_nm == 0 && sigma_nm == 0; }
    /// Fraction of the Gaussian below zero.
    double part_below_zero() const {
        return sigma_nm == 0 ? 0 : std::erfc(mean_nm / sigma_nm / std::numbers::sqrt2) / 2;
    }
    /// A film of zero thickness is replaced by the incident medium.
    Film of(Film film) const {
        if (vanishes()) film.film = film.incident;
        film.thickness_nm = mean_nm;
        return film;
    }
};

/// Data shared by all colours of one call.
struct Lighting {
    const Triple& white;
    std::span<const Side> sides;
    std::string_view method;  ///< its name
    std::size_t evaluations;

    /// The colours of all sides, from the transmitted one.
    void store(const Triple& transmitted, double error, std::span<StackColor> colors) const {
        for (std::size_t s = 0; s < sides.size(); ++s) {
            colors[s] = {transmitted, error, evaluations, method};
            if (sides[s] == Side::transmitted) continue;
            for (std::size_t c = 0; c < 3; ++c) colors[s].xyz[c] = white[c] - transmitted[c];
        }
    }
};

/// film_color() for indices that depend on the wavelength.
///   tables   observer and illuminant; must outlive the result
///   held     the film, its materials clamped
///   method   fourier or fourier-constant
///   request  options
std::unique_ptr<ColorAlgorithm> dispersive_film_color(const ColorTables& tables, const Stack& held,
                                                      const ColorMethod& method,
                                                      const ColorRequest& request);

}  // namespace irido
