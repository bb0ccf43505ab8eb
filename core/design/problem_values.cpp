#include "core/design/problem_values.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/media.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/design/color_nodes.hpp"
#include "core/design/material_number.hpp"
#include "core/design/row_sums.hpp"
#include "core/design/written_out.hpp"
#include "core/error.hpp"
#include "core/material/index_series.hpp"
#include "core/spectrum/delay.hpp"
#include "core/spectrum/ellipsometry.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

namespace {

using Quantity = DesignQuantity;

bool is_delay(Quantity quantity) {
    return quantity >= Quantity::gd_r_fs && quantity <= Quantity::tod_t_fs3;
}

bool is_angle(Quantity quantity) {
    return quantity == Quantity::delta_deg || quantity == Quantity::delta_nebraska_deg ||
           quantity == Quantity::phase_r_deg || quantity == Quantity::phase_t_deg;
}

double delay_value(Quantity quantity, const Delays& delays) {
    switch (quantity) {
        case Quantity::gd_r_fs:
            return delays.r.gd_fs;
        case Quantity::gd_t_fs:
            return delays.t.gd_fs;
        case Quantity::gdd_r_fs2:
            return delays.r.gdd_fs2;
        case Quantity::gdd_t_fs2:
            return delays.t.gdd_fs2;
        case Quantity::tod_r_fs3:
            return delays.r.tod_fs3;
        default:
            return delays.t.tod_fs3;
    }
}

/// The values of one target at one angle, [polarization][wavelength].
class TargetValues {
public:
    TargetValues(const DesignTarget& target, const Stack& stack, SimdLevel simd)
        : target_(target),
          stack_(stack),
          power_(stack),
          table_(stack, target.wavelength_nm),
          simd_(simd) {}

    void at(double angle_deg, std::vector<double>& out) {
        const IncidentAngle at = incident_angle(angle_deg);
        if (is_delay(target_.quantity)) return delays_at(at, out);
        const bool amplitudes = is_angle(target_.quantity) || target_.quantity == Quantity::psi_deg;
        if (amplitudes && !power_.has_amplitudes()) return incoherent_at(at, out);
        const Spectra both =
            spectra(power_, table_, std::span(&at, 1), {.amplitudes = amplitudes}, {1, simd_});
        const bool is_one = is_of_both(target_.quantity);
        for (std::size_t l = 0; l < (is_one ? 1 : target_.polarizations.size()); ++l)
            for (std::size_t w = 0; w < target_.wavelength_nm.size(); ++w)
                out.push_back(amplitudes ? angle(both, is_one, l, w)
                                         : power(both, target_.polarizations[l], w));
    }

private:
    double power(const Spectra& both, Light light, std::size_t w) const {
        const auto of = [&](const Spectrum& one) {
            return target_.quantity == Quantity::R   ? one.R[w]
                   : target_.quantity == Quantity::T ? one.T[w]
                                                     : one.A[w];
        };
        if (light == Light::unpolarized) return (of(both.s) + of(both.p)) / 2;
        return of(light == Light::s ? both.s : both.p);
    }

    double angle(const Spectra& both, bool is_one, std::size_t l, std::size_t w) const {
        const Spectrum& own = !is_one && target_.polarizations[l] == Light::p ? both.p : both.s;
        return angle_value(target_.quantity, both.s.r[w], both.p.r[w],
                           target_.quantity == Quantity::phase_t_deg ? own.t[w] : own.r[w]);
    }

    void incoherent_at(IncidentAngle at, std::vector<double>& out) const {
        if (!is_of_both(target_.quantity))
            throw DomainError("phases require coherent layers without thickness_sigma_nm");
        std::vector<Medium> media_s, media_p;
        for (std::size_t w = 0; w < target_.wavelength_nm.size(); ++w) {
            set_media(table_, w, at, Polarization::s, media_s);
            set_media(table_, w, at, Polarization::p, media_p);
            const Ellipsometry angles = ellipsometry(power_, media_s, media_p, table_.k0()[w]);
            const double delta = 180 - angles.delta_nebraska_deg;
            out.push_back(target_.quantity == Quantity::psi_deg     ? angles.psi_deg
                          : target_.quantity == Quantity::delta_deg ? (delta <= -180 ? 180 : delta)
                                                                    : angles.delta_nebraska_deg);
        }
    }

