#include <array>
#include <cmath>
#include <numbers>

#include "core/color/baselines/closed_form.hpp"
#include "core/color/held_stack.hpp"
#include "core/engines/gaussian_observer.hpp"

namespace irido {

namespace {

constexpr std::size_t kGaussianOrders = 3;

class Gaussian : public ClosedForm {
public:
    Gaussian(const Sensitivity& sensitivity, const Stack& held, std::size_t orders, Light light)
        : ClosedForm(middle_index("gaussian", held), sensitivity.white(), "gaussian"),
          orders_(orders == 0 ? kGaussianOrders : orders),
          polarizations_(polarizations(light)),
          mirror_(GaussianObserver(0)({})) {}

private:
    /// R_j = C_0 + 2 sum_m C_m Re(exp(i m phi) H_j(m D)), with the names of BB17's appendix.
    Triple xyz(double cos_theta, const Medium& film, double, double path_nm) const override {
        const Medium above = medium(index_.incident, index_.incident, cos_theta);
        const Medium below = medium(index_.substrate, index_.incident, cos_theta);
        std::array<double, 2> step{}, amplitude{}, phi{};
        double constant = 0;
        for (std::size_t i = 0; i < polarizations_.size(); ++i) {
            const double r12 = face_amplitude(above, film, polarizations_[i]).real();
            const Complex r23 = face_amplitude(film, below, polarizations_[i]);
            const double R12 = r12 * r12, R23 = std::norm(r23), T121 = 1 - R12;
            const double R_star = T121 == 0 ? 0 : T121 * T121 * R23 / (1 - R12 * R23);
            constant += R12 + R_star;
            step[i] = std::abs(r12) * std::abs(r23);
            amplitude[i] = 2 * (R_star - T121);
            phi[i] = std::arg(r23) + (r12 > 0 ? std::numbers::pi : 0);
        }
        Triple sum{constant, constant, constant};
        for (std::size_t m = 1; m <= orders_; ++m) {
            const auto order = static_cast<double>(m);
            const GaussianObserver observer(order * path_nm);
            for (std::size_t i = 0; i < polarizations_.size(); ++i) {
                amplitude[i] *= step[i];
                const double shift = order * phi[i];
                const Triple turned = observer({shift, shift, shift});
                for (std::size_t c = 0; c < 3; ++c) sum[c] += amplitude[i] * turned[c] / mirror_[c];
            }
        }
        Triple result{};
        for (std::size_t c = 0; c < 3; ++c)
            result[c] = white_[c] * sum[c] / static_cast<double>(polarizations_.size());
        return result;
    }

    std::size_t orders_;
    std::span<const Polarization> polarizations_;
    Triple mirror_;
};

std::unique_ptr<ColorAlgorithm> gaussian_color(const ColorTables& tables, const Stack& stack,
                                               const ColorMethod& method,
                                               const ColorRequest& request) {
    const Sensitivity& sensitivity = tables.sensitivity();
    return std::make_unique<Gaussian>(sensitivity, held_stack(stack, sensitivity), method.count,
                                      request.light);
}

}  // namespace

/// BB17's series with four Gaussians for the observer; exact Fresnel terms of s and p, the phase of
/// conductors. Indices at 550 nm stand for all wavelengths, at which the film must not absorb.
///
/// The Gaussians stand for the observer under E, with X = Y = Z = 1 for a mirror to 1e-3. Each
/// channel is divided by its value for a mirror and multiplied by the illuminant's white, which
/// takes the spectral shape of the light to be the same within each channel. BB17's shader lets the
/// film vanish below 15 nm of optical thickness and clips colours; this does neither.
/// Source: BB17 (ACM TOG 36(4), 2017), eqs. 3 to 10, constants of its supplemental code.
extern constinit const ColorMethodKind color_method_gaussian = {
    .name = "gaussian",
    .place = 9,
    .help = "gaussian: the observer as Gaussians",
    .trials = {.counts = kNoNumber, .what = "Belcour and Barla's Gaussians"},
    .needs_reflected_film = true,
    .prepare = gaussian_color,
};

}  // namespace irido
