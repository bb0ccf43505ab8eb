#include "core/math/sine_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

/// From here on the asymptotic series is accurate to 16 digits.
constexpr double kAsymptotic = 40;

/// a and b in long double. From E_1(i x) = exp(-i x) (g - i f) and the continued fraction
///     exp(z) E_1(z) = 1/(z + 1 - 1/(z + 3 - 4/(z + 5 - 9/(z + 7 - ...)))),
/// evaluated backwards.
std::array<long double, 2> auxiliary_of(long double x) {
    using Wide = std::complex<long double>;
    constexpr int kTerms = 160;
    const Wide z(0, x);
    Wide tail = 0;
    for (int n = kTerms; n > 0; --n)
        tail = static_cast<long double>(n) * static_cast<long double>(n) /
               (z + static_cast<long double>(2 * n + 1) - tail);
    const Wide value = Wide(1) / (z + 1.0L - tail);
    const long double f = -value.imag(), g = value.real();
    return {x * x * (1 - x * f), x * x * g};
}

/// a and b as piecewise polynomials in 1/x between kAsymptotic and kFirstAuxiliary.
class AuxiliaryPieces {
public:
    AuxiliaryPieces() {
        for (std::size_t p = 0; p < kPieces; ++p) {
            std::array<std::array<long double, 2>, kDegree + 1> values{};
            for (std::size_t j = 0; j <= kDegree; ++j)
                values[j] = auxiliary_of(1 / (middle(p) + kHalf * node(j)));
            for (std::size_t k = 0; k <= kDegree; ++k)
                for (std::size_t part = 0; part < 2; ++part) {
                    long double sum = 0;
                    for (std::size_t j = 0; j <= kDegree; ++j)
                        sum += values[j][part] *
                               std::cos(std::numbers::pi_v<long double> *
                                        static_cast<long double>(k * (2 * j + 1)) / (2 * kCount));
                    coefficient_[p][part][k] = static_cast<double>((k == 0 ? 1 : 2) * sum / kCount);
                }
        }
    }

    AuxiliarySine operator()(double x) const {
        const double place = (1 / x - kLow) / (2 * kHalf);
        const auto p = static_cast<std::size_t>(
            std::clamp(std::floor(place), 0.0, static_cast<double>(kPieces - 1)));
        const double s = 2 * (place - static_cast<double>(p)) - 1;
        return {sum(coefficient_[p][0], s), sum(coefficient_[p][1], s)};
    }

private:
    static constexpr std::size_t kPieces = 6, kDegree = 18;
    static constexpr long double kCount = kDegree + 1;
    static constexpr double kLow = 1 / kAsymptotic;
    static constexpr double kHalf = (1 / kFirstAuxiliary - kLow) / (2 * kPieces);
    using Coefficients = std::array<double, kDegree + 1>;

    static long double middle(std::size_t p) {
        return kLow + kHalf * static_cast<long double>(2 * p + 1);
    }
    static long double node(std::size_t j) {
        return std::cos(std::numbers::pi_v<long double> * static_cast<long double>(2 * j + 1) /
                        (2 * kCount));
    }
    /// Clenshaw's recurrence.
    static double sum(const Coefficients& c, double s) {
        double first = 0, second = 0;
        for (std::size_t k = kDegree; k > 0; --k) {
            const double next = 2 * s * first - second + c[k];
            second = first;
            first = next;
        }
        return s * first - second + c[0];
    }

    std::array<std::array<Coefficients, 2>, kPieces> coefficient_{};
};

/// x f = 1 - 2!/x^2 + 4!/x^4 ..., x^2 g = 1 - 3!/x^2 + 5!/x^4 ...
AuxiliarySine asymptotic(double x) {
    constexpr int kTerms = 14;
    const double s = 1 / (x * x);
    double a = 0, b = 0;
    for (int n = kTerms; n > 0; --n) {
        a = 2.0 * n * (2 * n - 1) * (1 - s * a);
        b = s * 2.0 * n * (2 * n + 1) * (1 - b);
    }
    return {a, 1 - b};
}

double sinc_squared(double x) {
    if (std::abs(x) < 1e-4) return 1 - x * x / 3;
    const double sinc = std::sin(x) / x;
    return sinc * sinc;
}

/// pi/2 - F(x) for x >= kFirstAuxiliary.
double slit_rest(double x) {
    if (std::isinf(x)) return 0;
    const auto [a, b] = auxiliary_sine(x);
    return (1 - (a * std::cos(x) / x - b * std::sin(x)) / x) / x;
}

}  // namespace

AuxiliarySine auxiliary_sine(double x) {
    require_in_range("x", x, kFirstAuxiliary, kInfinity);
    if (std::isinf(x)) return {2, 1};
    static const AuxiliaryPieces pieces;
    return x < kAsymptotic ? pieces(x) : asymptotic(x);
}

double sine_integral(double x) {
    if (x < 0) return -sine_integral(-x);
    if (std::isinf(x)) return kPi / 2;
    if (x >= kFirstAuxiliary) {
        const auto [a, b] = auxiliary_sine(x);
        return kPi / 2 - ((1 - a / (x * x)) * std::cos(x) + b / x * std::sin(x)) / x;
    }
    // sum of (-1)^k x^(2k+1)/((2k+1) (2k+1)!)
    double term = x, sum = x;
    for (int k = 1; std::abs(term) > 1e-18 * sum; ++k) {
        term *= -x * x / ((2.0 * k) * (2 * k + 1));
        sum += term / (2 * k + 1);
    }
    return sum;
}

double slit_integral(double x) {
    if (x < 0) return -slit_integral(-x);
    if (x >= kFirstAuxiliary) return kPi / 2 - slit_rest(x);
    // sum of (-1)^k x^(2k+1)/((2k+1) (2k+2)!)
    double term = x / 2, sum = term;
    for (int k = 1; std::abs(term) > 1e-18 * sum; ++k) {
        term *= -x * x / ((2.0 * k + 1) * (2 * k + 2));
        sum += term / (2 * k + 1);
    }
    return sum;
}

double slit_integral(double from, double to) {
    constexpr double kShort = 6;
    if (std::abs(to - from) < kShort) {
        const double half = (to - from) / 2, middle = from + half;
        double sum = 0;
        for (const GaussNode& node : gauss_legendre<24>())
            sum += node.weight * sinc_squared((middle + half * node.x) / 2);
        return half / 2 * sum;
    }
    if (from >= kFirstAuxiliary && to >= kFirstAuxiliary) return slit_rest(from) - slit_rest(to);
    if (from <= -kFirstAuxiliary && to <= -kFirstAuxiliary)
        return slit_rest(-to) - slit_rest(-from);
    return slit_integral(to) - slit_integral(from);
}

}  // namespace irido
