#include "core/rough/transmissivity.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/filter_nodes.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

/// Of T, absolute.
constexpr double kSeriesTolerance = 1e-10;

}  // namespace

/// T of the stack at one wavelength and many angles.
struct RoughTransmissivity::Kernel {
    Kernel(Stack of, Light light_, SimdLevel simd)
        : stack(std::move(of)), power(stack), light(light_), execution(1, simd) {}

    AngleSeries series(double wavelength_nm) const {
        const IndexTable table(stack, {wavelength_nm});
        ColorRequest request;
        request.sides = {Side::transmitted};
        request.light = light;
        const Needs needs = needs_of(request);
        const SpectrumKernel kernel(power, table.absorbs(), table.amplifies(), needs,
                                    execution.simd);
        Spectra out;
        std::vector<IncidentAngle> incidences;
        return {1, kSeriesTolerance, [&](std::span<const double> theta_deg) {
                    incidences.clear();
                    for (const double angle_deg : theta_deg)
                        incidences.push_back(incident_angle(angle_deg));
                    kernel(table, incidences, 1, out);
                    std::vector<double> T(theta_deg.size());
                    for (std::size_t i = 0; i < T.size(); ++i) T[i] = mean(out, incidences, i);
                    return T;
                }};
    }

    double mean(const Spectra& of, std::span<const IncidentAngle> incidences, std::size_t i) const {
        if (light == Light::p) return of.p.T[i];
        if (light == Light::s || incidences[i].cos == 1) return of.s.T[i];
        return 0.5 * (of.s.T[i] + of.p.T[i]);
    }

    Stack stack;
    StackPower power;
    Light light;
    Execution execution;
};

RoughTransmissivity::RoughTransmissivity(Stack stack, Light light, SimdLevel simd)
    : kernel_(std::make_unique<const Kernel>(std::move(stack), light, simd)), simd_(simd) {}

RoughTransmissivity::~RoughTransmissivity() = default;

void RoughTransmissivity::prepare(std::span<const double> wavelength_nm, unsigned threads) const {
    parallel_for(wavelength_nm.size(), threads,
                 [&](std::size_t i) { series_of(wavelength_nm[i]); });
}

std::vector<RoughTransmissivity::Value> RoughTransmissivity::operator()(
    double alpha, std::span<const double> theta_i_deg,
    std::span<const double> wavelength_nm) const {
    const TransmissionFilter filter(alpha);
    for (const double theta : theta_i_deg) require_in_range("theta_i_deg", theta, 0, 90);
    std::vector<std::shared_ptr<const AngleSeries>> series;
    series.reserve(wavelength_nm.size());
    for (const double wavelength : wavelength_nm) series.push_back(series_of(wavelength));
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

std::shared_ptr<const AngleSeries> RoughTransmissivity::series_of(double wavelength_nm) const {
    {
        const std::scoped_lock guard(lock_);
        const auto found = series_.find(wavelength_nm);
        if (found != series_.end()) return found->second;
    }
    require_in_range("wavelength_nm", wavelength_nm, kAllWavelengths.first_nm,
                     kAllWavelengths.last_nm);
    auto made = std::make_shared<const AngleSeries>(kernel_->series(wavelength_nm));
    const std::scoped_lock guard(lock_);
    return series_.try_emplace(wavelength_nm, std::move(made)).first->second;
}

}  // namespace irido
