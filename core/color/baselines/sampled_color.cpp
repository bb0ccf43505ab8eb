#include "core/color/baselines/sampled_color.hpp"

#include <algorithm>

#include "core/color/held_stack.hpp"
#include "core/color/quadrature/panel_sums.hpp"
#include "core/math/pool.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

namespace {

class SampledColor : public ColorAlgorithm {
public:
    SampledColor(const Sensitivity& sensitivity, std::shared_ptr<const SampleRule> rule,
                 const Stack& stack, std::string_view method, const ColorRequest& request)
        : rule_(std::move(rule)),
          stride_(whole_vectors(rule_->wavelength_nm.size())),
          table_(held_stack(stack, sensitivity), rule_->wavelength_nm),
          white_(sensitivity.white()),
          method_(method),
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
        result.method = method_;
        return result;
    }

    std::shared_ptr<const SampleRule> rule_;
    std::size_t stride_;        ///< of rows
    std::vector<double> rows_;  ///< weights for X, Y, Z, zero past the points
    IndexTable table_;
    Triple white_, mirror_{};
    std::string_view method_;
    std::vector<Side> sides_;
    Light light_;
    SimdLevel simd_;
    Needs needs_;
    mutable Pool<Scratch> scratch_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> sampled_color(const Sensitivity& sensitivity,
                                              std::shared_ptr<const SampleRule> rule,
                                              const Stack& stack, std::string_view method,
                                              const ColorRequest& request) {
    return std::make_unique<SampledColor>(sensitivity, std::move(rule), stack, method, request);
}

}  // namespace irido
