#include "core/color/baselines/approximation.hpp"

#include <algorithm>

#include "core/color/baselines/bare_base.hpp"
#include "core/color/baselines/film_approximation.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/panel_sums.hpp"
#include "core/color/quadrature/quadrature_color.hpp"
#include "core/error.hpp"
#include "core/math/pool.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

namespace {

/// Weights that take R at kRgb_nm as linear r, g, b.
SampleRule naive_rule(const Triple& white) {
    const ColorMatrix rows = xyz_from_srgb(white);
    SampleRule rule;
    rule.wavelength_nm.assign(kRgb_nm.begin(), kRgb_nm.end());
    for (std::size_t c = 0; c < 3; ++c) rule.weight[c].assign(rows[c].begin(), rows[c].end());
    return rule;
}

/// Weighted sums of the spectra at given wavelengths.
class SampledColor : public ColorAlgorithm {
public:
    SampledColor(const Sensitivity& sensitivity, std::shared_ptr<const SampleRule> rule,
                 const Stack& stack, ColorMethod::Kind kind, const ColorRequest& request)
        : rule_(std::move(rule)),
          stride_(whole_vectors(rule_->wavelength_nm.size())),
          table_(held_stack(stack, sensitivity), rule_->wavelength_nm),
          white_(sensitivity.white()),
          kind_(kind),
          sides_(request.sides),
          light_(request.light),
          simd_(request.simd),
          needs_(needs_of(request)) {
        rows_.resize(3 * stride_);
        for (std::size_t c = 0; c < 3; ++c)
            std::ranges::copy(rule_->weight[c],
                              rows_.begin() + static_cast<std::ptrdiff_t>(c * stride_));
        const std::vector<double> ones(stride_, 1);
        row_sums(rows_.data(), 3, stride_, ones.data(), 0, mirror_.data(), simd_);
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const StackPower power(stack);
        const SpectrumKernel kernel(power, table_.absorbs(), table_.amplifies(), needs_, simd_);
        const Pool<Scratch>::Loan scratch = scratch_.borrow();
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const IncidentAngle at = incident_angle(angles_deg[i]);
            kernel(table_, {&at, 1}, scratch->spectra, scratch->memory);
            for (std::size_t s = 0; s < sides_.size(); ++s)
                colors[i * sides_.size() + s] = color(at.cos == 1, sides_[s], *scratch);
        }
    }

private:
    struct Scratch {
        Spectra spectra;
        SpectrumMemory memory;
        std::vector<double> values;
    };

    /// At normal incidence one polarization stands for both.
    StackColor color(bool normal, Side side, Scratch& scratch) const {
        const auto values = side == Side::reflected ? &Spectrum::R : &Spectrum::T;
        const double* s = (scratch.spectra.s.*values).data();
        const double* p = (scratch.spectra.p.*values).data();
        const std::size_t points = rule_->wavelength_nm.size();
        scratch.values.assign(stride_, 0);
        if (light_ == Light::p) {
            std::copy_n(p, points, scratch.values.begin());
        } else if (light_ == Light::s || normal) {
            std::copy_n(s, points, scratch.values.begin());
        } else {
            for (std::size_t i = 0; i < points; ++i) scratch.values[i] = (s[i] + p[i]) / 2;
        }
        StackColor result;
        row_sums(rows_.data(), 3, stride_, scratch.values.data(), 0, result.xyz.data(), simd_);
        for (std::size_t c = 0; c < 3; ++c)
            result.xyz[c] = white_[c] * (result.xyz[c] / mirror_[c]);
        result.evaluations = points;
        result.method = kind_;
        return result;
    }

    std::shared_ptr<const SampleRule> rule_;
    std::size_t stride_;        ///< of rows
    std::vector<double> rows_;  ///< weights for X, Y, Z, zero past the points
    IndexTable table_;
    Triple white_, mirror_{};
    ColorMethod::Kind kind_;
    std::vector<Side> sides_;
    Light light_;
    SimdLevel simd_;
    Needs needs_;
    mutable Pool<Scratch> scratch_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> approximate_color(const ColorTables& tables, const Stack& stack,
                                                  const ColorMethod& method,
                                                  const ColorRequest& request,
                                                  const std::optional<Triple>& base_color) {
    using enum ColorMethod::Kind;
    const Sensitivity& sensitivity = tables.sensitivity();
    if (base_color && method.kind != gltf) throw DomainError("a base colour requires method gltf");
    switch (method.kind) {
        case equal:
            return std::make_unique<SampledColor>(sensitivity, tables.equal(method.count), stack,
                                                  method.kind, request);
        case naive:
            return std::make_unique<SampledColor>(
                sensitivity, std::make_shared<const SampleRule>(naive_rule(sensitivity.white())),
                stack, method.kind, request);
        case gaussian:
            require_film("gaussian", stack, request);
            return gaussian_color(sensitivity, held_stack(stack, sensitivity), method.count,
                                  request);
        case gltf: {
            require_film("gltf", stack, request);
            const Stack held = held_stack(stack, sensitivity);
            return gltf_color(
                sensitivity, held,
                base_color ? *base_color : bare_base_color(tables, held, Material(), 1), request);
        }
        case smits:
            require_film("smits", stack, request);
            return two_beam_color(tables, held_stack(stack, sensitivity), request);
        case automatic:
        case quadrature:
        case fourier:
        case fourier_constant:
        case bloch:
        case landmarks:
            break;
    }
    throw DomainError("method must be one of equal, naive, gaussian, gltf, smits");
}

}  // namespace irido
