#include "core/rough/facet_series.hpp"

#include <algorithm>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace irido {

namespace {

/// Absolute tolerance of R and T.
constexpr double kSeriesTolerance = 1e-10;

/// Power of one side at one point, for the light's polarization.
double mean_power(const Spectra& out, Side side, Light light, bool is_normal, std::size_t point) {
    const std::vector<double>& s = side == Side::reflected ? out.s.R : out.s.T;
    const std::vector<double>& p = side == Side::reflected ? out.p.R : out.p.T;
    if (light == Light::p) return p[point];
    if (light == Light::s || is_normal) return s[point];
    return 0.5 * (s[point] + p[point]);
}

}  // namespace

FacetSeries::FacetSeries(Stack stack, Light light, std::vector<Side> sides, SimdLevel simd)
    : stack_(std::move(stack)), power_(stack_), light_(light) {
    request_.sides = std::move(sides);
    request_.light = light;
    request_.simd = simd;
}

void FacetSeries::prepare(std::span<const double> wavelength_nm, unsigned threads) const {
    parallel_for(wavelength_nm.size(), threads, [&](std::size_t i) { (*this)(wavelength_nm[i]); });
}

std::vector<double> FacetSeries::values(std::span<const double> theta_deg,
                                        const std::vector<double>& wavelength_nm) const {
    const IndexTable table(stack_, wavelength_nm);
    const SpectrumKernel kernel(power_, table.absorbs(), table.amplifies(), needs_of(request_),
                                request_.simd);
    std::vector<IncidentAngle> incidences;
    for (const double angle_deg : theta_deg) incidences.push_back(incident_angle(angle_deg));
    Spectra out;
    kernel(table, incidences, 1, out);
    const std::size_t points = theta_deg.size() * wavelength_nm.size();
    std::vector<double> values;
    values.reserve(points * request_.sides.size());
    for (const Side side : request_.sides)
        for (std::size_t i = 0; i < points; ++i)
            values.push_back(
                mean_power(out, side, light_, incidences[i / wavelength_nm.size()].cos == 1, i));
    return values;
}

std::shared_ptr<const AngleSeries> FacetSeries::operator()(double wavelength_nm) const {
    {
        const std::scoped_lock guard(lock_);
        const auto found = series_.find(wavelength_nm);
        if (found != series_.end()) return found->second;
    }
    require_in_range("wavelength_nm", wavelength_nm, kAllWavelengths.first_nm,
                     kAllWavelengths.last_nm);
    const std::size_t sides = request_.sides.size();
    const IndexTable table(stack_, {wavelength_nm});
    const SpectrumKernel kernel(power_, table.absorbs(), table.amplifies(), needs_of(request_),
                                request_.simd);
    Spectra out;
    std::vector<IncidentAngle> incidences;
    const auto evaluate = [&](std::span<const double> theta_deg) {
        incidences.clear();
        for (const double angle_deg : theta_deg) incidences.push_back(incident_angle(angle_deg));
        kernel(table, incidences, 1, out);
        std::vector<double> values(theta_deg.size() * sides);
        for (std::size_t i = 0; i < theta_deg.size(); ++i)
            for (std::size_t k = 0; k < sides; ++k)
                values[i * sides + k] =
                    mean_power(out, request_.sides[k], light_, incidences[i].cos == 1, i);
        return values;
    };
    auto made = std::make_shared<const AngleSeries>(sides, kSeriesTolerance, evaluate);
    const std::scoped_lock guard(lock_);
    return series_.try_emplace(wavelength_nm, std::move(made)).first->second;
}

std::vector<std::shared_ptr<const AngleSeries>> FacetSeries::operator()(
    std::span<const double> wavelength_nm) const {
    std::vector<std::shared_ptr<const AngleSeries>> all;
    all.reserve(wavelength_nm.size());
    for (const double wavelength : wavelength_nm) all.push_back((*this)(wavelength));
    return all;
}

}  // namespace irido
