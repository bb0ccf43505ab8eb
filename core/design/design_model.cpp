#include "core/design/design_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/color/held_stack.hpp"
#include "core/design/color_nodes.hpp"
#include "core/design/material_number.hpp"
#include "core/design/problem_values.hpp"
#include "core/design/row_sums.hpp"
#include "core/design/sheet.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

namespace {

using Quantity = DesignQuantity;

}  // namespace

class DesignModel::Parts {
public:
    Parts(const DesignProblem& problem, SimdLevel simd)
        : problem_(problem), simd_(simd), stack_(problem.stack), written_(stack_) {
        analytic_ = !has_differences(problem);
        find_links();
        for (const DesignTarget& target : problem_.targets)
            if (target.quantity == Quantity::lab) light_of(target.light);
        prepare();
        if (analytic_ && !std::ranges::all_of(level().sheets, [&](const Sheet& sheet) {
                return sheet.has_clear_gaps(written_);
            }))
            analytic_ = false;
        count_rows();
        rows_.weight = row_weights(problem_);
    }

    DesignProblem problem_;
    SimdLevel simd_;
    DesignRows rows_;
    std::size_t evaluations_ = 0;
    bool analytic_ = true;
    std::size_t level_ = 0;

    bool has_colors() const { return !lights_.empty(); }

    void set_level(std::size_t level) {
        level_ = level;
        prepare();
    }

    /// Fills values, residuals and, if wanted, the Jacobian; false if the stack cannot be computed.
    bool compute(std::span<const double> x, bool with_slopes) {
        ++evaluations_;
        try {
            if (!analytic_) return compute_differences(x, with_slopes);
            set(x);
            compute_rows(with_slopes);
        } catch (const DomainError&) {
            return false;
        }
        rows_.objective = objective_of_rows();
        return std::isfinite(rows_.objective);
    }

    double objective_of_rows() const { return objective_of(problem_, rows_); }

    void find_gradient(std::span<double> gradient, double* hessian) {
        sums_.find(problem_, rows_, gradient, hessian);
    }

private:
    /// How the derivative by a free value is obtained.
    struct SlopeLink {
        std::size_t slot;
        std::size_t number = kNoSlot;  ///< of a material; kNoSlot for a thickness
    };

    /// An observer and illuminant with colour targets.
    struct Lit {
        TargetLight light;
        std::shared_ptr<const ColorTables> tables;
    };

    /// Its quadrature at the wavelengths of one level.
    struct LitGrid {
        std::array<std::vector<double>, 3> weight;
        std::unique_ptr<IndexGrid> grid;
    };

    /// Sheets of all targets, with colours at one level.
    struct Level {
        std::vector<std::unique_ptr<IndexGrid>> grids;
        std::vector<LitGrid> lights;  ///< parallel to lights_
        std::vector<Sheet> sheets;
        std::vector<std::vector<std::size_t>> places;  ///< indices of sheets, [target][angle]
    };

    void find_links() {
        slots_.of_layer.assign(written_.layers.size(), kNoSlot);
        slots_.of_material.assign(stack_.materials.size(), kNoSlot);
        links_.resize(problem_.free.size());
        for (std::size_t p = 0; p < problem_.free.size(); ++p)
            for (const FreePlace& place : problem_.free[p].places) {
                if (const auto* thickness = std::get_if<ThicknessOf>(&place)) {
                    std::size_t& slot = slots_.of_layer[written_.place_of.at(thickness->layer)];
                    if (slot == kNoSlot) slot = slots_.count++;
                    links_[p].push_back({slot});
                } else if (const auto* number = std::get_if<MaterialNumber>(&place)) {
                    std::size_t& slot = slots_.of_material[number->material];
                    if (slot == kNoSlot) slot = slots_.count++;
                    links_[p].push_back({slot, numbers_.size()});
                    numbers_.push_back(*number);
                }
            }
    }

    std::size_t light_of(const TargetLight& light) {
        for (std::size_t i = 0; i < lights_.size(); ++i)
            if (lights_[i].light == light) return i;
        lights_.push_back({light, color_tables_of(light.observer_deg, light.illuminant)});
        return lights_.size() - 1;
    }