    void delays_at(IncidentAngle at, std::vector<double>& out) const {
        if (!power_.has_amplitudes())
            throw DomainError("delays require coherent layers without thickness_sigma_nm");
        for (const Light light : target_.polarizations)
            for (const double nm : target_.wavelength_nm) {
                const Polarization polarization =
                    light == Light::p ? Polarization::p : Polarization::s;
                std::vector<Series<Complex>> index, extraordinary;
                for (const Material& material : stack_.materials) {
                    index.push_back(index_series(material, nm));
                    extraordinary.push_back(extraordinary_series(material, nm));
                }
                out.push_back(delay_value(
                    target_.quantity, delays(stack_, index, nm, at, polarization, extraordinary)));
            }
    }

    const DesignTarget& target_;
    const Stack& stack_;
    StackPower power_;
    IndexTable table_;
    SimdLevel simd_;
};

/// Appends a colour target's values and residuals.
void add_colors(const DesignTarget& target, const Stack& stack, double tolerance, SimdLevel simd,
                bool ciede2000, DesignRows& rows) {
    const ColorTables tables(
        Sensitivity(observer(target.light.observer_deg), target.light.illuminant));
    const Stack held = held_stack(stack, tables.sensitivity());
    std::size_t entry = 0;
    std::vector<std::vector<StackColor>> colors;
    for (const Light light : target.polarizations) {
        ColorRequest request;
        request.sides = {target.light.side};
        request.light = light;
        request.tolerance = tolerance;
        request.simd = simd;
        colors.push_back(stack_color(tables, held, {}, request, target.angle_deg));
    }
    for (std::size_t a = 0; a < target.angle_deg.size(); ++a)
        for (const std::vector<StackColor>& of_light : colors) {
            const Triple value = lab(of_light[a].xyz, tables.sensitivity().white());
            const Triple number = difference_slopes(value, target.lab[entry++], ciede2000).number;
            rows.value.insert(rows.value.end(), value.begin(), value.end());
            rows.residual.insert(rows.residual.end(), number.begin(), number.end());
        }
}

}  // namespace

bool is_of_both(Quantity quantity) {
    return quantity == Quantity::psi_deg || quantity == Quantity::delta_deg ||
           quantity == Quantity::delta_nebraska_deg;
}

bool has_differences(const DesignProblem& problem) {
    const StackPower power(problem.stack);
    if (power.spread_layers() > 0 || first_uniaxial(problem.stack.materials)) return true;
    for (const DesignTarget& target : problem.targets) {
        const bool amplitudes = is_angle(target.quantity) || target.quantity == Quantity::psi_deg;
        if (is_delay(target.quantity) || (amplitudes && !power.has_amplitudes())) return true;
    }
    std::vector<std::size_t> gaps;
    for (const Element& element : problem.stack.elements) {
        const Layer* const layer = std::get_if<Layer>(&element.value);
        if (layer && !layer->coherent) gaps.push_back(layer->material);
        if (!layer && has_incoherent_layers(std::get<Group>(element.value).elements)) return true;
    }
    for (const FreeValue& value : problem.free)
        for (const FreePlace& place : value.places) {
            if (std::holds_alternative<Rebuilt>(place)) return true;
            const auto* number = std::get_if<MaterialNumber>(&place);
            if (number && number->material == problem.stack.incident) return true;
            if (number && std::ranges::find(gaps, number->material) != gaps.end()) return true;
        }
    return false;
}

bool set_values(const DesignProblem& problem, std::span<const double> x, Stack& stack) {
    bool moved = false;
    for (std::size_t p = 0; p < x.size(); ++p)
        for (const FreePlace& place : problem.free[p].places) {
            if (const auto* thickness = std::get_if<ThicknessOf>(&place)) {
                std::get<Layer>(element_at(stack, thickness->layer)->value).thickness_nm = x[p];
            } else if (const auto* number = std::get_if<MaterialNumber>(&place)) {
                value_of(stack.materials[number->material], *number) = x[p];
            } else if (const auto* repeat = std::get_if<RepeatOf>(&place)) {
                const auto wanted = static_cast<std::uint64_t>(std::llround(x[p]));
                std::uint64_t& has =
                    std::get<Group>(element_at(stack, repeat->group)->value).repeat;
                moved = moved || has != wanted;
                has = wanted;
            }
        }
    return moved;
}

