#include "core/colorimetry/difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/degrees.hpp"

namespace irido {
namespace {

/// Cube root, continued by its tangent below (6/29)^3.
double lab_curve(double t) {
    constexpr double delta = 6.0 / 29;
    if (t > delta * delta * delta) return std::cbrt(t);
    return t / (3 * delta * delta) + 4.0 / 29;
}

/// sqrt(C^7 / (C^7 + 25^7)), which rises from 0 to 1 around chroma 25.
double chroma_step(double chroma) {
    const double power = std::pow(chroma / 25, 7);
    return std::sqrt(power / (power + 1));
}

/// One colour after stretching the a axis: eqs. 5 to 7.
struct Stretched {
    Stretched(const Triple& lab, double g) : chroma(std::hypot((1 + g) * lab[1], lab[2])) {
        if (chroma == 0) return;
        hue_deg = std::atan2(lab[2], (1 + g) * lab[1]) * 180 / std::numbers::pi;
        if (hue_deg < 0) hue_deg += 360;
    }
    double chroma;
    double hue_deg = 0;  ///< [0, 360], 0 for greys
};

struct Hues {
    double difference_deg;  ///< second - first, eq. 10
    double mean_deg;        ///< halfway on the shorter arc, eq. 14
};

/// The formula is discontinuous at opposite hues, which are assigned to the arc that avoids 0
/// degrees. The margin, a thousand rounding errors of a hue, keeps them there.
Hues compare_hues(const Stretched& p, const Stretched& q) {
    constexpr double opposite_deg = 180 + 1e-10;
    const double difference = q.hue_deg - p.hue_deg;
    const double sum = p.hue_deg + q.hue_deg;
    if (p.chroma == 0 || q.chroma == 0) return {0, sum};
    if (std::abs(difference) <= opposite_deg) return {difference, sum / 2};
    return {difference - std::copysign(360, difference), (sum < 360 ? sum + 360 : sum - 360) / 2};
}

/// T of eq. 15.
double hue_weight(double h) {
    return 1 - 0.17 * cos_deg(h - 30) + 0.24 * cos_deg(2 * h) + 0.32 * cos_deg(3 * h + 6) -
           0.20 * cos_deg(4 * h - 63);
}

/// R_T of eqs. 16, 17 and 21.
double rotation(double mean_chroma, double mean_hue_deg) {
    const double offset = (mean_hue_deg - 275) / 25;
    return -2 * chroma_step(mean_chroma) * sin_deg(60 * std::exp(-offset * offset));
}

}  // namespace

double largest_difference(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

Triple lab(const Triple& xyz, const Triple& white) {
    for (const double component : white) require_in_range("white XYZ", component, 1e-6, 1e6);
    const double x = lab_curve(xyz[0] / white[0]);
    const double y = lab_curve(xyz[1] / white[1]);
    const double z = lab_curve(xyz[2] / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double lab_slope(double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? 1 / (3 * std::cbrt(t * t)) : 1 / (3 * delta * delta);
}

double lab_error(const Triple& xyz, const Triple& white, double error) {
    Triple moved;
    for (std::size_t i = 0; i < 3; ++i)
        moved[i] = error / white[i] * lab_slope((xyz[i] - error) / white[i]);
    return std::max({116 * moved[1], 500 * (moved[0] + moved[1]), 200 * (moved[1] + moved[2])});
}

double xyz_tolerance(const Triple& white, double tolerance) {
    constexpr double kOfDifferences = 5;  // weights of the differences, and three coordinates
    return tolerance / (kOfDifferences * lab_error({0, 0, 0}, white, 1));
}

double delta_e_76(const Triple& lab1, const Triple& lab2) {
    return std::hypot(lab1[0] - lab2[0], lab1[1] - lab2[1], lab1[2] - lab2[2]);
}

double delta_e_cmc(const Triple& standard, const Triple& sample, double l, double c) {
    const double chroma = std::hypot(standard[1], standard[2]);
    const double hue = chroma > 0 ? std::atan2(standard[2], standard[1]) / kDegree : 0;
    const double hue_deg = hue < 0 ? hue + 360 : hue;
    const double t = hue_deg >= 164 && hue_deg <= 345
                         ? 0.56 + std::abs(0.2 * cos_deg(hue_deg + 168))
                         : 0.36 + std::abs(0.4 * cos_deg(hue_deg + 35));
    const double fourth = std::pow(chroma, 4);
    const double f = std::sqrt(fourth / (fourth + 1900));
    const double s_l =
        standard[0] < 16 ? 0.511 : 0.040975 * standard[0] / (1 + 0.01765 * standard[0]);
    const double s_c = 0.0638 * chroma / (1 + 0.0131 * chroma) + 0.638;
    const double s_h = s_c * (f * t + 1 - f);
    const double d_l = sample[0] - standard[0];
    const double sample_chroma = std::hypot(sample[1], sample[2]);
    const double turn = std::atan2(standard[1] * sample[2] - standard[2] * sample[1],
                                   standard[1] * sample[1] + standard[2] * sample[2]);
    const double d_c = sample_chroma - chroma;
    const double d_h = 2 * std::sqrt(chroma * sample_chroma) * std::sin(turn / 2);
    return std::hypot(d_l / (l * s_l), d_c / (c * s_c), d_h / s_h);
}

DifferenceParts ciede2000_parts(const Triple& lab1, const Triple& lab2) {
    // Chroma and hue with the a axis stretched for greyish colours.
    const double plain_chroma = (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])) / 2;
    const double g = 0.5 * (1 - chroma_step(plain_chroma));
    const Stretched p(lab1, g);
    const Stretched q(lab2, g);
    const Hues hues = compare_hues(p, q);
    // Means and their weights.
    const double chroma = (p.chroma + q.chroma) / 2;
    const double from_50 = std::pow((lab1[0] + lab2[0]) / 2 - 50, 2);
    const double s_l = 1 + 0.015 * from_50 / std::sqrt(20 + from_50);
    const double s_c = 1 + 0.045 * chroma;
    const double s_h = 1 + 0.015 * chroma * hue_weight(hues.mean_deg);
    // Weighted differences.
    const double l = (lab2[0] - lab1[0]) / s_l;
    const double c = (q.chroma - p.chroma) / s_c;
    const double h = 2 * std::sqrt(p.chroma * q.chroma) * sin_deg(hues.difference_deg / 2) / s_h;
    return {l, c, h, rotation(chroma, hues.mean_deg)};
}

double ciede2000(const Triple& lab1, const Triple& lab2) {
    const auto [l, c, h, rotated] = ciede2000_parts(lab1, lab2);
    return std::sqrt(l * l + c * c + h * h + rotated * c * h);
}

}  // namespace irido