    const IndexGrid& grid_of(Level& level, const std::vector<double>& wavelengths) const {
        for (const auto& grid : level.grids)
            if (grid->wavelength_nm == wavelengths) return *grid;
        level.grids.push_back(std::make_unique<IndexGrid>(stack_, wavelengths, numbers_));
        return *level.grids.back();
    }

    static std::size_t sheet_of(Level& level, const IndexGrid& grid, double angle_deg) {
        for (std::size_t i = 0; i < level.sheets.size(); ++i)
            if (&level.sheets[i].grid() == &grid && level.sheets[i].angle_deg() == angle_deg)
                return i;
        level.sheets.emplace_back(grid, angle_deg);
        return level.sheets.size() - 1;
    }

    /// Levels are prepared on first use.
    void prepare() {
        if (!analytic_ || levels_[level_]) return;
        levels_[level_] = std::make_unique<Level>();
        Level& level = *levels_[level_];
        for (const Lit& lit : lights_) {
            QuadratureNodes nodes = color_nodes(stack_, *lit.tables, level_);
            level.lights.push_back(
                {std::move(nodes.weight),
                 std::make_unique<IndexGrid>(held_stack(stack_, lit.tables->sensitivity()),
                                             std::move(nodes.wavelength_nm), numbers_)});
            for (std::vector<double>& row : level.lights.back().weight)
                row.resize(level.lights.back().grid->stride, 0);
        }
        for (const DesignTarget& target : problem_.targets) {
            if (target.quantity == Quantity::total_thickness_nm) {
                level.places.emplace_back();
                continue;
            }
            const IndexGrid& grid = target.quantity == Quantity::lab
                                        ? *level.lights[light_of(target.light)].grid
                                        : grid_of(level, target.wavelength_nm);
            level.places.emplace_back();
            for (const double angle_deg : target.angle_deg) {
                const std::size_t sheet = sheet_of(level, grid, angle_deg);
                Sheet::add_needs(target, level.sheets[sheet].needs);
                level.places.back().push_back(sheet);
            }
        }
        for (Sheet& sheet : level.sheets) {
            sheet.set_media(stack_);
            sheet.set_layers(stack_, written_, slots_);
        }
    }

    Level& level() { return *levels_[level_]; }

    void count_rows() {
        std::size_t rows = 0, values = 0;
        for (const DesignTarget& target : problem_.targets) {
            first_row_.push_back(rows);
            first_value_.push_back(values);
            const std::size_t each = target.quantity == Quantity::lab ? 3 : 1;
            rows += each * entry_count(target);
            values += each * entry_count(target);
        }
        rows_.value.assign(values, 0);
        rows_.residual.assign(rows, 0);
        rows_.jacobian.assign(rows * problem_.free.size(), 0);
    }

    void set(std::span<const double> x) {
        const bool moved = set_values(problem_, x, stack_);
        if (moved) {
            written_ = WrittenOut(stack_);
        } else {
            for (std::size_t p = 0; p < x.size(); ++p)
                for (const FreePlace& place : problem_.free[p].places)
                    if (const auto* thickness = std::get_if<ThicknessOf>(&place))
                        written_.layers[written_.place_of.at(thickness->layer)].thickness_nm = x[p];
        }
        for (std::size_t m = 0; m < stack_.materials.size(); ++m) {
            if (slots_.of_material[m] == kNoSlot) continue;
            for (const auto& grid : level().grids) grid->update(stack_, m, numbers_);
            for (LitGrid& lit : level().lights) {
                Stack held = stack_;  // of a few materials
                for (Material& material : held.materials) material.outside = Outside::clamp;
                lit.grid->update(held, m, numbers_);
            }
            for (Sheet& sheet : level().sheets) sheet.set_medium(stack_, m);
        }
    }

    bool is_lossless(const IndexGrid& grid) const {
        const auto is_clear = [&](std::size_t material) {
            return slots_.of_material[material] == kNoSlot &&
                   std::ranges::all_of(grid.n_im[material], [](double k) { return k == 0; });
        };
        return is_clear(stack_.substrate) &&
               std::ranges::all_of(written_.layers,
                                   [&](const Layer& layer) { return is_clear(layer.material); });
    }

