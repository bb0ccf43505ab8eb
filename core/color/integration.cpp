#include "core/color/integration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/math/transform.hpp"

namespace irido {

namespace {

constexpr std::size_t kLowestDegree = 8, kHighestDegree = 128;

/// Panels are not cut below this share of their wavelength.
constexpr double kNarrowest = 1e-7;

std::size_t first_degree(double half_turn) {
    std::size_t degree = kLowestDegree;
    while (degree < kHighestDegree && static_cast<double>(degree) < 1.2 * half_turn + 8)
        degree *= 2;
    return degree;
}

/// Largest |c_k| in the last eighth of the coefficients, at least the last three: what is left out
/// is taken to continue from there over as many terms again as half the degree.
double tail_of(std::span<const double> coefficients) {
    const std::size_t degree = coefficients.size() - 1;
    const std::size_t count = std::max<std::size_t>(3, degree / 8);
    double largest = 0;
    for (std::size_t k = degree + 1 - count; k <= degree; ++k)
        largest = std::max(largest, std::abs(coefficients[k]));
    return largest * static_cast<double>(degree) / 2;
}

double largest_high_moment(const std::vector<double>& moment) {
    double largest = 0;
    for (std::size_t k = moment.size() / 2; k < moment.size(); ++k)
        largest = std::max(largest, std::abs(moment[k]));
    return largest;
}

class Integration {
public:
    Integration(const Sensitivity& sensitivity, std::size_t items, const SpectraAt& spectra,
                const IntegrationLimits& limits)
        : sensitivity_(sensitivity),
          spectra_(spectra),
          limits_(limits),
          results_(items),
          reference_(items) {}

    std::vector<ColorIntegral> over(const std::vector<SpectralPanel>& panels) {
        std::vector<std::size_t> all(results_.size());
        std::iota(all.begin(), all.end(), 0);
        const Triple& white = sensitivity_.white();
        spectra_(std::span(&panels.front().range.first_nm, 1), all, reference_);
        for (std::size_t i = 0; i < results_.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) results_[i].xyz[c] = reference_[i] * white[c];
        const double share = 1 / static_cast<double>(panels.size());
        for (const SpectralPanel& panel : panels)
            integrate(panel.range, first_degree(panel.half_turn), share, all);
        return std::move(results_);
    }

private:
    /// Half of the tolerance is shared out by the light in a panel, half by its rank.
    Triple budget(const PanelRule& rule, double share) const {
        Triple result{};
        for (std::size_t c = 0; c < 3; ++c)
            result[c] =
                limits_.tolerance / 2 * (rule.moment[c][0] / sensitivity_.white()[c] + share);
        return result;
    }

    void integrate(WavelengthRange range, std::size_t degree, double share,
                   std::vector<std::size_t> items) {
        std::vector<double> values;  // [item][point], of the degree before
        for (;; degree *= 2) {
            const PanelRule rule = panel_rule(sensitivity_, range, degree);
            values = sample(rule, std::move(values), items);
            settle(rule, budget(rule, share), degree == kHighestDegree && is_narrow(range), items,
                   values);
            if (items.empty()) return;
            if (degree == kHighestDegree) break;
        }
        const double middle = 2 / (1 / range.first_nm + 1 / range.last_nm);
        integrate({range.first_nm, middle}, kHighestDegree / 2, share / 2, items);
        integrate({middle, range.last_nm}, kHighestDegree / 2, share / 2, items);
    }

    static bool is_narrow(WavelengthRange range) {
        return range.last_nm - range.first_nm < kNarrowest * range.first_nm;
    }

    /// Spectra at the rule's points; where `coarse` has every second of them, only the others are
    /// computed.
    std::vector<double> sample(const PanelRule& rule, std::vector<double> coarse,
                               const std::vector<std::size_t>& items) {
        const std::size_t points = rule.wavelength_nm.size();
        const bool refine = !coarse.empty();
        std::vector<double> wavelengths = rule.wavelength_nm;
        if (refine) {
            wavelengths.clear();
            for (std::size_t j = 1; j < points; j += 2)
                wavelengths.push_back(rule.wavelength_nm[j]);
        }
        std::vector<double> fresh(items.size() * wavelengths.size());
        spectra_(wavelengths, items, fresh);
        for (const std::size_t item : items) results_[item].evaluations += wavelengths.size();
        if (!refine) return fresh;
        std::vector<double> values(items.size() * points);
        const std::size_t kept = points / 2 + 1;
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (std::size_t j = 0; j < kept; ++j)
                values[i * points + 2 * j] = coarse[i * kept + j];
            for (std::size_t j = 0; j + 1 < kept; ++j)
                values[i * points + 2 * j + 1] = fresh[i * (kept - 1) + j];
        }
        return values;
    }

    /// Adds the panel's integral for every item that meets its budget (or for all that must end
    /// here) and keeps the others.
    void settle(const PanelRule& rule, const Triple& budget, bool last,
                std::vector<std::size_t>& items, std::vector<double>& values) {
        const std::size_t points = rule.wavelength_nm.size();
        Triple high{};
        for (std::size_t c = 0; c < 3; ++c) high[c] = 2 * largest_high_moment(rule.moment[c]);
        std::vector<double> coefficients(points);
        std::size_t left = 0;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::span<double> f(values.data() + i * points, points);
            chebyshev_transform(points - 1)(f, coefficients);
            const double tail = tail_of(coefficients);
            bool met = true;
            for (std::size_t c = 0; c < 3; ++c) met = met && high[c] * tail <= budget[c];
            ColorIntegral& result = results_[items[i]];
            if (met || last || result.evaluations >= limits_.evaluations) {
                add(rule, f, reference_[items[i]], *std::ranges::max_element(high) * tail, result);
            } else {
                std::copy(f.begin(), f.end(), values.data() + left * points);
                items[left++] = items[i];
            }
        }
        items.resize(left);
        values.resize(left * points);
    }

    /// The reference value's own integral is the exact white, so only differences are summed.
    static void add(const PanelRule& rule, std::span<const double> f, double reference,
                    double error, ColorIntegral& result) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t j = 0; j < f.size(); ++j)
                sum += rule.weight[c][j] * (f[j] - reference);
            result.xyz[c] += sum;
        }
        result.error += error;
    }

    const Sensitivity& sensitivity_;
    const SpectraAt& spectra_;
    IntegrationLimits limits_;
    std::vector<ColorIntegral> results_;
    std::vector<double> reference_;  ///< each item's value at the short end
};

}  // namespace

std::vector<ColorIntegral> integrate_color(const Sensitivity& sensitivity,
                                           const std::vector<SpectralPanel>& panels,
                                           std::size_t items, const SpectraAt& spectra,
                                           const IntegrationLimits& limits) {
    require_in_range("tolerance", limits.tolerance, 1e-12, 1);
    return Integration(sensitivity, items, spectra, limits).over(panels);
}

}  // namespace irido
