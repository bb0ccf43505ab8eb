#include "core/rough/walk/rest_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/layered_color.hpp"

namespace irido {

namespace {

constexpr std::size_t kRestAngles = 31, kRestAzimuths = 19, kRestWavelengths = 60;
constexpr std::size_t kWavelengthsTogether = 12;

/// Where the table ends: at 90 degrees nothing crosses a coating.
constexpr double kRestEnd_deg = 89.5;

double rest_angle_deg(std::size_t step) {
    return kRestEnd_deg * static_cast<double>(step) / static_cast<double>(kRestAngles - 1);
}

/// The lower one of two steps and the share of the other.
std::pair<std::size_t, double> step_of(double value, double end, std::size_t count) {
    const double place = std::clamp(value / end, 0.0, 1.0) * static_cast<double>(count - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), count - 2);
    return {below, place - static_cast<double>(below)};
}

std::size_t rest_place(std::size_t i, std::size_t o, std::size_t azimuth) {
    return (i * kRestAngles + o) * kRestAzimuths + azimuth;
}

}  // namespace

RestTable::RestTable(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                     double tolerance, const Execution& execution,
                     const std::function<void(double done)>& progress)
    : coating_(scattering.coating()), values_(kRestAngles * kRestAngles * kRestAzimuths) {
    const Adding adding(scattering, tolerance, execution);
    const SampleRule rule = equal_rule(sensitivity, kRestWavelengths);
    std::vector<ScatterPair> pairs;
    for (std::size_t i = 0; i < kRestAngles; ++i)
        for (std::size_t o = 0; o <= i; ++o)
            for (std::size_t p = 0; p < kRestAzimuths; ++p)
                pairs.push_back({rest_angle_deg(i), rest_angle_deg(o),
                                 180 * static_cast<double>(p) / (kRestAzimuths - 1)});
    std::vector<double> spectra(pairs.size() * kRestWavelengths);
    for (std::size_t first = 0; first < kRestWavelengths; first += kWavelengthsTogether) {
        const std::size_t count = std::min(kWavelengthsTogether, kRestWavelengths - first);
        const auto begin = rule.wavelength_nm.begin() + static_cast<std::ptrdiff_t>(first);
        const Adding::Values some = adding.brdf_rest(
            pairs, std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count)));
        for (std::size_t p = 0; p < pairs.size(); ++p)
            std::copy_n(
                some.values.begin() + static_cast<std::ptrdiff_t>(p * count), count,
                spectra.begin() + static_cast<std::ptrdiff_t>(p * kRestWavelengths + first));
        error_ = std::max(error_, some.error);
        progress(static_cast<double>(first + count) / kRestWavelengths);
    }
    const std::vector<Triple> colors = sampled_colors(sensitivity, rule, spectra);
    std::size_t p = 0;
    for (std::size_t i = 0; i < kRestAngles; ++i)
        for (std::size_t o = 0; o <= i; ++o)
            for (std::size_t azimuth = 0; azimuth < kRestAzimuths; ++azimuth, ++p) {
                Triple value = colors[p];
                const double crossed =
                    coating_.inward(rest_angle_deg(i)).T * coating_.inward(rest_angle_deg(o)).T;
                for (double& part : value) part = crossed > 0 ? part / crossed : 0;
                values_[rest_place(i, o, azimuth)] = values_[rest_place(o, i, azimuth)] = value;
            }
}

Triple RestTable::operator()(double theta_i_deg, double theta_o_deg, double near,
                             double far) const {
    const auto [i, more_i] = step_of(theta_i_deg, kRestEnd_deg, kRestAngles);
    const auto [o, more_o] = step_of(theta_o_deg, kRestEnd_deg, kRestAngles);
    const auto [p, more_p] = step_of(2 * std::atan2(far, near), kPi, kRestAzimuths);
    const double crossed = coating_.inward(theta_i_deg).T * coating_.inward(theta_o_deg).T;
    Triple xyz{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t d_i = corner & 1, d_o = corner >> 1 & 1, d_p = corner >> 2;
        const double share = crossed * (d_i ? more_i : 1 - more_i) * (d_o ? more_o : 1 - more_o) *
                             (d_p ? more_p : 1 - more_p);
        const Triple& value = values_[rest_place(i + d_i, o + d_o, p + d_p)];
        for (std::size_t c = 0; c < 3; ++c) xyz[c] += share * value[c];
    }
    return xyz;
}

}  // namespace irido