    void compute_rows(bool with_slopes) {
        for (Sheet& sheet : level().sheets) {
            sheet.is_lossless = is_lossless(sheet.grid());
            sheet.compute(written_, slots_, with_slopes, simd_);
        }
        if (with_slopes) std::ranges::fill(rows_.jacobian, 0.0);
        for (std::size_t t = 0; t < problem_.targets.size(); ++t) {
            if (problem_.targets[t].quantity == Quantity::lab) {
                add_colors(t, with_slopes);
            } else if (problem_.targets[t].quantity == Quantity::total_thickness_nm) {
                add_thickness(t, with_slopes);
            } else {
                add_spectra(t, with_slopes);
            }
        }
    }

    /// Derivatives with respect to a free value at a sheet's wavelengths: of r or ln t
    /// (amplitudes), or half of those of R or T in `re`.
    struct SlopeRows {
        const double *re, *im;
    };
    SlopeRows slope_rows(const Sheet& sheet, const SlopeAnswer& answer, bool transmitted,
                         std::size_t free) {
        const std::size_t stride = sheet.grid().stride;
        const std::vector<double>& all = transmitted ? answer.transmitted : answer.reflected;
        const std::vector<SlopeLink>& links = links_[free];
        if (links.size() == 1 && links[0].number == kNoSlot)
            return {answer.row(all, links[0].slot, false, stride),
                    answer.row(all, links[0].slot, true, stride)};
        for (std::vector<double>& row : combined_) row.assign(stride, 0);
        for (const SlopeLink& link : links) {
            const double* re = answer.row(all, link.slot, false, stride);
            const double* im = answer.row(all, link.slot, true, stride);
            if (link.number == kNoSlot) {
                for (std::size_t w = 0; w < stride; ++w) {
                    combined_[0][w] += re[w];
                    combined_[1][w] += im[w];
                }
                continue;
            }
            const double* slope_re = sheet.grid().slope_re[link.number].data();
            const double* slope_im = sheet.grid().slope_im[link.number].data();
            for (std::size_t w = 0; w < stride; ++w) {
                combined_[0][w] += re[w] * slope_re[w] - im[w] * slope_im[w];
                combined_[1][w] += re[w] * slope_im[w] + im[w] * slope_re[w];
            }
        }
        return {combined_[0].data(), combined_[1].data()};
    }

    /// Adds share dR/dx (or dT/dx) to out.
    void add_power_slope(const Sheet& sheet, const SlopeAnswer& answer, bool transmitted,
                         std::size_t free, double share, double* out) {
        const std::size_t count = sheet.count();
        if (transmitted && sheet.is_lossless && !sheet.needs.amplitudes)
            return add_power_slope(sheet, answer, false, free, -share, out);
        const SlopeRows slope = slope_rows(sheet, answer, transmitted, free);
        if (!sheet.needs.amplitudes) {
            for (std::size_t w = 0; w < count; ++w) out[w] += 2 * share * slope.re[w];
        } else if (transmitted) {
            for (std::size_t w = 0; w < count; ++w) out[w] += 2 * share * answer.T[w] * slope.re[w];
        } else {
            for (std::size_t w = 0; w < count; ++w)
                out[w] += 2 * share * (answer.r_re[w] * slope.re[w] + answer.r_im[w] * slope.im[w]);
        }
    }

    static double of_power(Quantity quantity, const SlopeAnswer& answer, std::size_t w) {
        if (quantity == Quantity::R) return answer.R[w];
        return quantity == Quantity::T ? answer.T[w] : 1 - answer.R[w] - answer.T[w];
    }

    void add_spectra(std::size_t t, bool with_slopes) {
        const DesignTarget& target = problem_.targets[t];
        const std::size_t count = target.wavelength_nm.size();
        std::size_t row = first_row_[t], value = first_value_[t];
        const bool is_one = is_of_both(target.quantity);
        for (std::size_t a = 0; a < target.angle_deg.size(); ++a) {
            const Sheet& sheet = level().sheets[level().places[t][a]];
            const std::size_t lights = is_one ? 1 : target.polarizations.size();
            for (std::size_t l = 0; l < lights; ++l, row += count, value += count) {
                const Light light = target.polarizations[is_one ? 0 : l];
                if (needs_amplitudes(target.quantity)) {
                    add_angles(sheet, target.quantity, light, row, value, with_slopes);
                } else {
                    add_powers(sheet, target.quantity, light, row, value, with_slopes);
                }
                settle(problem_, t, row - first_row_[t], count, rows_.value.data() + value,
                       rows_.residual.data() + row);
                if (!with_slopes || target.side == TargetSide::equal) continue;
                for (std::size_t w = 0; w < count; ++w)
                    if (rows_.residual[row + w] == 0)
                        for (std::size_t p = 0; p < links_.size(); ++p) column(p)[row + w] = 0;
            }
        }
    }

