#include "core/rough/transmissivity.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/rough/filter_nodes.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

RoughTransmissivity::RoughTransmissivity(Stack stack, Light light, SimdLevel simd)
    : facets_(std::move(stack), light, {Side::transmitted}, simd), simd_(simd) {}

void RoughTransmissivity::prepare(std::span<const double> wavelength_nm, unsigned threads) const {
    facets_.prepare(wavelength_nm, threads);
}

std::vector<RoughTransmissivity::Value> RoughTransmissivity::operator()(
    double alpha, std::span<const double> theta_i_deg,
    std::span<const double> wavelength_nm) const {
    const TransmissionFilter filter(alpha);
    for (const double theta : theta_i_deg) require_in_range("theta_i_deg", theta, 0, 90);
    const auto series = facets_(wavelength_nm);
    std::vector<Value> values;
    values.reserve(theta_i_deg.size() * wavelength_nm.size());
    for (const double theta : theta_i_deg) {
        const double G1 = smith_masking(alpha, cos_of_incidence(theta));
        AngleMoments moments(FilterNodes(filter, theta, simd_));
        for (const auto& of_wavelength : series) {
            const AngleMoments::Integral integral = moments(*of_wavelength, 0);
            const double missing = std::abs(integral.weight - G1);
            values.push_back(
                {std::max(0.0, integral.value), G1 > 0 ? (integral.error + missing) / G1 : 0});
        }
    }
    return values;
}

}  // namespace irido
