#include "core/spectrum/cone.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/keep_once.hpp"
#include "core/math/adaptive_integral.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"
#include "core/math/square.hpp"

namespace irido {

namespace {

/// Wavelengths that are integrated together.
constexpr std::size_t kTogether = 2048;

}  // namespace

ConeLight::ConeLight(const Cone& cone)
    : axis_(cone.axis_deg * kDegree),
      half_angle_(cone.half_angle_deg * kDegree),
      norm_(kPi * square(std::sin(half_angle_)) * cos_of_incidence(cone.axis_deg)) {
    const double last_deg = cone.axis_deg + cone.half_angle_deg;
    if (!(last_deg <= kLargestAngle_deg))
        throw DomainError("a cone must end at 90 degrees or before (got " + to_text(cone.axis_deg) +
                          " + " + to_text(cone.half_angle_deg) + ")");
    // the normal, and the ring of rays at the cone's edge around it
    if (axis_ < half_angle_) ends_ = {-axis_, half_angle_ - 2 * axis_};
    if (axis_ >= half_angle_) ends_ = {-half_angle_};
    if (axis_ == 0) ends_ = {0};
    ends_.push_back(half_angle_);
}

ConeShares ConeLight::shares(double offset) const {
    const double a = half_angle_, b = axis_, theta = axis_ + offset;
    const double weight = std::cos(theta) * std::sin(theta) / norm_;
    if (b == 0) return {kPi * weight, kPi * weight};
    // the spherical triangle of the axis, the normal and the ray at the cone's edge
    const double outside = std::sin((a + offset) / 2) * std::sin((a - offset) / 2);
    const double inside = std::sin((a + offset) / 2 + b) * std::sin((offset - a) / 2 + b);
    const double last =
        2 * std::atan2(std::sqrt(std::max(0.0, outside)), std::sqrt(std::max(0.0, inside)));
    constexpr int kAzimuths = 40;
    double s = 0;
    for (const GaussNode& node : gauss_legendre<kAzimuths>()) {
        const double azimuth = last * (1 + node.x) / 2;
        const double across = std::sin(b) * std::sin(theta);
        const double along = std::cos(azimuth) +
                             across * square(std::sin(azimuth)) /
                                 (1 + std::cos(b) * std::cos(theta) + across * std::cos(azimuth));
        s += node.weight * square(along);
    }
    return {weight * last * s, weight * last * (2 - s)};
}

std::vector<double> ConeLight::smooth_ends(std::span<const Complex> index, double n0) const {
    std::vector<double> ends = ends_;
    for (const Complex& one : index) {
        if (one.imag() != 0 || !(one.real() < n0)) continue;
        const double critical = std::asin(one.real() / n0) - axis_;
        if (critical > ends_.front() && critical < ends_.back()) ends.push_back(critical);
    }
    keep_once(ends);
    return ends;
}

ConeNode ConeLight::node(double t, std::span<const double> ends) const {
    const std::size_t panel = std::min(static_cast<std::size_t>(t), ends.size() - 2);
    const double phase = kPi * (t - static_cast<double>(panel));
    const double length = ends[panel + 1] - ends[panel];
    const double up = square(std::sin(phase / 2)), down = square(std::cos(phase / 2));
    const double offset = up < down ? ends[panel] + length * up : ends[panel + 1] - length * down;
    const double slope = length * kPi / 2 * std::sin(phase);
    const ConeShares at = shares(offset);
    return {axis_ + offset, {at.s * slope, at.p * slope}};
}

IncidentAngle ConeNode::incidence() const {
    return {std::sin(kPi / 2 - theta), std::sin(theta)};
}

double ConeSize::half_angle(double incident_index) const {
    if (f_number == 0) return half_angle_deg;
    const double sine = 1 / (2 * f_number * incident_index);
    if (!(sine >= 0 && sine <= 1))
        throw DomainError("an f-number must be at least 1/(2 n), here " +
                          to_text(1 / (2 * incident_index)) + " (got " + to_text(f_number) + ")");
    return std::asin(sine) / kDegree;
}

namespace {

/// The quantities of a cone's mean, as places in Spectra.
std::vector<std::vector<double> Spectrum::*> mean_quantities(const Needs& needs) {
    std::vector<std::vector<double> Spectrum::*> all;
    if (needs.R) all.push_back(&Spectrum::R);
    if (needs.T) all.push_back(&Spectrum::T);
    if (needs.A) all.push_back(&Spectrum::A);
    if (needs.layers) all.push_back(&Spectrum::A_layers);
    return all;
}

/// One cone at the wavelengths of a table, which have its ends in common.
class ConeMean {
public:
    ConeMean(const StackPower& power, const IndexTable& table, const Needs& needs,
             const Execution& execution)
        : power_(power),
          table_(table),
          needs_(needs),
          execution_(execution),
          quantities_(mean_quantities(needs)),
          wavelengths_(table.wavelength_nm().size()),
          layers_(needs.layers ? power.layer_count() : 0) {}