    void add_thickness(std::size_t t, bool with_slopes) {
        const std::size_t row = first_row_[t], value = first_value_[t];
        rows_.value[value] = total_thickness(stack_.elements);
        settle(problem_, t, 0, 1, rows_.value.data() + value, rows_.residual.data() + row);
        if (!with_slopes ||
            (problem_.targets[t].side != TargetSide::equal && rows_.residual[row] == 0))
            return;
        std::vector<double> repeats(written_.layers.size(), 0);
        for (const std::uint32_t layer : written_.sequence) ++repeats[layer];
        for (std::size_t p = 0; p < links_.size(); ++p)
            for (const FreePlace& place : problem_.free[p].places)
                if (const auto* thickness = std::get_if<ThicknessOf>(&place))
                    column(p)[row] += repeats[written_.place_of.at(thickness->layer)];
    }

    double* column(std::size_t free) {
        return rows_.jacobian.data() + free * rows_.residual.size();
    }

    void add_powers(const Sheet& sheet, Quantity quantity, Light light, std::size_t row,
                    std::size_t value, bool with_slopes) {
        const std::size_t count = sheet.count();
        std::fill_n(rows_.value.data() + value, count, 0.0);
        for (const Polarization one : {Polarization::s, Polarization::p}) {
            if (light == (one == Polarization::s ? Light::p : Light::s)) continue;
            const double share = light == Light::unpolarized ? 0.5 : 1;
            const SlopeAnswer& answer = sheet.answer(one);
            for (std::size_t w = 0; w < count; ++w)
                rows_.value[value + w] += share * of_power(quantity, answer, w);
            if (!with_slopes) continue;
            for (std::size_t p = 0; p < links_.size(); ++p) {
                if (links_[p].empty()) continue;
                double* const out = column(p) + row;
                if (quantity != Quantity::T)
                    add_power_slope(sheet, answer, false, p,
                                    quantity == Quantity::A ? -share : share, out);
                if (quantity != Quantity::R)
                    add_power_slope(sheet, answer, true, p,
                                    quantity == Quantity::A ? -share : share, out);
            }
        }
    }

    void add_angles(const Sheet& sheet, Quantity quantity, Light light, std::size_t row,
                    std::size_t value, bool with_slopes) {
        const std::size_t count = sheet.count();
        const SlopeAnswer& s = sheet.answer(Polarization::s);
        const SlopeAnswer& p = sheet.answer(Polarization::p);
        const bool transmitted = quantity == Quantity::phase_t_deg;
        const SlopeAnswer& own = light == Light::p ? p : s;
        for (std::size_t w = 0; w < count; ++w) {
            const Complex r_s{s.r_re.empty() ? 0 : s.r_re[w], s.r_im.empty() ? 0 : s.r_im[w]};
            const Complex r_p{p.r_re.empty() ? 0 : p.r_re[w], p.r_im.empty() ? 0 : p.r_im[w]};
            const Complex t{own.t_re[w], own.t_im[w]};
            rows_.value[value + w] = angle_value(quantity, r_s, r_p,
                                                 transmitted         ? t
                                                 : light == Light::p ? r_p
                                                                     : r_s);
        }
        if (!with_slopes) return;
        for (std::size_t f = 0; f < links_.size(); ++f) {
            if (links_[f].empty()) continue;
            double* const out = column(f) + row;
            if (quantity == Quantity::phase_r_deg || transmitted) {
                add_log_slope(sheet, own, transmitted, f, 1, {}, out);
                continue;
            }
            const bool is_psi = quantity == Quantity::psi_deg;
            const double sign = quantity == Quantity::delta_nebraska_deg ? -1 : 1;
            add_log_slope(sheet, p, false, f, sign, is_psi ? rows_.value.data() + value : nullptr,
                          out);
            add_log_slope(sheet, s, false, f, -sign, is_psi ? rows_.value.data() + value : nullptr,
                          out);
        }
    }

