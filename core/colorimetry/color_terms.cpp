#include "core/colorimetry/color_terms.hpp"

#include <array>
#include <cmath>
#include <string>

#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {
namespace {

constexpr std::size_t kLocusFirst = 380 - 360, kLocusLast = 699 - 360;  ///< rows of an observer

struct UniformChromaticity {
    double u, v;
};

/// u', v' of a colour other than black.
UniformChromaticity uniform_chromaticity(const Triple& xyz) {
    const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
    return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

double sum(const Triple& v) {
    return v[0] + v[1] + v[2];
}

Chromaticity xy_of(const Triple& xyz) {
    return {xyz[0] / sum(xyz), xyz[1] / sum(xyz)};
}

/// The line from the white through a colour.
class WhiteLine {
public:
    WhiteLine(const Chromaticity& white, const Chromaticity& color)
        : white_(white), dx_(color.x - white.x), dy_(color.y - white.y) {}

    /// Offset of a stimulus from the line and its position along it, both times X + Y + Z and the
    /// distance of the colour from the white: linear in X, Y, Z.
    double beside(const Triple& v) const { return x(v) * dy_ - y(v) * dx_; }
    double along(const Triple& v) const { return x(v) * dx_ + y(v) * dy_; }

    double length() const { return std::hypot(dx_, dy_); }
    /// Distance of the colour from the white, relative to that of a stimulus on the line.
    double share(const Triple& v) const {
        return length() * length() / std::abs(along(v) / sum(v));
    }

private:
    double x(const Triple& v) const { return v[0] - white_.x * sum(v); }
    double y(const Triple& v) const { return v[1] - white_.y * sum(v); }

    Chromaticity white_;
    double dx_, dy_;
};

/// A mixture of two stimuli, where the line crosses the segment between them.
struct Meeting {
    double at;  ///< weight of the second stimulus, [0, 1]
    Triple stimulus;
};

std::optional<Meeting> meeting(const WhiteLine& line, const Triple& a, const Triple& b) {
    const double first = line.beside(a), second = line.beside(b);
    if ((first < 0) == (second < 0)) return {};
    const double t = first / (first - second);
    return Meeting{t,
                   {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}};
}

}  // namespace

ChromaHue chroma_hue(double first, double second) {
    const double chroma = std::hypot(first, second);
    if (chroma < kAchromatic) return {chroma, {}};
    const double hue_deg = std::atan2(second, first) / kDegree;
    if (hue_deg >= 0) return {chroma, hue_deg};
    const double turned = hue_deg + 360;
    return {chroma, turned < 360 ? turned : 0};
}

Triple luv(const Triple& xyz, const Triple& white) {
    const double lightness = lab(xyz, white)[0];
    if (xyz[0] + 15 * xyz[1] + 3 * xyz[2] <= 0) return {lightness, 0, 0};
    const UniformChromaticity of = uniform_chromaticity(xyz), n = uniform_chromaticity(white);
    return {lightness, 13 * lightness * (of.u - n.u), 13 * lightness * (of.v - n.v)};
}

DominantWavelength dominant_wavelength(const Triple& xyz, const Triple& white,
                                       const Observer& observer) {
    constexpr double kAtWhite = 1e-10;
    if (!(sum(xyz) > 0)) return {};
    const WhiteLine line(xy_of(white), xy_of(xyz));
    if (line.length() < kAtWhite) return {};
    const auto row = [&](std::size_t i) {
        return Triple{observer.x[i], observer.y[i], observer.z[i]};
    };
    std::optional<double> behind_nm;
    for (std::size_t i = kLocusFirst; i < kLocusLast; ++i) {
        const auto met = meeting(line, row(i), row(i + 1));
        if (!met) continue;
        const double wavelength_nm = kFirstRow_nm + static_cast<double>(i) + met->at;
        if (line.along(met->stimulus) > 0) return {wavelength_nm, line.share(met->stimulus)};
        behind_nm = wavelength_nm;
    }
    const auto purple = meeting(line, row(kLocusFirst), row(kLocusLast));
    if (!behind_nm || !purple) return {};
    return {-*behind_nm, line.share(purple->stimulus)};
}

Whiteness cie_whiteness(const Triple& xyz, const Triple& white, int observer_degrees) {
    if (observer_degrees != 2 && observer_degrees != 10)
        throw DomainError("observer must be 2 or 10 (degrees; got " +
                          std::to_string(observer_degrees) + ")");
    const Chromaticity n = xy_of(white), of = sum(xyz) > 0 ? xy_of(xyz) : n;
    const double tint_factor = observer_degrees == 2 ? 1000 : 900;
    return {100 * xyz[1] + 800 * (n.x - of.x) + 1700 * (n.y - of.y),
            tint_factor * (n.x - of.x) - 650 * (n.y - of.y)};
}

}  // namespace irido
