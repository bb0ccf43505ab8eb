
#include "core/color/fourier/film_parts.hpp"
#include "core/math/constants.hpp"
#include "core/math/imaginary.hpp"

namespace irido {

namespace {

/// The nearest path that SensitivityTransform takes.
Complex admitted(Complex path_nm) {
    constexpr double steepest = SensitivityTransform::kSteepest_nm;
    return {path_nm.real(), std::clamp(path_nm.imag(), -steepest, steepest)};
}

/// Films with dispersion: for each channel the logarithms of T_0, of one bounce with its turn and
/// of the damping by a spread are taken to be linear in nu, which makes of order m a complex path.
class DispersiveFilm : public ColorAlgorithm {
public:
    DispersiveFilm(const ColorTables& tables, const Stack& stack, const ColorMethod& method,
                   const ColorRequest& request)
        : white_(tables.sensitivity().white()),
          transform_(tables.transform(request.tolerance / 8)),
          tolerance_(request.tolerance / 2),
          constant_(method.is("fourier-constant")),
          method_(method),
          request_(request) {
        if (constant_) {
            for (std::size_t c = 0; c < 3; ++c)
                points_[c] = {{1 / kPeaks_nm[c], 1 / kPeaks_nm[c]}, {0.5, 0.5}};
        } else {
            points_ = tables.channel_points();
        }
        std::vector<double> wavelengths;
        for (const ChannelPoints& points : points_)
            for (const double nu : points.nu) wavelengths.push_back(1 / nu);
        const IndexTable table(stack, wavelengths);
        for (std::size_t i = 0; i < films_.size(); ++i) films_[i] = film_at(table, stack, i);
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const Thickness thickness(only_film(stack));
        const std::size_t sides = request_.sides.size();
        const Lighting lighting{white_, request_.sides, method_.kind->name, films_.size()};
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const double cosine = cos_of_incidence(angles_deg[i]);
            const std::array share = weights(request_.light, cosine);
            Triple transmitted{};
            for (std::size_t k = 0; k < 2; ++k) {
                if (share[k] == 0) continue;
                const Polarization polarization = k == 0 ? Polarization::s : Polarization::p;
                for (std::size_t c = 0; c < 3; ++c)
                    transmitted[c] += share[k] * channel(c, thickness, angles_deg[i], polarization);
            }
            lighting.store(transmitted, kInfinity, colors.subspan(i * sides, sides));
        }
    }

private:
    /// Value at the channel's centroid and slope of a logarithm.
    struct Line {
        Complex value, slope;
    };

    Line line(const ChannelPoints& points, Complex a, Complex b) const {
        const Complex difference = b - a;
        if (constant_) return {a, 0};
        return {a + points.weight[1] * difference, difference / (points.nu[1] - points.nu[0])};
    }

    double channel(std::size_t c, const Thickness& thickness, double angle_deg,
                   Polarization polarization) const {
        const IncidentAngle at = incident_angle(angle_deg);
        const ChannelPoints& points = points_[c];
        const auto a = film_series(thickness.of(films_[2 * c]), at, polarization);
        const auto b = film_series(thickness.of(films_[2 * c + 1]), at, polarization);
        if (!a || !b) throw no_series(angle_deg);
        const double mean = points.weight[0] * a->T + points.weight[1] * b->T;
        double sum = mean * white_[c];
        if (a->T * b->T <= 0 || a->bounce * b->bounce == 0.0) return sum;
        Line T = line(points, std::log(a->T), std::log(b->T));
        const Complex turn_a = kTwoPi * kI * a->opd_nm * points.nu[0];
        const Complex turn_b = kTwoPi * kI * b->opd_nm * points.nu[1];
        const Complex bounce_a = std::log(a->bounce);
        Line bounce =
            line(points, bounce_a + turn_a, bounce_a + std::log(b->bounce / a->bounce) + turn_b);
        if (constant_) bounce.slope = kTwoPi * kI * a->opd_nm;
        const auto damping = [&](Complex turn) {
            const double sigma = thickness.sigma_nm / thickness.mean_nm;
            return thickness.sigma_nm == 0 ? 0 : turn * turn * sigma * sigma / 2.0;
        };
        const Line spread = line(points, damping(turn_a), damping(turn_b));
        const double ratio = std::max(a->ratio(), b->ratio());
        double rest = 2 * std::max(a->T, b->T) / (1 - ratio);
        for (std::size_t m = 1; method_.count == 0 || m <= method_.count; ++m) {
            const double order = static_cast<double>(m);
            const Complex path =
                admitted((T.slope + order * (bounce.slope + order * spread.slope)) / (kTwoPi * kI));
            rest *= ratio;
            if (std::abs(path.real()) > transform_.opd_max_nm()) break;
            if (rest * transform_.bound(std::abs(path.real())) <= tolerance_) break;
            const Complex value = T.value + order * (bounce.value + order * spread.value);
            const Complex back = -kTwoPi * kI * path * points.centroid();
            sum += 2 * (std::exp(value + back) * transform_.channel(c, path)).real();
        }
        return sum;
    }

    const Triple& white_;
    const SensitivityTransform& transform_;
    double tolerance_;
    bool constant_;
    ColorMethod method_;
    ColorRequest request_;
    std::array<ChannelPoints, 3> points_;
    std::array<Film, 6> films_;  ///< [channel][point]
};

}  // namespace

std::unique_ptr<ColorAlgorithm> dispersive_film_color(const ColorTables& tables, const Stack& held,
                                                      const ColorMethod& method,
                                                      const ColorRequest& request) {
    return std::make_unique<DispersiveFilm>(tables, held, method, request);
}

}  // namespace irido
