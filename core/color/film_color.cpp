#include "core/color/film_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/color/film_orders.hpp"
#include "core/color/held_stack.hpp"
#include "core/error.hpp"
#include "core/interference/film.hpp"
#include "core/interference/index_table.hpp"

namespace irido {

namespace {

constexpr Complex kI{0, 1};
constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where BB17 takes the indices of X, Y and Z (section 4, Validation).
constexpr std::array<double, 3> kPeaks_nm{600, 560, 450};

/// Error of a colour from rounding, of the Fresnel terms above all.
constexpr double kRounding = 1e-13;

/// Standard deviations within which a Gaussian has all but 1e-15 of its weight.
constexpr double kReach = 8;

constexpr double kThickest_nm = 1e9;

/// The only layer of a stack, nullptr if there is none or more.
const Layer* only_layer(const std::vector<Element>& elements) {
    if (elements.size() != 1) return nullptr;
    if (const Layer* layer = std::get_if<Layer>(&elements.front().value)) return layer;
    const Group& group = std::get<Group>(elements.front().value);
    return group.repeat == 1 ? only_layer(group.elements) : nullptr;
}

bool is_real(const Material& material) {
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    if (!index) return false;
    if (const auto* k = std::get_if<Constant>(&index->k)) return k->value == 0;
    const auto* k = std::get_if<Table>(&index->k);
    return k && std::ranges::all_of(k->value, [](double value) { return value == 0; });
}

/// Share of the light in s and in p.
std::array<double, 2> weights(Light light, double cos_theta) {
    if (light == Light::s || cos_theta == 1) return {1, 0};  // both are one at normal incidence
    if (light == Light::p) return {0, 1};
    return {0.5, 0.5};
}

/// Three indices at one wavelength, the film's thickness to be filled in.
Film film_at(const IndexTable& table, const Stack& stack, std::size_t wavelength) {
    return {table.n(stack.incident)[wavelength], table.n(only_film(stack).material)[wavelength],
            table.index(stack.substrate, wavelength), 0};
}

/// The film's thicknesses, whose spread is that of a Gaussian.
struct Thickness {
    double mean_nm, sigma_nm;

    explicit Thickness(const Layer& layer)
        : mean_nm(layer.thickness_nm), sigma_nm(layer.thickness_sigma_nm) {
        require_in_range("thickness_nm", mean_nm, 0, kThickest_nm);
        require_in_range("thickness_sigma_nm", sigma_nm, 0, kThickest_nm);
        mean_nm = std::max(mean_nm, 1e-9 * sigma_nm);  // the spread is taken in parts of the mean
    }
    bool vanishes() const { return mean_nm == 0 && sigma_nm == 0; }
    /// Of the Gaussian.
    double part_below_zero() const {
        return sigma_nm == 0 ? 0 : std::erfc(mean_nm / sigma_nm / std::numbers::sqrt2) / 2;
    }
    /// A film of no thickness is none: the incident medium goes on.
    Film of(Film film) const {
        if (vanishes()) film.film = film.incident;
        film.thickness_nm = mean_nm;
        return film;
    }
};

/// What every colour of one call needs.
struct Lighting {
    const Triple& white;
    std::span<const Side> sides;
    ColorMethod::Kind method;
    std::size_t evaluations;

