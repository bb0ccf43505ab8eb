#include <algorithm>
#include <array>
#include <cmath>

#include "core/coherent/fresnel.hpp"
#include "core/color/bloch/one_mirror.hpp"
#include "core/color/color_method.hpp"
#include "core/color/fourier/film_parts.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

/// The constants of w~ and of its linear regression. Source: FPB24 appendix B.
constexpr double kSlope = 0.735, kOffset = 0.532;

/// Of the first layer.
double cos_inside(const OneMirror& mirror, double cos_theta) {
    const double n = mirror.first.n;
    return std::sqrt(std::max(0.0, medium(n, mirror.n_in, cos_theta).q2.real())) / n;
}

double angular_weight(const OneMirror& mirror, double cos_theta) {
    const double w0 = kSlope * normal_reflectance(mirror.first.n, mirror.second.n) + kOffset;
    return w0 + (1 - w0) * std::pow(1 - cos_inside(mirror, cos_theta), 5);
}

/// R of very many periods, its fringes at their highest.
double envelope(const BraggPeriod& period, double omega) {
    const double a = omega * period.path1_nm, b = omega * period.path2_nm;
    const double q = period.admittance_ratio, sin_b = std::sin(b);
    const double C = (q - 1 / q) / 2 * sin_b;
    const double cosine = std::cos(a) * std::cos(b) - (q + 1 / q) / 2 * std::sin(a) * sin_b;
    const double sin2 = std::max(0.0, (1 - cosine) * (1 + cosine));
    return C * C + sin2 > 0 ? C * C / (C * C + sin2) : 0;
}

class LandmarkColor : public ColorAlgorithm {
public:
    LandmarkColor(const ColorTables& tables, std::size_t subdivisions, const ColorRequest& request)
        : cumulative_(tables.cumulative()),
          sensitivity_(tables.sensitivity()),
          subdivisions_(static_cast<double>(subdivisions)),
          request_(request) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const OneMirror mirror = one_mirror("landmarks", stack);
        const std::size_t sides = request_.sides.size();
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const double cos_theta = cos_of_incidence(angles_deg[i]);
            const double weight = angular_weight(mirror, cos_theta);
            const std::array share = weights(request_.light, cos_theta);
            Triple T{};
            std::size_t boxes = 0;
            for (std::size_t k = 0; k < 2; ++k) {
                if (share[k] == 0 || cos_theta == 0) continue;
                const auto polarization = k == 0 ? Polarization::s : Polarization::p;
                const Triple R = reflected(
                    bragg_period(mirror.first, mirror.second, mirror.n_in, cos_theta, polarization),
                    weight, boxes);
                for (std::size_t c = 0; c < 3; ++c)
                    T[c] += share[k] * (sensitivity_.white()[c] - R[c]);
            }
            Lighting{sensitivity_.white(), request_.sides, "landmarks", boxes}.store(
                T, std::numeric_limits<double>::infinity(), colors.subspan(i * sides, sides));
        }
    }

