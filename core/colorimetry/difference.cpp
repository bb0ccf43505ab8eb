#include "core/colorimetry/difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/math/degrees.hpp"

namespace irido {
namespace {

/// Cube root, continued below (6/29)^3 by its tangent.
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

/// One colour after the stretching of its a axis: eqs. 5 to 7.
struct Stretched {
    Stretched(const Triple& lab, double g) : chroma(std::hypot((1 + g) * lab[1], lab[2])) {
        if (chroma == 0) return;
        hue_deg = std::atan2(lab[2], (1 + g) * lab[1]) * 180 / std::numbers::pi;
        if (hue_deg < 0) hue_deg += 360;
    }
    double chroma;
    double hue_deg = 0;  ///< [0, 360], 0 for a grey
};

struct Hues {
    double difference_deg;  ///< second - first, eq. 10
    double mean_deg;        ///< halfway on the shorter arc, eq. 14
};

/// The formula jumps at opposite hues, which belong to the arc that does not cross 0 degrees. The
/// margin, a thousand roundings of a hue, keeps them there.
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
