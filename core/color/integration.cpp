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

/// Largest |c_k| in the last eighth of the coefficients, at least the last three.
double last_coefficients(std::span<const double> coefficients) {
    const std::size_t degree = coefficients.size() - 1;
    const std::size_t count = std::max<std::size_t>(3, degree / 8);
    double largest = 0;
    for (std::size_t k = degree + 1 - count; k <= degree; ++k)
        largest = std::max(largest, std::abs(coefficients[k]));
    return largest;
}

/// Error of an integral per unit of the last coefficients. The coefficient c_(n+j) that is left out
/// misses its own moment and comes back on the points as T_(n-j). Poles that are not marked as
/// hidden make it fall at least as exp(-2 j/n).
double error_per_coefficient(const std::vector<double>& moment) {
    const std::size_t degree = moment.size() - 1;
    double high = 0;  // what the moments past the last one are taken to be
    for (std::size_t k = degree / 2; k <= degree; ++k) high = std::max(high, std::abs(moment[k]));
    const double fall = std::exp(-2 / static_cast<double>(degree));
    double sum = 0, size = 1;
    for (std::size_t j = 1; j <= degree; ++j) {
        size *= fall;
        sum += size * (std::abs(moment[degree - j]) + high);
    }
    return 2 * sum;  // c_(3n - j) and later ones come back there too
}

/// A denominator's zero within this many point spacings of a point is not resolved: poles further
/// off make coefficients that fall steadily, and the tail sees them.
constexpr double kFarFromZero = 1 / 1.5;

/// Marks the points next to which a denominator has a zero that the points do not resolve: Newton's
/// step from there, -D/D', is shorter than the way to the next point. D is interpolated after an
/// exponential trend, which has no zeros, is taken out of it.
void mark_hidden_zeros(std::span<const double> x, std::span<const SpectrumSample> samples,
                       std::size_t which, std::vector<bool>& marked) {
    const std::size_t degree = samples.size() - 1;
    const double first = samples.front().denominator[which].log_scale;
    const double last = samples.back().denominator[which].log_scale;
    std::array<std::vector<double>, 2> parts;  // real and imaginary
    for (std::size_t j = 0; j <= degree; ++j) {
        const ScaledComplex& d = samples[j].denominator[which];
        const double trend = (first + last) / 2 + (first - last) / 2 * x[j];
        const Complex plain = d.value * std::exp(std::clamp(d.log_scale - trend, -300.0, 300.0));
        parts[0].push_back(plain.real());
        parts[1].push_back(plain.imag());
    }
    const ChebyshevTransform& transform = chebyshev_transform(degree);
    std::array<std::vector<double>, 2> slopes;
    for (std::size_t part = 0; part < 2; ++part) {
        std::vector<double> coefficients(degree + 1);
        transform(parts[part], coefficients);
        slopes[part].resize(degree + 1);
        transform.values(chebyshev_derivative(coefficients), slopes[part]);
    }
    for (std::size_t j = 0; j <= degree; ++j) {
        const double before = j > 0 ? x[j - 1] - x[j] : 0, after = j < degree ? x[j] - x[j + 1] : 0;
        const double spacing = std::max(before, after);
        const double size = std::hypot(parts[0][j], parts[1][j]);
        const double slope = std::hypot(slopes[0][j], slopes[1][j]);
        if (size < kFarFromZero * spacing * slope) marked[j] = true;
    }
}

class Integration {
public:
    Integration(const Sensitivity& sensitivity, std::size_t items, const SpectraAt& spectra,
                const IntegrationLimits& limits)
        : sensitivity_(sensitivity),
          spectra_(spectra),
          limits_(limits),
          results_(items),
          errors_(items),
          reference_(items) {}

