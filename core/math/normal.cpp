#include "core/math/normal.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace irido {

namespace {

/// log x for x > 0 to about 1 ulp: x = 2^e (1 + s)/(1 - s), log = e log 2 + 2 (s + s^3/3 + ...).
double portable_log(double x) {
    constexpr double kLog2 = 0.693147180559945309417, kSqrtHalf = 0.70710678118654752;
    constexpr int kTerms = 13;  // s^2 <= 0.0295
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < kSqrtHalf) {
        mantissa *= 2;
        --exponent;
    }
    const double s = (mantissa - 1) / (mantissa + 1), square = s * s;
    double sum = 0;
    for (int k = kTerms; k >= 0; --k) sum = sum * square + 1.0 / (2 * k + 1);
    return exponent * kLog2 + 2 * s * sum;
}

using Coefficients = std::array<double, 8>;

double ratio(const Coefficients& above, const Coefficients& below, double x) {
    double numerator = 0, denominator = 0;
    for (int i = 7; i >= 0; --i) {
        numerator = numerator * x + above[static_cast<std::size_t>(i)];
        denominator = denominator * x + below[static_cast<std::size_t>(i)];
    }
    return numerator / denominator;
}

/// |x| at which the tail has that probability, (0, 0.075].
double tail_quantile(double probability) {
    constexpr Coefficients kNear{1.42343711074968357734,    4.63033784615654529590,
                                 5.76949722146069140550,    3.64784832476320460504,
                                 1.27045825245236838258,    2.41780725177450611770e-1,
                                 2.27238449892691845833e-2, 7.74545014278341407640e-4};
    constexpr Coefficients kBelowNear{1,
                                      2.05319162663775882187,
                                      1.67638483018380384940,
                                      6.89767334985100004550e-1,
                                      1.48103976427480074590e-1,
                                      1.51986665636164571966e-2,
                                      5.47593808499534494600e-4,
                                      1.05075007164441684324e-9};
    constexpr Coefficients kFar{6.65790464350110377720,    5.46378491116411436990,
                                1.78482653991729133580,    2.96560571828504891230e-1,
                                2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                2.71155556874348757815e-5, 2.01033439929228813265e-7};
    constexpr Coefficients kBelowFar{1,
                                     5.99832206555887937690e-1,
                                     1.36929880922735805310e-1,
                                     1.48753612908506148525e-2,
                                     7.86869131145613259100e-4,
                                     1.84631831751005468180e-5,
                                     1.42151175831644588870e-7,
                                     2.04426310338993978564e-15};
    constexpr double kSplit = 5;
    const double r = std::sqrt(-portable_log(probability));
    return r <= kSplit ? ratio(kNear, kBelowNear, r - 1.6) : ratio(kFar, kBelowFar, r - kSplit);
}

}  // namespace

double normal_quantile(double p) {
    constexpr Coefficients kMiddle{3.3871328727963666080e0, 1.3314166789178437745e2,
                                   1.9715909503065514427e3, 1.3731693765509461125e4,
                                   4.5921953931549871457e4, 6.7265770927008700853e4,
                                   3.3430575583588128105e4, 2.5090809287301226727e3};
    constexpr Coefficients kBelowMiddle{1,
                                        4.2313330701600911252e1,
                                        6.8718700749205790830e2,
                                        5.3941960214247511077e3,
                                        2.1213794301586595867e4,
                                        3.9307895800092710610e4,
                                        2.8729085735721942674e4,
                                        5.2264952788528545610e3};
    constexpr double kMiddleHalf = 0.425;
    require_in_range("p", p, std::numeric_limits<double>::min(), 1 - 0x1p-53);
    const double q = p - 0.5;
    if (std::abs(q) <= kMiddleHalf)
        return q * ratio(kMiddle, kBelowMiddle, kMiddleHalf * kMiddleHalf - q * q);
    return q < 0 ? -tail_quantile(p) : tail_quantile(1 - p);
}

double normal_deviate(std::uint64_t bits) {
    return normal_quantile((static_cast<double>(bits >> 12) + 0.5) * 0x1p-52);
}

}  // namespace irido
