#include "core/colorimetry/sensitivity_transform.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"
#include "core/math/transform.hpp"
#include "core/math/vector_math.hpp"

namespace irido {

namespace {

constexpr double kLongestPath = 1e7;

/// Phase in radians of the fastest wave over a piece that 8, or 16, Gauss points integrate to a
/// relative 2e-15.
constexpr double kTurnOf8 = 3, kTurnOf16 = 12;

/// Error of a value due to rounding and to the sums over the points, relative to the white.
constexpr double kRounding = 5e-14;

template <int count>
void add_points(const Sensitivity& sensitivity, double first_nm, double last_nm,
                SensitivityPoints& points) {
    const double half = (last_nm - first_nm) / 2, middle = (last_nm + first_nm) / 2;
    for (const GaussNode& node : gauss_legendre<count>()) {
        const double wavelength = middle + half * node.x;
        const Triple s = sensitivity.at(wavelength);
        points.wavenumber.push_back(1 / wavelength);
        for (std::size_t c = 0; c < 3; ++c) points.weight[c].push_back(half * node.weight * s[c]);
    }
}

/// exp(-2 pi^2 var nu^2)
double damping(double wavenumber, double variance_nm2) {
    return std::exp(-kTwoPi * std::numbers::pi * variance_nm2 * wavenumber * wavenumber);
}

/// Index of the table interval whose centre is nearest to an optical path difference.
std::size_t interval_of(double opd_nm) {
    return static_cast<std::size_t>(std::floor(opd_nm / SensitivityTransform::kInterval_nm + 0.5));
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double chebyshev_point(std::size_t k, std::size_t count) {
    return std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(count));
}

/// Coefficients of powers (rows) from values at Chebyshev points (columns). Computed in long double
/// to compensate for the ill-conditioned inverse.
Eigen::MatrixXd polynomial_through_chebyshev_points(std::size_t count) {
    const auto size = static_cast<Eigen::Index>(count);
    Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> powers(size, size);
    for (std::size_t k = 0; k < count; ++k) {
        long double power = 1;
        for (Eigen::Index r = 0; r < size; ++r) {
            powers(static_cast<Eigen::Index>(k), r) = power;
            power *= chebyshev_point(k, count);
        }
    }
    return powers.inverse().cast<double>();
}

}  // namespace

SensitivityPoints sensitivity_points(const Sensitivity& sensitivity, double opd_max_nm) {
    require_in_range("opd_max_nm", opd_max_nm, 0, 2 * kLongestPath);
    const std::vector<double> cells = sensitivity.cells(sensitivity.support());
    SensitivityPoints points;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const double nu_first = 1 / cells[i], nu_last = 1 / cells[i + 1];
        const double turn = kTwoPi * opd_max_nm * (nu_first - nu_last);
        if (turn <= kTurnOf8) {
            add_points<8>(sensitivity, cells[i], cells[i + 1], points);
            continue;
        }
        const int pieces = static_cast<int>(std::ceil(turn / kTurnOf16));
        double from = cells[i];
        for (int k = 1; k <= pieces; ++k) {
            const double to =
                k == pieces ? cells[i + 1] : 1 / (nu_first + (nu_last - nu_first) * k / pieces);
            add_points<16>(sensitivity, from, to, points);
            from = to;
        }
    }
    return points;
}

std::array<ChannelPoints, 3> channel_points(const Sensitivity& sensitivity) {
    const SensitivityPoints points = sensitivity_points(sensitivity, 0);
    std::array<ChannelPoints, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto moment = [&](double centre, int power) {
            double sum = 0;
            for (std::size_t i = 0; i < points.wavenumber.size(); ++i)
                sum += points.weight[c][i] * std::pow(points.wavenumber[i] - centre, power);
            return sum / sensitivity.white()[c];
        };
        const double mean = moment(0, 1), variance = moment(mean, 2);
        const double sigma = std::sqrt(variance), skew = moment(mean, 3) / (variance * sigma);
        const double half = std::sqrt(1 + skew * skew / 4), low = skew / 2 - half,
                     high = skew / 2 + half;
        result[c] = {{mean + sigma * low, mean + sigma * high},
                     {high / (high - low), -low / (high - low)}};
    }
    return result;
}

ComplexTriple transform_at(const SensitivityPoints& points, double opd_nm, double variance_nm2) {
    const std::size_t count = points.wavenumber.size();
    std::vector<double> angle(count), sine(count), cosine(count), less(count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double nu = points.wavenumber[i];
        angle[i] = kTwoPi * opd_nm * nu;
        less[i] = -kTwoPi * std::numbers::pi * variance_nm2 * nu * nu;
    }
    sin_cos(angle, sine, cosine, best_simd_level());
    if (variance_nm2 > 0) expm1(less, less, best_simd_level());
    ComplexTriple sum{};
    for (std::size_t c = 0; c < 3; ++c) {
        double re = 0, im = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double weight = points.weight[c][i] * (1 + less[i]);
            re += weight * cosine[i];
            im += weight * sine[i];
        }
        sum[c] = {re, im};
    }
    return sum;
}

