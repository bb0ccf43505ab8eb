#include "tests/oracle/color_oracle.hpp"

#include <algorithm>
#include <cmath>

#include "tests/oracle/legendre.hpp"
#include "tests/oracle/stack_oracle.hpp"

namespace irido::oracle {

namespace {

double between_rows(const Table& table, double nm) {
    std::size_t i = 1;
    while (i + 1 < table.wavelength_nm.size() && table.wavelength_nm[i] < nm) ++i;
    const double x0 = table.wavelength_nm[i - 1], x1 = table.wavelength_nm[i];
    return (table.value[i - 1] * (x1 - nm) + table.value[i] * (nm - x0)) / (x1 - x0);
}

/// Observer times illuminant where both are linear, times the spectrum.
class Integrand {
public:
    Integrand(const std::function<double(double)>& spectrum, const Observer& observer,
              const Table& illuminant)
        : spectrum_(spectrum), observer_(observer), illuminant_(illuminant) {}

    /// Sets the current piece; tables are looked up from its midpoint, so that its ends are
    /// unambiguous.
    void enter(double first_nm, double last_nm) {
        const double middle = (first_nm + last_nm) / 2;
        row_ = static_cast<std::size_t>(std::floor(middle - kFirstRow_nm));
        light_first_ = between_rows(illuminant_, first_nm);
        light_last_ = between_rows(illuminant_, last_nm);
        first_ = first_nm;
        last_ = last_nm;
    }

    Triple weight(double nm) const {
        const double light =
            light_first_ + (light_last_ - light_first_) * (nm - first_) / (last_ - first_);
        const double t = nm - kFirstRow_nm - static_cast<double>(row_);
        const auto linear = [&](std::span<const double> v) {
            return light * ((1 - t) * v[row_] + t * v[row_ + 1]);
        };
        return {linear(observer_.x), linear(observer_.y), linear(observer_.z)};
    }

    Triple over(double first_nm, double last_nm) const {
        static const LegendreRule<double> rule(6);
        Triple sum{};
        for (std::size_t i = 0; i < rule.x.size(); ++i) {
            const double nm = first_nm + (last_nm - first_nm) * (1 + rule.x[i]) / 2;
            const double f = rule.weight[i] * spectrum_(nm) * (last_nm - first_nm) / 2;
            const Triple w = weight(nm);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += f * w[c];
        }
        return sum;
    }

    Triple refined(double first_nm, double last_nm, const Triple& whole, double tolerance) const {
        const double middle = (first_nm + last_nm) / 2;
        const Triple left = over(first_nm, middle), right = over(middle, last_nm);
        double change = 0;
        for (std::size_t c = 0; c < 3; ++c)
            change = std::max(change, std::abs(left[c] + right[c] - whole[c]));
        if (change > tolerance * (last_nm - first_nm) && last_nm - first_nm > 1e-9) {
            const Triple a = refined(first_nm, middle, left, tolerance);
            const Triple b = refined(middle, last_nm, right, tolerance);
            return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
        }
        return {left[0] + right[0], left[1] + right[1], left[2] + right[2]};
    }

private:
    const std::function<double(double)>& spectrum_;
    const Observer& observer_;
    const Table& illuminant_;
    std::size_t row_ = 0;
    double first_ = 0, last_ = 0, light_first_ = 0, light_last_ = 0;
};

}  // namespace

Triple integrate(const std::function<double(double)>& spectrum, const Observer& observer,
                 const Table& illuminant, const std::vector<double>& breaks, double tolerance,
                 double longest_nm) {
    const double last_row = kFirstRow_nm + static_cast<double>(kObserverRows - 1);
    const double from = std::max(kFirstRow_nm, illuminant.wavelength_nm.front());
    const double to = std::min(last_row, illuminant.wavelength_nm.back());
    std::vector<double> ends(breaks);
    ends.insert(ends.end(), illuminant.wavelength_nm.begin(), illuminant.wavelength_nm.end());
    for (std::size_t i = 0; i < kObserverRows; ++i)
        ends.push_back(kFirstRow_nm + static_cast<double>(i));
    std::erase_if(ends, [&](double nm) { return nm < from || nm > to; });
    ends.push_back(from);
    ends.push_back(to);
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

    const std::function<double(double)> one = [](double) { return 1.0; };
    Integrand light(one, observer, illuminant), integrand(spectrum, observer, illuminant);
    double luminance = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        light.enter(ends[i], ends[i + 1]);
        luminance += light.over(ends[i], ends[i + 1])[1];
    }
    Triple sum{};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        integrand.enter(ends[i], ends[i + 1]);
        const double width = ends[i + 1] - ends[i];
        const int pieces = static_cast<int>(std::ceil(width / longest_nm));
        for (int k = 0; k < pieces; ++k) {
            const double first = ends[i] + width * k / pieces;
            const double last = k + 1 == pieces ? ends[i + 1] : ends[i] + width * (k + 1) / pieces;
            const Triple part = integrand.refined(first, last, integrand.over(first, last),
                                                  tolerance * luminance / (to - from));
            for (std::size_t c = 0; c < 3; ++c) sum[c] += part[c];
        }
    }
    for (double& value : sum) value /= luminance;
    return sum;
}

Triple stack_xyz(const Stack& stack, const Observer& observer, const Table& illuminant,
                 double angle_deg, bool transmitted, double tolerance,
                 const std::vector<double>& more_breaks, double longest_nm) {
    Stack held = stack;
    std::vector<double> breaks(more_breaks);
    for (Material& material : held.materials) {
        material.outside = Outside::clamp;
        const std::vector<double> kink = kinks(material, {300, 900});
        breaks.insert(breaks.end(), kink.begin(), kink.end());
    }
    const auto spectrum = [&](double nm) {
        const Power s = coherent_fast(held, {nm, angle_deg, Polarization::s});
        const Power p = coherent_fast(held, {nm, angle_deg, Polarization::p});
        return transmitted ? (s.T + p.T) / 2 : (s.R + p.R) / 2;
    };
    return integrate(spectrum, observer, illuminant, breaks, tolerance, longest_nm);
}

}  // namespace irido::oracle