    /// Adds share times the derivative of the phase of r or t, in degrees, or, if psi is given,
    /// sin(2 psi)/2 Re(dr/r) in degrees.
    void add_log_slope(const Sheet& sheet, const SlopeAnswer& answer, bool transmitted,
                       std::size_t free, double share, const double* psi_deg, double* out) {
        const SlopeRows slope = slope_rows(sheet, answer, transmitted, free);
        for (std::size_t w = 0; w < sheet.count(); ++w) {
            Complex log_slope{slope.re[w], slope.im[w]};
            if (!transmitted) {
                const Complex r{answer.r_re[w], answer.r_im[w]};
                if (r == 0.0) continue;
                log_slope /= r;
            }
            const double of = psi_deg ? std::sin(2 * psi_deg[w] * kDegree) / 2 * log_slope.real()
                                      : log_slope.imag();
            out[w] += share * of / kDegree;
        }
    }

    void add_colors(std::size_t t, bool with_slopes) {
        const DesignTarget& target = problem_.targets[t];
        const std::size_t number = light_of(target.light);
        const LitGrid& lit = level().lights[number];
        const Triple& white = lights_[number].tables->sensitivity().white();
        const bool transmitted = target.light.side == Side::transmitted;
        std::size_t row = first_row_[t], value = first_value_[t], entry = 0;
        power_.resize(lit.grid->stride);
        for (std::size_t a = 0; a < target.angle_deg.size(); ++a) {
            const Sheet& sheet = level().sheets[level().places[t][a]];
            for (const Light light : target.polarizations) {
                const auto xyz_of = [&](const double* power) {
                    Triple xyz;
                    for (std::size_t c = 0; c < 3; ++c)
                        xyz[c] = sum_of_products(lit.weight[c].data(), power, lit.grid->stride);
                    return xyz;
                };
                const auto for_lights = [&](const auto& call) {
                    if (light != Light::p) call(Polarization::s, light == Light::s ? 1 : 0.5);
                    if (light != Light::s) call(Polarization::p, light == Light::p ? 1 : 0.5);
                };
                std::ranges::fill(power_, 0.0);
                for_lights([&](Polarization one, double share) {
                    const SlopeAnswer& answer = sheet.answer(one);
                    const std::vector<double>& all = transmitted ? answer.T : answer.R;
                    for (std::size_t w = 0; w < sheet.count(); ++w) power_[w] += share * all[w];
                });
                const LabSlopes color = lab_slopes(xyz_of(power_.data()), white);
                const DifferenceSlopes difference = difference_slopes(
                    color.lab, target.lab[entry], problem_.merit == MeritKind::delta_e_2000);
                for (std::size_t c = 0; c < 3; ++c) {
                    rows_.value[value + c] = color.lab[c];
                    rows_.residual[row + c] = difference.number[c];
                }
                for (std::size_t p = 0; with_slopes && p < links_.size(); ++p) {
                    if (links_[p].empty()) continue;
                    std::ranges::fill(power_, 0.0);
                    for_lights([&](Polarization one, double share) {
                        add_power_slope(sheet, sheet.answer(one), transmitted, p, share,
                                        power_.data());
                    });
                    const Triple by_free = xyz_of(power_.data());
                    Triple lab_by_free{};
                    for (std::size_t i = 0; i < 3; ++i)
                        for (std::size_t j = 0; j < 3; ++j)
                            lab_by_free[i] += color.by_xyz[i][j] * by_free[j];
                    for (std::size_t i = 0; i < 3; ++i)
                        for (std::size_t j = 0; j < 3; ++j)
                            column(p)[row + i] += difference.by_lab[i][j] * lab_by_free[j];
                }
                row += 3;
                value += 3;
                ++entry;
            }
        }
    }