private:
    /// The boxes side by side, from long wavelengths on.
    struct Boxes {
        const CumulativeSensitivity& cumulative;
        double omega = 0;
        Triple before{};  ///< cumulative at omega
        Triple R{};
        std::size_t count = 0;

        void add(double to, double height) {
            const Triple at = cumulative(2 * kPi / to);
            for (std::size_t c = 0; c < 3; ++c) R[c] += height * (before[c] - at[c]);
            before = at;
            omega = to;
            ++count;
        }
    };

    /// X, Y, Z of one polarization.
    Triple reflected(const BraggPeriod& period, double weight, std::size_t& count) const {
        const auto [first_nm, last_nm] = sensitivity_.support();
        const double low = 2 * kPi / last_nm, high = 2 * kPi / first_nm;
        const double path = period.path1_nm + period.path2_nm;
        if (!((high - low) * path / kPi <= kMostOrders))
            throw DomainError("gaps in the visible range must be at most " + to_text(kMostOrders));
        Boxes boxes{cumulative_};
        boxes.before = sensitivity_.white();
        // the band below the gap of order m + 1, at least one before the range
        double m = std::max(0.0, std::floor(low * path / kPi) - 1);
        boxes.omega = m > 0 ? band_gap(period, m, Roots::quick).high_per_nm : 0;
        for (; boxes.omega < high; ++m) {
            const double airy = omega_of_airy(period, m, Roots::quick);
            const BandGap gap = band_gap(period, m + 1, Roots::quick);
            add_half_band(period, weight, airy, m, boxes);
            add_half_band(period, weight, gap.low_per_nm, m + 1, boxes);
            if (gap.is_open()) boxes.add(gap.high_per_nm, 1);
        }
        count += boxes.count;
        return boxes.R;
    }

    /// From where the boxes end up to `to`, cut at zeros of the envelope.
    void add_half_band(const BraggPeriod& period, double weight, double to, double order,
                       Boxes& boxes) const {
        double z = std::floor(boxes.omega * period.path2_nm / kPi) + 1;
        for (double zero = omega_of_zero(period, z); zero < to; zero = omega_of_zero(period, ++z))
            if (zero > boxes.omega) add_boxes(period, weight, zero, order, boxes);
        add_boxes(period, weight, to, order, boxes);
    }

    void add_boxes(const BraggPeriod& period, double weight, double to, double order,
                   Boxes& boxes) const {
        const double parts = std::max(1.0, subdivisions_ - order), from = boxes.omega;
        if (!(from < to)) return;
        for (double i = 1; i <= parts; ++i) {
            const double end = i == parts ? to : from + (to - from) * i / parts;
            boxes.add(end, weight * envelope(period, (boxes.omega + end) / 2));
        }
    }

    const CumulativeSensitivity& cumulative_;
    const Sensitivity& sensitivity_;
    double subdivisions_;
    ColorRequest request_;
};

constexpr std::array<std::size_t, 5> kFirstSubdivisions{1, 2, 3, 4, 5};

std::unique_ptr<ColorAlgorithm> landmark_color(const ColorTables& tables, const Stack&,
                                               const ColorMethod& method,
                                               const ColorRequest& request) {
    require_in_range("subdivisions", static_cast<double>(method.count), 1, 1000);
    return std::make_unique<LandmarkColor>(tables, method.count, request);
}

}  // namespace

/// FPB24's piecewise constant reflectance of a mirror of very many periods (eq. 15): boxes between
/// consecutive landmarks (ends of gaps, Airy points, zeros of the envelope), as high as the box
///     in a gap:  1
///     else:      w~(theta) R^e(middle), R^e = |C|^2 / (|C|^2 + sin^2 KL),
///                w~ = w0 + (1 - w0)(1 - cos theta)^5, w0 = 0.735 R12 + 0.532
/// with |C| = |q - 1/q|/2 |sin b|, R12 the reflectance of an interface of both layers at normal
/// incidence and theta the angle in the first one: each adds what CumulativeSensitivity has between
/// its ends. Boxes next to the gap of order m, between it and an Airy point, are split into
/// max(1, s - m) equal ones, s = method.count; there is one of order 0 below the first Airy point.
/// N and the media around the periods do not matter. T = 1 - R; s and p are averaged.
/// The algorithm throws DomainError as bragg_period() does, and where more than kMostOrders gaps
/// are in the visible range. Source: FPB24 (CGF 43(2), 2024), section 3.2 and appendix B.
extern constinit const ColorMethodKind color_method_landmarks = {
    .name = "landmarks",
    .place = 6,
    .number = {.fewest = 1, .most = 1000, .fallback = 1},
    .help = "landmarks: boxes between the landmarks of such a group (see bands)",
    .trials = {.counts = kFirstSubdivisions, .what = "FPB24's boxes, subdivided by `parameter`"},
    .fault = [](const Stack& stack,
                const ColorRequest&) { return mirror_fault("landmarks", stack); },
    .prepare = landmark_color,
};

}  // namespace irido