    /// [light][quantity][layer, if it is that][wavelength], for the lights s and p.
    std::vector<double> operator()(const ConeLight& light, const std::vector<double>& ends) const {
        std::vector<double> steps(ends.size());
        for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<double>(i);
        const auto values_at = [&](std::span<const double> points, std::span<double> values) {
            std::vector<IncidentAngle> angles;
            std::vector<ConeShares> shares;
            for (const double t : points) {
                const ConeNode node = light.node(t, ends);
                angles.push_back(node.incidence());
                shares.push_back(node.shares);
            }
            fill(angles, shares, values);
        };
        const auto found = integrals(steps, components(), kConeError, values_at);
        if (!found)
            throw ToleranceError("the mean over the cone cannot be found to 1e-8 near " +
                                 to_text(table_.wavelength_nm().front()) +
                                 " nm: resonances are too narrow");
        return *found;
    }

private:
    std::size_t components() const {
        std::size_t rows = 0;
        for (const auto quantity : quantities_)
            rows += quantity == &Spectrum::A_layers ? layers_ : 1;
        return 2 * rows * wavelengths_;
    }

    void fill(const std::vector<IncidentAngle>& angles, const std::vector<ConeShares>& shares,
              std::span<double> values) const {
        Spectra at;
        spectra(power_, table_, angles, needs_, execution_, at);
        const std::size_t width = components(), points = angles.size() * wavelengths_;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            double* to = values.data() + i * width;
            for (const bool is_p : {false, true}) {
                const double s = is_p ? shares[i].p : shares[i].s,
                             p = is_p ? shares[i].s : shares[i].p;
                for (const auto quantity : quantities_) {
                    const std::vector<double>&of_s = at.s.*quantity, &of_p = at.p.*quantity;
                    for (std::size_t row = 0; row < of_s.size(); row += points)
                        for (std::size_t w = 0; w < wavelengths_; ++w) {
                            const std::size_t point = row + i * wavelengths_ + w;
                            *to++ = s * of_s[point] + p * of_p[point];
                        }
                }
            }
        }
    }

    const StackPower& power_;
    const IndexTable& table_;
    const Needs& needs_;
    const Execution& execution_;
    std::vector<std::vector<double> Spectrum::*> quantities_;
    std::size_t wavelengths_, layers_;
};

}  // namespace

void cone_spectra(const Stack& stack, const StackPower& power, const IndexTable& table,
                  std::span<const double> axes_deg, const ConeSize& size, const Needs& asked,
                  const Execution& execution, Spectra& out) {
    Needs needs = asked;
    needs.s = needs.p = true;
    needs.amplitudes = needs.denominators = false;
    const std::vector<double>& all = table.wavelength_nm();
    const std::size_t points = axes_deg.size() * all.size();
    const auto quantities = mean_quantities(needs);
    for (Spectrum* spectrum : {&out.s, &out.p})
        for (const auto quantity : quantities)
            (spectrum->*quantity)
                .resize(points * (quantity == &Spectrum::A_layers ? power.layer_count() : 1));
    for (std::size_t axis = 0; axis < axes_deg.size(); ++axis) {
        const auto light_at = [&](std::size_t w) {
            const double n0 = table.n(table.incident(), w);
            return ConeLight({axes_deg[axis], size.half_angle(n0)});
        };
        const auto ends_at = [&](const ConeLight& light, std::size_t w) {
            std::vector<Complex> index;
            for (std::size_t m = 0; m < table.materials(); ++m) {
                index.push_back(table.index(m, w));
                if (const std::size_t row = table.extraordinary(m); row != m)
                    index.push_back(table.index(row, w));
            }
            return light.smooth_ends(index, table.n(table.incident(), w));
        };
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            const ConeLight light = light_at(begin);
            const std::vector<double> ends = ends_at(light, begin);
            for (end = begin + 1; end < std::min(begin + kTogether, all.size()); ++end)
                if (ends_at(light_at(end), end) != ends) break;
            std::optional<IndexTable> part;
            if (end - begin < all.size())
                part.emplace(stack,
                             std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 all.begin() + static_cast<std::ptrdiff_t>(end)));
            const ConeMean mean(power, part ? *part : table, needs, execution);
            const std::vector<double> values = mean(light, ends);
            const double* value = values.data();
            for (Spectrum* spectrum : {&out.s, &out.p})
                for (const auto quantity : quantities) {
                    std::vector<double>& to = spectrum->*quantity;
                    for (std::size_t row = 0; row < to.size(); row += points)
                        for (std::size_t w = begin; w < end; ++w)
                            to[row + axis * all.size() + w] = *value++;
                }
        }
    }
}

}  // namespace irido