SensitivityTransform::SensitivityTransform(const Sensitivity& sensitivity, double opd_max_nm,
                                           double accuracy, double variance_nm2)
    : opd_max_(opd_max_nm),
      carrier_((1 / sensitivity.support().first_nm + 1 / sensitivity.support().last_nm) / 2) {
    require_in_range("opd_max_nm", opd_max_nm, 0, kLongestPath);
    require_in_range("accuracy", accuracy, 1e-13, 1e-2);
    require_in_range("variance_nm2", variance_nm2, 0, kLongestPath * kLongestPath);
    SensitivityPoints points = sensitivity_points(sensitivity, opd_max_nm + kInterval_nm);
    if (variance_nm2 > 0) {
        for (std::vector<double>& weight : points.weight)
            for (std::size_t i = 0; i < weight.size(); ++i)
                weight[i] *= damping(points.wavenumber[i], variance_nm2);
    }
    set_tail(sensitivity, variance_nm2);
    choose_rows(points, accuracy);
    fill_table(points);
    set_largest();
}

/// J and V. On a cell s is a quadratic in lambda and, with primes for derivatives by lambda,
///     g = s lambda^2,  |dg/dnu| = |2 lambda^3 s + lambda^4 s'|,
///     d(dg/dnu) = -(6 lambda^2 s + 6 lambda^3 s' + lambda^4 s'') dlambda;
/// between cells dg/dnu jumps by lambda^4 times the jump of s'. Damping multiplies g by W; each
/// term of the product's second derivative is bounded by its maximum on the cell.
void SensitivityTransform::set_tail(const Sensitivity& sensitivity, double variance_nm2) {
    const std::vector<double> cells = sensitivity.cells(sensitivity.support());
    const double rate = kTwoPi * kTwoPi * variance_nm2;  // W' = -rate nu W
    Triple jump{}, variation{}, slope_before{};
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        const double first = cells[i], last = cells[i + 1], width = last - first;
        const Triple a = sensitivity.at(first), b = sensitivity.at(first + width / 2),
                     c = sensitivity.at(last);
        const double nu = 1 / first, nu_width = width / (first * last);
        const double before = damping(nu, variance_nm2), damped = damping(1 / last, variance_nm2);
        const double l3 = last * last * last, l4 = l3 * last, l4_first = std::pow(first, 4);
        for (std::size_t j = 0; j < 3; ++j) {
            const double curvature = 4 * (a[j] - 2 * b[j] + c[j]) / (width * width);
            const double slope = (c[j] - a[j]) / width - curvature * width / 2;
            const double slope_after = slope + curvature * width;
            const double s = std::max({std::abs(a[j]), std::abs(b[j]), std::abs(c[j])}) +
                             std::abs(curvature) * width * width / 8;
            const double steepest = std::max(std::abs(slope), std::abs(slope_after));
            const double g1 = 2 * l3 * s + l4 * steepest;
            variation[j] += before * l4_first * std::abs(slope - slope_before[j]);
            variation[j] +=
                damped *
                (width * (6 * last * last * s + 6 * l3 * steepest + l4 * std::abs(curvature)) +
                 nu_width * (2 * rate * nu * g1 + rate * (rate * nu * nu + 1) * s * last * last));
            if (i == 0) {
                const double g = a[j] * first * first;
                jump[j] += before * g;
                variation[j] += before * (2 * std::pow(first, 3) * a[j] + rate * nu * g);
            }
            if (i + 2 == cells.size()) {
                const double g = c[j] * last * last;
                jump[j] += damped * g;
                variation[j] +=
                    damped * (2 * l3 * c[j] + l4 * std::abs(slope_after) + rate / last * g);
            }
            slope_before[j] = slope_after;
        }
    }
    jump_ = std::ranges::max(jump);
    variation_ = std::ranges::max(variation);
}

/// Chooses as few rows as the accuracy allows. The degree-n interpolant of exp(i a x) at n + 1
/// Chebyshev points on [-1, 1] has an error of at most a^(n+1) / (2^n (n+1)!).
void SensitivityTransform::choose_rows(const SensitivityPoints& points, double accuracy) {
    std::vector<double> turn(points.wavenumber.size());  // a
    for (std::size_t i = 0; i < turn.size(); ++i)
        turn[i] = std::numbers::pi * kInterval_nm * std::abs(points.wavenumber[i] - carrier_);
    std::array<std::vector<double>, 3> term;  // |weight| 2 (a/2)^rows / rows!
    for (std::size_t c = 0; c < 3; ++c) {
        for (const double weight : points.weight[c]) term[c].push_back(2 * std::abs(weight));
        at_zero_ = std::max(at_zero_, sum_of(term[c]) / 2);
    }
    double interpolation = 0;
    do {
        ++rows_;
        interpolation = 0;
        for (std::vector<double>& terms : term) {
            for (std::size_t i = 0; i < turn.size(); ++i)
                terms[i] *= turn[i] / (2 * static_cast<double>(rows_));
            interpolation = std::max(interpolation, sum_of(terms));
        }
    } while (interpolation > accuracy);
    error_ = interpolation + kRounding * at_zero_;
}