    std::vector<ColorIntegral> over(const std::vector<SpectralPanel>& panels) {
        std::vector<std::size_t> all(results_.size());
        std::iota(all.begin(), all.end(), 0);
        const Triple& white = sensitivity_.white();
        spectra_(std::span(&panels.front().range.first_nm, 1), all, reference_);
        for (std::size_t i = 0; i < results_.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) results_[i].xyz[c] = reference_[i].value * white[c];
        const double share = 1 / static_cast<double>(panels.size());
        for (const SpectralPanel& panel : panels)
            integrate(panel.range, first_degree(panel.half_turn), share, all);
        for (std::size_t i = 0; i < results_.size(); ++i)
            results_[i].error = *std::ranges::max_element(errors_[i]);
        return std::move(results_);
    }

private:
    using Samples = std::vector<SpectrumSample>;  ///< [item][point]

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
        Samples samples;  // of the degree before
        for (;; degree *= 2) {
            const PanelRule rule = panel_rule(sensitivity_, range, degree);
            samples = sample(rule, std::move(samples), items);
            settle(rule, budget(rule, share), degree == kHighestDegree && is_narrow(range), items,
                   samples);
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
    Samples sample(const PanelRule& rule, Samples coarse, const std::vector<std::size_t>& items) {
        const std::size_t points = rule.wavelength_nm.size();
        const bool refine = !coarse.empty();
        std::vector<double> wavelengths = rule.wavelength_nm;
        if (refine) {
            wavelengths.clear();
            for (std::size_t j = 1; j < points; j += 2)
                wavelengths.push_back(rule.wavelength_nm[j]);
        }
        Samples fresh(items.size() * wavelengths.size());
        spectra_(wavelengths, items, fresh);
        for (const std::size_t item : items) results_[item].evaluations += wavelengths.size();
        if (!refine) return fresh;
        Samples samples(items.size() * points);
        const std::size_t kept = points / 2 + 1;
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (std::size_t j = 0; j < kept; ++j)
                samples[i * points + 2 * j] = coarse[i * kept + j];
            for (std::size_t j = 0; j + 1 < kept; ++j)
                samples[i * points + 2 * j + 1] = fresh[i * (kept - 1) + j];
        }
        return samples;
    }

    /// Adds the panel's integral for every item that meets its budget (or for all that must end
    /// here) and keeps the others.
    void settle(const PanelRule& rule, const Triple& budget, bool last,
                std::vector<std::size_t>& items, Samples& samples) {
        const std::size_t points = rule.wavelength_nm.size();
        Triple per_coefficient{};
        for (std::size_t c = 0; c < 3; ++c)
            per_coefficient[c] = error_per_coefficient(rule.moment[c]);
        std::size_t left = 0;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::span<const SpectrumSample> f(samples.data() + i * points, points);
            const Triple error = estimate(rule, per_coefficient, f);
            bool met = true;
            for (std::size_t c = 0; c < 3; ++c) met = met && error[c] <= budget[c];
            const std::size_t item = items[i];
            if (met || last || results_[item].evaluations >= limits_.evaluations) {
                add(rule, f, error, item);
            } else {
                std::copy(f.begin(), f.end(), samples.begin() + static_cast<long>(left * points));
                items[left++] = item;
            }
        }
        items.resize(left);
        samples.resize(left * points);
    }

    /// Error of the panel's X, Y, Z.
    static Triple estimate(const PanelRule& rule, const Triple& per_coefficient,
                           std::span<const SpectrumSample> f) {
        const std::size_t points = f.size();
        std::vector<double> values(points), coefficients(points);
        for (std::size_t j = 0; j < points; ++j) values[j] = f[j].value;
        chebyshev_transform(points - 1)(values, coefficients);
        const double last = last_coefficients(coefficients);
        std::vector<bool> marked(points, false);
        for (std::size_t which = 0; which < 2; ++which) mark_hidden_zeros(rule.x, f, which, marked);
        Triple error{};
        for (std::size_t c = 0; c < 3; ++c) {
            error[c] = per_coefficient[c] * last;
            for (std::size_t j = 0; j < points; ++j)
                if (marked[j]) error[c] += std::abs(rule.weight[c][j]);
        }
        return error;
    }

    /// The reference value's own integral is the exact white, so only differences are summed.
    void add(const PanelRule& rule, std::span<const SpectrumSample> f, const Triple& error,
             std::size_t item) {
        const double reference = reference_[item].value;
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t j = 0; j < f.size(); ++j)
                sum += rule.weight[c][j] * (f[j].value - reference);
            results_[item].xyz[c] += sum;
            errors_[item][c] += error[c];
        }
    }

    const Sensitivity& sensitivity_;
    const SpectraAt& spectra_;
    IntegrationLimits limits_;
    std::vector<ColorIntegral> results_;
    std::vector<Triple> errors_;             ///< of each channel
    std::vector<SpectrumSample> reference_;  ///< each item at the short end
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