Stack stack_of(const DesignProblem& problem, std::span<const double> x) {
    if (problem.rebuild) return problem.rebuild({x.begin(), x.end()});
    Stack stack = problem.stack;
    set_values(problem, x, stack);
    return stack;
}

std::vector<double> row_weights(const DesignProblem& problem) {
    const bool is_chi2 = problem.merit == MeritKind::chi2;
    double sum = 0;
    for (const DesignTarget& target : problem.targets)
        for (const double weight : target.weight) sum += weight;
    std::vector<double> weights;
    for (const DesignTarget& target : problem.targets)
        for (std::size_t e = 0; e < entry_count(target); ++e) {
            const double weight = is_chi2 ? target.weight[e] / (target.sigma[e] * target.sigma[e])
                                          : target.weight[e] / sum;
            weights.insert(weights.end(), target.quantity == Quantity::lab ? 3 : 1, weight);
        }
    return weights;
}

void settle(const DesignProblem& problem, std::size_t t, std::size_t offset, std::size_t count,
            const double* values, double* residuals) {
    const DesignTarget& target = problem.targets[t];
    for (std::size_t i = 0; i < count; ++i) {
        double e = values[i] - target.target[offset + i];
        if (is_angle(target.quantity)) e -= 360 * std::floor((e + 180) / 360);
        if (target.side == TargetSide::at_least) e = std::min(e, 0.0);
        if (target.side == TargetSide::at_most) e = std::max(e, 0.0);
        residuals[i] = e;
    }
}

double angle_value(Quantity quantity, Complex r_s, Complex r_p, Complex own) {
    switch (quantity) {
        case Quantity::psi_deg:
            return ellipsometric_angles(r_s, r_p).psi_deg;
        case Quantity::delta_deg:
            return ellipsometric_angles(r_s, r_p).delta_deg;
        case Quantity::delta_nebraska_deg:
            return ellipsometry(r_s, r_p).delta_nebraska_deg;
        default:
            return std::arg(own) * 180 / std::numbers::pi;
    }
}

void compute_values(const DesignProblem& problem, const Stack& stack, double tolerance,
                    SimdLevel simd, DesignRows& rows) {
    rows.value.clear();
    rows.residual.clear();
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
        const DesignTarget& target = problem.targets[t];
        if (target.quantity == Quantity::lab) {
            add_colors(target, stack, tolerance, simd, problem.merit == MeritKind::delta_e_2000,
                       rows);
            continue;
        }
        std::vector<double> values;
        if (target.quantity == Quantity::total_thickness_nm) {
            values = {total_thickness(stack.elements)};
        } else {
            TargetValues of_target(target, stack, simd);
            for (const double angle_deg : target.angle_deg) of_target.at(angle_deg, values);
        }
        std::vector<double> residuals(values.size());
        settle(problem, t, 0, values.size(), values.data(), residuals.data());
        rows.value.insert(rows.value.end(), values.begin(), values.end());
        rows.residual.insert(rows.residual.end(), residuals.begin(), residuals.end());
    }
    for (const double residual : rows.residual)
        if (!std::isfinite(residual))
            throw DomainError("a target is undefined where nothing is reflected or transmitted");
}

double objective_of(const DesignProblem& problem, const DesignRows& rows) {
    double sum = 0;
    for_each_entry(problem, rows, [&](std::size_t first, std::size_t, double square) {
        sum += rows.weight[first] *
               (problem.merit == MeritKind::mean_abs ? std::sqrt(square) : square);
    });
    return sum;
}

double merit_of(MeritKind merit, double objective) {
    const bool is_root = merit == MeritKind::rms || merit == MeritKind::delta_e_76 ||
                         merit == MeritKind::delta_e_2000;
    return is_root ? std::sqrt(objective) : objective;
}

double exact_merit(const DesignProblem& problem, std::span<const double> x, DesignRows* rows) {
    constexpr double kTolerance = 1e-9;
    DesignRows own;
    DesignRows& all = rows ? *rows : own;
    compute_values(problem, stack_of(problem, x), kTolerance, best_simd_level(), all);
    all.weight = row_weights(problem);
    all.objective = objective_of(problem, all);
    return merit_of(problem.merit, all.objective);
}

}  // namespace irido