    /// The colours of all sides, from the transmitted one.
    void store(const Triple& transmitted, double error, std::span<StackColor> colors) const {
        for (std::size_t s = 0; s < sides.size(); ++s) {
            colors[s] = {transmitted, error, evaluations, method};
            if (sides[s] == Side::transmitted) continue;
            for (std::size_t c = 0; c < 3; ++c) colors[s].xyz[c] = white[c] - transmitted[c];
        }
    }
};

class ConstantFilm : public ColorAlgorithm {
public:
    ConstantFilm(const ColorTables& tables, const Stack& stack, const ColorMethod& method,
                 const ColorRequest& request)
        : sensitivity_(tables.sensitivity()),
          transform_(tables.transform(request.tolerance / 8)),
          limits_{request.tolerance / 20, method.count},
          method_(method.kind),
          request_(request) {
        film_ = film_at(IndexTable(stack, {kPeaks_nm[1]}), stack, 0);
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const Thickness thickness(only_film(stack));
        const Film film = thickness.of(film_);
        std::array<Start, kTogether> starts;
        std::array<FilmOrders, kTogether> orders;
        std::array<OrderSum, kTogether> sums;
        const std::size_t sides = request_.sides.size();
        for (std::size_t begin = 0; begin < angles_deg.size(); begin += kTogether) {
            const std::size_t count = std::min(kTogether, angles_deg.size() - begin);
            for (std::size_t i = 0; i < count; ++i)
                starts[i] = start(film, angles_deg[begin + i], orders[i]);
            const std::span of_count = std::span(orders).first(count);
            if (thickness.sigma_nm == 0) {
                sum_orders(transform_, of_count, limits_, sums, request_.simd);
            } else {
                sum_damped(of_count, thickness, sums);
            }
            for (std::size_t i = 0; i < count; ++i)
                store(starts[i], sums[i], colors.subspan((begin + i) * sides, sides));
        }
    }

private:
    static constexpr std::size_t kTogether = 8;

    struct Start {
        double T = 0;      ///< without fringes
        double error = 0;  ///< of each channel, as part of the white
    };

    Start start(const Film& film, double angle_deg, FilmOrders& orders) const {
        const double cosine = cos_of_incidence(angle_deg);
        const std::array share = weights(request_.light, cosine);
        Start result;
        orders = {};
        for (std::size_t k = 0; k < 2; ++k) {
            if (share[k] == 0) continue;
            const auto series =
                film_series(film, cosine, k == 0 ? Polarization::s : Polarization::p);
            if (!series) return {0, film.base.imag() < 0 ? kInfinity : 1};
            orders.opd_nm = series->opd_nm;
            orders.weight[k] = share[k] * series->T;
            orders.bounce[k] = series->bounce;
            result.T += orders.weight[k];
        }
        return result;
    }

    void store(const Start& start, const OrderSum& sum, std::span<StackColor> colors) const {
        const Triple& white = sensitivity_.white();
        Triple transmitted{};
        for (std::size_t c = 0; c < 3; ++c) transmitted[c] = start.T * white[c] + sum.xyz[c];
        const double error = start.error * std::ranges::max(white) + sum.error + kRounding;
        Lighting{white, request_.sides, method_, 1}.store(transmitted, error, colors);
    }

    /// sum_orders() with every order damped by its spread of path, summed over the points of the
    /// sensitivity.
    void sum_damped(std::span<const FilmOrders> orders, const Thickness& thickness,
                    std::span<OrderSum> sums) const {
        const double relative_sigma = thickness.sigma_nm / thickness.mean_nm;
        double longest = 0;
        std::array<std::size_t, kTogether> counts{};
        for (std::size_t i = 0; i < orders.size(); ++i) {
            counts[i] = damped_count(orders[i], relative_sigma, sums[i]);
            longest = std::max(longest, static_cast<double>(counts[i]) * orders[i].opd_nm);
        }
        const SensitivityPoints points = sensitivity_points(sensitivity_, longest);
        for (std::size_t i = 0; i < orders.size(); ++i) {
            const auto& [opd_nm, weight, bounce] = orders[i];
            std::array<Complex, 2> term{2 * weight[0], 2 * weight[1]};
            for (std::size_t m = 1; m <= counts[i]; ++m) {
                for (std::size_t k = 0; k < 2; ++k) term[k] *= bounce[k];
                const double path = static_cast<double>(m) * opd_nm;
                const double variance = std::pow(path * relative_sigma, 2);
                const ComplexTriple h = transform_at(points, path, variance);
                for (std::size_t c = 0; c < 3; ++c)
                    sums[i].xyz[c] += ((term[0] + term[1]) * h[c]).real();
            }
            sums[i].error += cut(orders[i], thickness);
        }
    }