    /// Values as other commands compute them, with derivatives by finite differences.
    bool compute_differences(std::span<const double> x, bool with_slopes) {
        constexpr double kTolerance = 1e-7;
        const auto rows_at = [&](std::span<const double> at) {
            DesignRows rows;
            compute_values(problem_, stack_of(problem_, at), kTolerance, simd_, rows);
            return rows;
        };
        const DesignRows here = rows_at(x);
        rows_.value = here.value;
        rows_.residual = here.residual;
        rows_.objective = objective_of_rows();
        if (!std::isfinite(rows_.objective)) return false;
        std::vector<double> moved(x.begin(), x.end());
        for (std::size_t p = 0; with_slopes && p < x.size(); ++p) {
            const FreeValue& value = problem_.free[p];
            if (value.is_integer || !(value.low < value.high)) continue;
            const double step = 1e-5 * std::max({std::abs(x[p]), 1.0});
            const double above = std::min(x[p] + step, value.high);
            const double below = std::max(x[p] - step, value.low);
            moved[p] = above;
            const DesignRows more = rows_at(moved);
            moved[p] = below;
            const DesignRows less = rows_at(moved);
            moved[p] = x[p];
            evaluations_ += 2;
            for (std::size_t i = 0; i < here.residual.size(); ++i) {
                double change = more.residual[i] - less.residual[i];
                if (std::abs(change) > 180 && !has_colors()) change -= std::copysign(360, change);
                column(p)[i] = change / (above - below);
            }
        }
        return true;
    }

    Stack stack_;
    WrittenOut written_;
    SlopeSlots slots_;
    std::vector<std::vector<SlopeLink>> links_;  ///< [free]
    std::vector<MaterialNumber> numbers_;
    std::vector<Lit> lights_;
    std::array<std::unique_ptr<Level>, kColorLevels> levels_;
    std::vector<std::size_t> first_row_, first_value_;
    std::array<std::vector<double>, 2> combined_;
    std::vector<double> power_;
    RowSums sums_;
};

DesignModel::DesignModel(const DesignProblem& problem, SimdLevel simd)
    : parts_(std::make_unique<Parts>(problem, simd)) {}
DesignModel::~DesignModel() = default;
DesignModel::DesignModel(DesignModel&&) noexcept = default;

const DesignProblem& DesignModel::problem() const {
    return parts_->problem_;
}

std::vector<double> DesignModel::start() const {
    std::vector<double> x;
    for (const FreeValue& value : problem().free)
        x.push_back(std::clamp(value.start, value.low, value.high));
    return x;
}

double DesignModel::objective(std::span<const double> x) {
    return parts_->compute(x, false) ? parts_->rows_.objective : kInfinity;
}

double DesignModel::objective(std::span<const double> x, std::span<double> gradient) {
    if (!parts_->compute(x, true)) return kInfinity;
    parts_->find_gradient(gradient, nullptr);
    return parts_->rows_.objective;
}

double DesignModel::objective(std::span<const double> x, std::span<double> gradient,
                              std::span<double> hessian) {
    if (!parts_->compute(x, true)) return kInfinity;
    parts_->find_gradient(gradient, hessian.data());
    return parts_->rows_.objective;
}

const DesignRows& DesignModel::rows() const {
    return parts_->rows_;
}

double DesignModel::merit(double objective) const {
    return merit_of(problem().merit, objective);
}

std::size_t DesignModel::evaluations() const {
    return parts_->evaluations_;
}

bool DesignModel::has_colors() const {
    return parts_->has_colors();
}

bool DesignModel::is_analytic() const {
    return parts_->analytic_;
}

bool DesignModel::adapt_colors(std::span<const double> x, double tolerance) {
    if (!has_colors() || !is_analytic()) return false;
    const std::size_t before = parts_->level_;
    std::vector<double> values;
    for (std::size_t level = before;; ++level) {
        if (level != parts_->level_) parts_->set_level(level);
        if (!parts_->compute(x, false)) break;
        const std::vector<double> finer = parts_->rows_.value;
        if (!values.empty()) {
            double change = 0;
            for (std::size_t i = 0; i < values.size(); ++i)
                change = std::max(change, std::abs(finer[i] - values[i]));
            if (change <= tolerance) {
                parts_->set_level(level - 1);
                break;
            }
        }
        values = finer;
        if (level + 1 == kColorLevels) break;
    }
    return parts_->level_ != before;
}

}  // namespace irido
