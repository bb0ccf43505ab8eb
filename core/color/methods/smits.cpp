#include <cmath>
#include <numbers>

#include "core/coherent/fresnel.hpp"
#include "core/color/color_method.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/integration.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

/// Of the integrals of the two-beam formula, which itself is off by a thousand times as much.
constexpr double kTwoBeamTolerance = 1e-6;

class TwoBeams : public ColorAlgorithm {
public:
    TwoBeams(const ColorTables& tables, Stack held, const ColorRequest& request)
        : sensitivity_(tables.sensitivity()),
          held_(std::move(held)),
          polarizations_(polarizations(request.light)),
          limits_{kTwoBeamTolerance, request.evaluations, request.simd},
          tree_(tables, [this](std::vector<double> wavelength_nm, const IndexFit*) {
              SpectralPoints points{std::move(wavelength_nm), nullptr};
              points.indices = std::make_unique<IndexTable>(held_, points.wavelength_nm);
              return points;
          }) {
        const std::vector<double> ends = smooth_pieces(held_, sensitivity_.support());
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            pieces_.push_back({{ends[i], ends[i + 1]}, 0});
        film_n_ = film_index(held_, ends.front()).film.real();
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const double thickness_nm = film_of(stack).thickness_nm;
        std::vector<SpectralPanel> panels = pieces_;
        for (SpectralPanel& panel : panels)
            panel.half_turn = std::numbers::pi * 2 * thickness_nm * film_n_ *
                              (1 / panel.range.first_nm - 1 / panel.range.last_nm);
        const PanelTree::Start start = tree_.start(panels, kTwoBeamTolerance);
        IntegrationMemory memory;
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const double cos_theta = cos_of_incidence(angles_deg[i]);
            const SampleAt sample = [&](std::span<const SpectralPoints* const> parts,
                                        Samples& samples) {
                double* value = samples.row(0);
                for (const SpectralPoints* part : parts)
                    for (std::size_t w = 0; w < part->wavelength_nm.size(); ++w)
                        *value++ = reflectance(*part->indices, w, cos_theta, thickness_nm);
            };
            ColorIntegral integral;
            integrate_color(sensitivity_, start, 0, sample, limits_, memory, {&integral, 1});
            colors[i] = {};
            colors[i].xyz = integral.xyz;
            colors[i].evaluations = integral.evaluations;
            colors[i].method = "smits";
        }
    }

private:
    double reflectance(const IndexTable& table, std::size_t w, double cos_theta,
                       double thickness_nm) const {
        const auto at = [&](std::size_t material) {
            return medium(table.index(material, w), table.n(held_.incident, w), cos_theta);
        };
        const double n0 = table.n(held_.incident, w);
        const Medium above = medium(n0, n0, cos_theta), film = at(film_of(held_).material),
                     below = at(held_.substrate);
        const Complex turn =
            std::exp(Complex(0, 2 * table.k0()[w] * thickness_nm) * std::sqrt(film.q2));
        double sum = 0;
        for (const Polarization polarization : polarizations_) {
            const Complex r12 = face_amplitude(above, film, polarization);
            const Complex r23 = face_amplitude(film, below, polarization);
            sum += std::norm(r12 + (1.0 - r12 * r12) * r23 * turn);
        }
        return sum / static_cast<double>(polarizations_.size());
    }

    const Sensitivity& sensitivity_;
    Stack held_;
    std::span<const Polarization> polarizations_;
    IntegrationLimits limits_;
    mutable PanelTree tree_;
    std::vector<SpectralPanel> pieces_;
    double film_n_ = 1;
};

std::unique_ptr<ColorAlgorithm> smits_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod&, const ColorRequest& request) {
    return std::make_unique<TwoBeams>(tables, held_stack(stack, tables.sensitivity()), request);
}

}  // namespace

/// Two beams, r = r12 + (1 - r12^2) r23 exp(i Phi), in every other respect exact, and integrated to
/// 1e-6. R may exceed 1. Source: B. E. Smits and G. W. Meyer, Newton's Colors: Simulating
/// Interference Phenomena in Realistic Image Synthesis (1992).
extern constinit const ColorMethodKind color_method_smits = {
    .name = "smits",
    .place = 11,
    .help = "smits: a single round trip",
    .trials = {.counts = kNoNumber, .what = "two beams"},
    .needs_reflected_film = true,
    .prepare = smits_color,
};

}  // namespace irido
