#include "core/coherent/graded_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/coherent/slab_response.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

/// r and t of s and p at the test angles.
struct GradedSample {
    std::array<Complex, 12> values{};

    double distance(const GradedSample& other) const {
        double largest = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            largest = std::max(largest, std::abs(values[i] - other.values[i]));
        return largest;
    }
};

GradedSample sample(GradedProfile profile, Complex n1, Complex n2, double k0_d, double n0,
                    std::size_t steps) {
    GradedSample result;
    std::size_t next = 0;
    const double k0_half = k0_d / (2.0 * static_cast<double>(steps));
    for (const double angle_deg : {0.0, 40.0, 60.0})
        for (const Polarization polarization : {Polarization::s, Polarization::p}) {
            const IncidentAngle at = incident_angle(angle_deg);
            Matrix total;
            for (std::size_t half = 2 * steps; half-- > 0;) {
                const auto [eps, eps_z] = GradedHalfStep(half, steps).permittivity(profile, n1, n2);
                const Complex o = std::sqrt(eps), e = std::sqrt(eps_z);
                const Medium m = polarization == Polarization::s
                                     ? medium(o, n0, at)
                                     : extraordinary_medium(o, e, n0, at);
                total = layer_matrix(m, k0_half, polarization) * total;
            }
            const Wave wave = outgoing_wave(medium(n0, n0, at), polarization);
            const Response response = slab_response(wave, {total, {}, false}, wave);
            result.values[next++] = response.r;
            result.values[next++] = response.t;
        }
    return result;
}

RefractiveIndex constant_index(Complex index) {
    return {Constant{index.real()}, Constant{index.imag()}};
}

}  // namespace

GradedLayer graded_layer(const Material& from, const Material& to, GradedProfile profile,
                         double thickness_nm, double n0, const std::string& name) {
    const auto ends = std::make_shared<const std::vector<Material>>(std::vector{from, to});
    GradedLayer layer;
    Material part{name, GradedPart{profile, 0, 1, ends}, Outside::refuse};
    const WavelengthRange known = range_of(part);
    const double nm = std::max(known.first_nm, std::min(kGradedWavelength_nm, known.last_nm));
    const Complex n1 = index_at(from, nm), n2 = index_at(to, nm);
    const double k0_d = kTwoPi / nm * thickness_nm;
    constexpr double kOrder = 16;  // ratio of the errors of successive halvings
    std::size_t steps = 2;
    GradedSample last = sample(profile, n1, n2, k0_d, n0, steps);
    for (;;) {
        const GradedSample now = sample(profile, n1, n2, k0_d, n0, 2 * steps);
        layer.error = now.distance(last) / (kOrder - 1);
        steps *= 2;
        if (layer.error <= kGradedError || steps >= kMostGradedSteps) break;
        last = now;
    }
    if (layer.error < kGradedError) {  // fewer steps may do
        const double share = std::sqrt(std::sqrt(layer.error / kGradedError));
        const auto fewer = static_cast<std::size_t>(std::ceil(share * static_cast<double>(steps)));
        steps = std::clamp<std::size_t>(fewer, std::max<std::size_t>(2, steps / 2), steps);
        layer.error = kGradedError;
    }
    const bool constant = is_constant(from) && is_constant(to);
    for (std::size_t half = 0; half < 2 * steps; ++half) {
        part.model = GradedPart{profile, half, steps, ends};
        layer.parts.push_back(part);
        if (!constant) continue;
        const Complex o = index_at(part, nm), e = extraordinary_index_at(part, nm);
        layer.parts.back().model =
            Uniaxial{{Material{name, constant_index(o)}, Material{name, constant_index(e)}}};
    }
    return layer;
}

}  // namespace irido