    /// Orders to sum; the error of the others goes into `sum`.
    std::size_t damped_count(const FilmOrders& orders, double relative_sigma, OrderSum& sum) const {
        sum = {};
        const double lowest_nu = 1 / sensitivity_.support().last_nm;
        std::array<double, 2> rest{}, ratio{};
        for (std::size_t k = 0; k < 2; ++k) {
            ratio[k] = std::abs(orders.bounce[k]);
            if (orders.weight[k] != 0)
                rest[k] = 2 * std::abs(orders.weight[k]) * ratio[k] / (1 - ratio[k]);
        }
        for (std::size_t m = 1;; ++m) {
            const double path = static_cast<double>(m) * orders.opd_nm;
            const double sigma = path * relative_sigma, turn = kTwoPi * lowest_nu * sigma;
            const double damping = std::exp(-turn * turn / 2) * transform_.bound(0);
            const double nearby = transform_.bound(std::max(0.0, path - kReach * sigma)) + 1e-15;
            sum.error = (rest[0] + rest[1]) * std::min(damping, nearby);
            const bool ends = limits_.last > 0 && m > limits_.last;
            if (sum.error <= limits_.tolerance || ends || path > transform_.opd_max_nm())
                return m - 1;
            for (std::size_t k = 0; k < 2; ++k) rest[k] *= ratio[k];
        }
    }

    /// What the part of the Gaussian below zero, where the series goes on and StackPower is cut,
    /// can do to the mean: no more than the whole depth of the fringes.
    double cut(const FilmOrders& orders, const Thickness& thickness) const {
        double depth = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double ratio = std::abs(orders.bounce[k]);
            if (orders.weight[k] != 0)
                depth += std::abs(orders.weight[k]) * 4 * ratio / (1 - ratio * ratio);
        }
        return thickness.part_below_zero() * depth * std::ranges::max(sensitivity_.white());
    }

    const Sensitivity& sensitivity_;
    const SensitivityTransform& transform_;
    OrderLimits limits_;
    ColorMethod::Kind method_;
    ColorRequest request_;
    Film film_;
};

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
          constant_(method.kind == ColorMethod::Kind::fourier_constant),
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
        const Lighting lighting{white_, request_.sides, method_.kind, films_.size()};
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const double cosine = cos_of_incidence(angles_deg[i]);
            const std::array share = weights(request_.light, cosine);
            Triple transmitted{};
            for (std::size_t k = 0; k < 2; ++k) {
                if (share[k] == 0) continue;
                const Polarization polarization = k == 0 ? Polarization::s : Polarization::p;
                for (std::size_t c = 0; c < 3; ++c)
                    transmitted[c] += share[k] * channel(c, thickness, cosine, polarization);
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

    double channel(std::size_t c, const Thickness& thickness, double cosine,
                   Polarization polarization) const {
        const ChannelPoints& points = points_[c];
        const auto a = film_series(thickness.of(films_[2 * c]), cosine, polarization);
        const auto b = film_series(thickness.of(films_[2 * c + 1]), cosine, polarization);
        if (!a || !b) return 0;
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

bool is_one_film(const Stack& stack) {
    if (stack.elements.empty()) return true;
    const Layer* layer = only_layer(stack.elements);
    return layer && layer->coherent && is_real(stack.materials[layer->material]);
}

Layer only_film(const Stack& stack) {
    if (stack.elements.empty()) return {.material = stack.incident};
    return *only_layer(stack.elements);
}

bool has_dispersion(const Stack& stack) {
    const auto varies = [&](std::size_t material) {
        return !is_constant(stack.materials[material]);
    };
    return varies(stack.incident) || varies(only_film(stack).material) || varies(stack.substrate);
}

std::unique_ptr<ColorAlgorithm> film_color(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request) {
    require_in_range("tolerance", request.tolerance, 1e-12, 1);
    if (!is_one_film(stack))
        throw DomainError("the Fourier method needs one coherent film of a real index over a base");
    if (!has_dispersion(stack))
        return std::make_unique<ConstantFilm>(tables, stack, method, request);
    return std::make_unique<DispersiveFilm>(tables, held_stack(stack, tables.sensitivity()), method,
                                            request);
}

}  // namespace irido