/// exp(i a x) is the polynomial sum_r q_r(a) x^r, with q_r real for even r and imaginary for odd r.
/// So row r of all intervals is one Fourier sum over the points, with weights times q_r(a).
void SensitivityTransform::fill_table(const SensitivityPoints& points) {
    const std::size_t count = interval_of(opd_max_) + 1;
    const std::size_t size = points.wavenumber.size();
    const Eigen::MatrixXd solve = polynomial_through_chebyshev_points(rows_);
    std::vector<double> turns(size), angle(size), sine(size), cosine(size);
    for (std::size_t i = 0; i < size; ++i)
        turns[i] = (points.wavenumber[i] - carrier_) * kInterval_nm;
    std::vector<std::vector<double>> q(rows_, std::vector<double>(size, 0.0));
    for (std::size_t k = 0; k < rows_; ++k) {
        for (std::size_t i = 0; i < size; ++i)
            angle[i] = std::numbers::pi * turns[i] * chebyshev_point(k, rows_);
        sin_cos(angle, sine, cosine, best_simd_level());
        for (std::size_t r = 0; r < rows_; ++r) {
            const double factor = solve(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k));
            const std::vector<double>& wave = r % 2 == 0 ? cosine : sine;
            for (std::size_t i = 0; i < size; ++i) q[r][i] += factor * wave[i];
        }
    }
    std::vector<std::vector<double>> weights;  // [row][channel]
    for (std::size_t r = 0; r < rows_; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            weights.push_back(points.weight[c]);
            for (std::size_t i = 0; i < size; ++i) weights.back()[i] *= q[r][i];
        }
    }
    const auto sums = transform_of_points(turns, weights, count);
    table_.resize(count * rows_);
    for (std::size_t r = 0; r < rows_; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < count; ++i) {
                const Complex sum = sums[3 * r + c][i];
                const Complex coefficient = r % 2 == 0 ? sum : Complex(-sum.imag(), sum.real());
                table_[i * rows_ + r].value[2 * c] = coefficient.real();
                table_[i * rows_ + r].value[2 * c + 1] = coefficient.imag();
            }
        }
    }
}

/// Values on an interval are bounded by the sum of its coefficients, and by the value at D = 0.
void SensitivityTransform::set_largest() {
    const std::size_t count = table_.size() / rows_;
    largest_.resize(count);
    double beyond = tail((static_cast<double>(count) - 0.5) * kInterval_nm);
    for (std::size_t i = count; i-- > 0;) {
        Triple sum{};
        for (std::size_t r = 0; r < rows_; ++r) {
            const Row& row = table_[i * rows_ + r];
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += std::hypot(row.value[2 * c], row.value[2 * c + 1]);
        }
        beyond = std::max(beyond, std::min(std::ranges::max(sum), at_zero_) + error_);
        largest_[i] = beyond;
    }
}

ComplexTriple SensitivityTransform::operator()(double opd_nm) const {
    require_in_range("opd_nm", opd_nm, 0, opd_max_);
    const std::size_t interval = interval_of(opd_nm);
    const double x = 2 * (opd_nm / kInterval_nm - static_cast<double>(interval));
    const Row* const rows = table_.data() + interval * rows_;
    Row sum = rows[rows_ - 1];
    for (std::size_t r = rows_ - 1; r-- > 0;)
        for (std::size_t i = 0; i < 6; ++i) sum.value[i] = sum.value[i] * x + rows[r].value[i];
    const double turns = opd_nm * carrier_;
    const Complex carrier = std::polar(1.0, kTwoPi * (turns - std::round(turns)));
    ComplexTriple h;
    for (std::size_t c = 0; c < 3; ++c)
        h[c] = carrier * Complex(sum.value[2 * c], sum.value[2 * c + 1]);
    return h;
}

Complex SensitivityTransform::channel(std::size_t channel, Complex opd_nm) const {
    if (opd_nm.real() < 0) return std::conj(this->channel(channel, -std::conj(opd_nm)));
    require_in_range("opd_nm", opd_nm.real(), 0, opd_max_);
    require_in_range("opd_nm (imaginary part)", opd_nm.imag(), -kSteepest_nm, kSteepest_nm);
    const std::size_t interval = interval_of(opd_nm.real());
    const Complex x = 2.0 * (opd_nm / kInterval_nm - static_cast<double>(interval));
    Complex sum = 0;
    for (std::size_t r = rows_; r-- > 0;) {
        const Row& row = table_[interval * rows_ + r];
        sum = sum * x + Complex(row.value[2 * channel], row.value[2 * channel + 1]);
    }
    return sum * std::exp(Complex(0, kTwoPi * carrier_) * opd_nm);
}

double SensitivityTransform::tail(double opd_nm) const {
    const double path = kTwoPi * opd_nm;
    return jump_ / path + variation_ / (path * path);
}

double SensitivityTransform::bound(double opd_nm) const {
    const double end = (static_cast<double>(largest_.size()) - 0.5) * kInterval_nm;
    return opd_nm < end ? largest_[interval_of(opd_nm)] : tail(opd_nm);
}

}  // namespace irido
