#include "core/design/sheet.hpp"

#include <algorithm>
#include <cmath>

#include "core/design/material_number.hpp"
#include "core/design/problem_values.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

/// Pads a row with its last value.
void fill_up(std::vector<double>& row, std::size_t count, std::size_t stride) {
    row.resize(stride);
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(count), row.end(), row[count - 1]);
}

/// kz/k0 of the forward wave; q2 = 0, a layer at its critical angle, is shifted slightly.
Complex onward_q(Complex q2) {
    constexpr double kLeast = 1e-24;
    if (std::abs(q2) < kLeast) q2 = kLeast;
    const Complex q =
        q2.imag() == 0 && q2.real() > 0 ? Complex(std::sqrt(q2.real())) : std::sqrt(q2);
    return q.imag() < 0 ? -q : q;
}

}  // namespace

IndexGrid::IndexGrid(const Stack& stack, std::vector<double> wavelengths_nm,
                     std::span<const MaterialNumber> numbers)
    : wavelength_nm(std::move(wavelengths_nm)), stride(whole_vectors(wavelength_nm.size())) {
    const IndexTable table(stack, wavelength_nm);
    const std::size_t count = wavelength_nm.size();
    k0.assign(table.k0().begin(), table.k0().begin() + static_cast<std::ptrdiff_t>(count));
    fill_up(k0, count, stride);
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        n_re.emplace_back(count);
        n_im.emplace_back(count);
        for (std::size_t w = 0; w < count; ++w) {
            n_re.back()[w] = table.n(m, w);
            n_im.back()[w] = m == stack.incident ? 0 : table.k(m, w);
        }
        fill_up(n_re.back(), count, stride);
        fill_up(n_im.back(), count, stride);
    }
    slope_re.resize(numbers.size());
    slope_im.resize(numbers.size());
    for (std::size_t m = 0; m < stack.materials.size(); ++m) update(stack, m, numbers);
}

void IndexGrid::update(const Stack& stack, std::size_t material,
                       std::span<const MaterialNumber> numbers) {
    const std::size_t count = wavelength_nm.size();
    bool is_varied = false;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i].material != material) continue;
        is_varied = true;
        slope_re[i].resize(count);
        slope_im[i].resize(count);
        for (std::size_t w = 0; w < count; ++w) {
            const Complex slope =
                index_slope(stack.materials[material], numbers[i], wavelength_nm[w]);
            slope_re[i][w] = slope.real();
            slope_im[i][w] = slope.imag();
        }
        fill_up(slope_re[i], count, stride);
        fill_up(slope_im[i], count, stride);
    }
    if (!is_varied) return;
    for (std::size_t w = 0; w < count; ++w) {
        const Complex index = index_at(stack.materials[material], wavelength_nm[w]);
        n_re[material][w] = index.real();
        n_im[material][w] = index.imag();
    }
    fill_up(n_re[material], count, stride);
    fill_up(n_im[material], count, stride);
}

bool needs_amplitudes(DesignQuantity quantity) {
    using enum DesignQuantity;
    return is_of_both(quantity) || quantity == phase_r_deg || quantity == phase_t_deg;
}

void Sheet::add_needs(const DesignTarget& target, Needs& needs) {
    using enum DesignQuantity;
    needs.amplitudes = needs.amplitudes || needs_amplitudes(target.quantity);
    for (const Light light : target.polarizations) {
        const bool both = light == Light::unpolarized || is_of_both(target.quantity);
        needs.s = needs.s || both || light == Light::s;
        needs.p = needs.p || both || light == Light::p;
    }
    needs.transmission = needs.transmission || target.quantity == T || target.quantity == A ||
                         target.quantity == phase_t_deg ||
                         (target.quantity == lab && target.light.side == Side::transmitted);
}

void Sheet::set_media(const Stack& stack) {
    media_.resize(stack.materials.size());
    for (std::size_t m = 0; m < media_.size(); ++m) set_medium(stack, m);
    const double cosine = incident_angle(angle_deg_).cos;
    for (std::size_t p = 0; p < 2; ++p) {
        incident_y_[p].resize(grid_->stride);
        for (std::size_t w = 0; w < grid_->stride; ++w) {
            const double n0 = grid_->n_re[stack.incident][w];
            incident_y_[p][w] = p ? n0 / cosine : n0 * cosine;
        }
    }
}

void Sheet::set_medium(const Stack& stack, std::size_t material) {
    const IncidentAngle at = incident_angle(angle_deg_);
    Rows& rows = media_[material];
    const auto put = [](std::array<std::vector<double>, 2>& row, std::size_t w, Complex value) {
        row[0][w] = value.real();
        row[1][w] = value.imag();
    };
    for (auto* pair :
         {&rows.q, &rows.n, &rows.y[0], &rows.y[1], &rows.inverse[0], &rows.inverse[1]})
        for (std::vector<double>& row : *pair) row.resize(grid_->stride);
    rows.is_real = true;
    for (std::size_t w = 0; w < grid_->stride; ++w) {
        const Complex index{grid_->n_re[material][w], grid_->n_im[material][w]};
        const Medium one = medium(index, grid_->n_re[stack.incident][w], at);
        const Complex q = onward_q(one.q2);
        put(rows.n, w, index);
        put(rows.q, w, q);
        put(rows.y[0], w, q);
        put(rows.inverse[0], w, 1.0 / q);
        put(rows.y[1], w, one.eps / q);
        put(rows.inverse[1], w, q / one.eps);
        if (q.imag() != 0 || index.imag() != 0) rows.is_real = false;
    }
}

