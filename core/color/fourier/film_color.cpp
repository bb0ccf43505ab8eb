#include "core/color/fourier/film_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/color/fourier/film_orders.hpp"
#include "core/color/fourier/film_parts.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/color/held_stack.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"

namespace irido {

namespace {

/// Error of a colour from rounding, of the Fresnel terms above all.
constexpr double kRounding = 1e-13;

/// Standard deviations within which a Gaussian has all but 1e-15 of its weight.
constexpr double kReach = 8;

class ConstantFilm : public ColorAlgorithm {
public:
    ConstantFilm(const ColorTables& tables, const Stack& stack, const ColorMethod& method,
                 const ColorRequest& request)
        : sensitivity_(tables.sensitivity()),
          transform_(tables.transform(request.tolerance / 8)),
          limits_{request.tolerance / 20, method.count},
          method_(method.kind->name),
          request_(request) {
        film_ = film_at(IndexTable(stack, {kPeaks_nm[1]}), stack, 0);
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const Thickness thickness(only_film(stack));
        const Film film = thickness.of(film_);
        std::array<double, kTogether> starts;
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

    /// T without fringes, and the orders.
    double start(const Film& film, double angle_deg, FilmOrders& orders) const {
        const IncidentAngle at = incident_angle(angle_deg);
        const std::array share = weights(request_.light, at.cos);
        double T = 0;
        orders = {};
        for (std::size_t k = 0; k < 2; ++k) {
            if (share[k] == 0) continue;
            const auto series = film_series(film, at, k == 0 ? Polarization::s : Polarization::p);
            if (!series) throw no_series(angle_deg);
            orders.opd_nm = series->opd_nm;
            orders.weight[k] = share[k] * series->T;
            orders.bounce[k] = series->bounce;
            T += orders.weight[k];
        }
        return T;
    }

    void store(double T, const OrderSum& sum, std::span<StackColor> colors) const {
        const Triple& white = sensitivity_.white();
        Triple transmitted{};
        for (std::size_t c = 0; c < 3; ++c) transmitted[c] = T * white[c] + sum.xyz[c];
        const double error = limits_.last > 0 ? kInfinity : sum.error + kRounding;
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
    std::string_view method_;
    ColorRequest request_;
    Film film_;
};

}  // namespace

std::string film_fault(const Stack& stack) {
    if (first_uniaxial(stack.materials)) return "a uniaxial medium";
    if (stack.elements.empty()) return "";
    const Layer* layer = only_layer(stack);
    if (!layer) return "more than one layer";
    if (!layer->coherent) return "an incoherent one";
    if (!is_real(stack.materials[layer->material])) return "k other than 0";
    return "";
}

std::string series_fault(const Stack& stack) {
    const std::string fault = film_fault(stack);
    return fault.empty()
               ? ""
               : "the Fourier series needs one coherent film of a real index (got " + fault + ")";
}

bool is_one_film(const Stack& stack) {
    return film_fault(stack).empty();
}

Layer only_film(const Stack& stack) {
    if (stack.elements.empty()) return {.material = stack.incident};
    return *only_layer(stack);
}

bool has_dispersion(const Stack& stack) {
    const auto varies = [&](std::size_t material) {
        return !is_constant(stack.materials[material]);
    };
    return varies(stack.incident) || varies(only_film(stack).material) || varies(stack.substrate);
}

std::unique_ptr<ColorAlgorithm> film_color(const ColorTables& tables, const Stack& stack,
                                           const ColorMethod& method, const ColorRequest& request) {
    if (!has_dispersion(stack))
        return std::make_unique<ConstantFilm>(tables, stack, method, request);
    return dispersive_film_color(tables, held_stack(stack, tables.sensitivity()), method, request);
}

}  // namespace irido