MediumRows Sheet::rows_of(std::size_t material, bool p) const {
    const Rows& rows = media_[material];
    const std::size_t which = p ? 1 : 0;
    return {rows.q[0].data(),
            rows.q[1].data(),
            rows.y[which][0].data(),
            rows.y[which][1].data(),
            rows.inverse[which][0].data(),
            rows.inverse[which][1].data(),
            rows.n[0].data(),
            rows.n[1].data(),
            rows.is_real};
}

void Sheet::set_layers(const Stack& stack, const WrittenOut& written, const SlopeSlots& slots) {
    incident_ = stack.incident;
    substrate_ = stack.substrate;
    for (std::size_t p = 0; p < 2; ++p) {
        layers_[p].clear();
        for (std::size_t l = 0; l < written.layers.size(); ++l) {
            const Layer& layer = written.layers[l];
            layers_[p].push_back({rows_of(layer.material, p == 1), layer.thickness_nm,
                                  slots.of_layer[l], slots.of_material[layer.material]});
        }
    }
}

SlopeRun Sheet::run_of(const SlopeSlots& slots, bool with_slopes, bool p) const {
    SlopeRun run;
    run.stride = grid_->stride;
    run.k0 = grid_->k0.data();
    run.is_p = p;
    run.layers = layers_[p ? 1 : 0];
    run.incident_y = incident_y_[p ? 1 : 0].data();
    run.substrate = rows_of(substrate_, p);
    run.substrate_slot = slots.of_material[substrate_];
    run.slots = slots.count;
    run.with_slopes = with_slopes;
    return run;
}

void Sheet::compute(const WrittenOut& written, const SlopeSlots& slots, bool with_slopes,
                    SimdLevel simd) {
    const bool both = angle_deg_ > 0;
    const bool is_chain =
        std::ranges::any_of(written.layers, [](const Layer& layer) { return !layer.coherent; });
    for (std::size_t p = 0; p < 2; ++p) {
        if (!(p ? both && needs.p : needs.s || (!both && needs.p))) continue;
        for (std::size_t l = 0; l < written.layers.size(); ++l) {
            RunLayer& layer = layers_[p][l];
            layer.thickness_nm = written.layers[l].thickness_nm;
            layer.medium.is_real = media_[written.layers[l].material].is_real;
        }
        if (is_chain) {
            compute_chain(written, slots, with_slopes, p == 1, simd);
            continue;
        }
        SlopeRun run = run_of(slots, with_slopes, p == 1);
        run.sequence = written.sequence;
        run.of_amplitudes = needs.amplitudes;
        run.with_transmission = needs.transmission && !(is_lossless && !needs.amplitudes);
        layer_slopes(run, answers_[p], memory_, simd);
    }
}

bool Sheet::has_clear_gaps(const WrittenOut& written) const {
    return std::ranges::all_of(written.layers, [&](const Layer& layer) {
        return layer.coherent || (layer.thickness_nm > 0 && media_[layer.material].is_real);
    });
}

/// Works up from the substrate, adding each coherent block to what lies below it.
void Sheet::compute_chain(const WrittenOut& written, const SlopeSlots& slots, bool with_slopes,
                          bool p, SimdLevel simd) {
    const std::span<const std::uint32_t> sequence = written.sequence;
    SlopeAnswer& all = answers_[p ? 1 : 0];
    std::vector<std::uint32_t> upward;
    bool is_lowest = true;
    std::size_t below = substrate_;
    for (std::size_t end = sequence.size();; is_lowest = false) {
        std::size_t begin = end;
        while (begin > 0 && written.layers[sequence[begin - 1]].coherent) --begin;
        const bool is_top = begin == 0;
        const std::size_t above = is_top ? incident_ : written.layers[sequence[begin - 1]].material;
        const std::size_t which = p ? 1 : 0;
        SlopeRun run = run_of(slots, with_slopes, p);
        run.sequence = sequence.subspan(begin, end - begin);
        if (!is_top) run.incident_y = media_[above].y[which][0].data();
        run.substrate = rows_of(below, p);
        if (!is_lowest) run.substrate_slot = kNoSlot;
        layer_slopes(run, is_lowest ? all : block_[0], memory_, simd);
        if (!is_lowest) {
            upward.assign(run.sequence.rbegin(), run.sequence.rend());
            run.sequence = upward;
            run.incident_y = media_[below].y[which][0].data();
            run.substrate = rows_of(above, p);
            layer_slopes(run, block_[1], memory_, simd);
            add_block(block_[0], block_[1], all);
        }
        if (is_top) return;
        below = above;
        end = begin - 1;
    }
}

/// Turns the result `all` for everything below an incoherent layer into that for block plus below;
/// the block transmits equally in both directions:
///     R1 + T1^2 R/(1 - R1' R),   T1 T/(1 - R1' R)
void Sheet::add_block(const SlopeAnswer& block, const SlopeAnswer& from_below,
                      SlopeAnswer& all) const {
    const std::size_t stride = grid_->stride;
    const std::size_t rows = all.reflected.size() / stride;
    for (std::size_t w = 0; w < stride; ++w) {
        const double R1 = block.R[w], T1 = block.T[w], back = from_below.R[w];
        const double R = all.R[w], T = all.T[w], inverse = 1 / (1 - back * R);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t i = row * stride + w;
            const double dR1 = block.reflected[i], dT1 = block.transmitted[i];
            const double dback = from_below.reflected[i];
            double &dR = all.reflected[i], &dT = all.transmitted[i];
            const double bounce = inverse * inverse * (back * dR + R * dback);
            dT = inverse * (dT1 * T + T1 * dT) + T1 * T * bounce;
            dR = dR1 + inverse * T1 * (2 * dT1 * R + T1 * dR) + T1 * T1 * R * bounce;
        }
        all.R[w] = R1 + T1 * T1 * R * inverse;
        all.T[w] = T1 * T * inverse;
    }
}

}  // namespace irido
