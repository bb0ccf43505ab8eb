#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/coherent/fresnel.hpp"
#include "core/color/baselines/bare_base.hpp"
#include "core/color/baselines/film_approximation.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/engines/engine.hpp"
#include "core/engines/gaussian_observer.hpp"
#include "core/engines/series.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

constexpr std::size_t kGaussianOrders = 3;

/// Indices where closed forms take them.
FilmIndex middle_index(const std::string& method, const Stack& held) {
    const FilmIndex index = film_index(held, kMiddle_nm);
    if (index.film.imag() != 0)
        throw DomainError("method " + method + " must have a film that does not absorb (got k = " +
                          to_text(index.film.imag()) + " at 550 nm)");
    return index;
}

/// A method that is a formula.
class ClosedForm : public ColorAlgorithm {
public:
    ClosedForm(const FilmIndex& index, const Triple& white, ColorMethod::Kind kind)
        : index_(index), white_(white), kind_(kind) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const double thickness_nm = film_of(stack).thickness_nm;
        for (std::size_t a = 0; a < angles_deg.size(); ++a) {
            const double cos_theta = cos_of_incidence(angles_deg[a]);
            const Medium film = medium(index_.film, index_.incident, cos_theta);
            colors[a] = {};
            colors[a].method = kind_;
            colors[a].xyz = film.q2.real() > 0 ? xyz(cos_theta, film, thickness_nm,
                                                     2 * thickness_nm * std::sqrt(film.q2.real()))
                                               : white_;
        }
    }

protected:
    FilmIndex index_;
    Triple white_;

private:
    /// path_nm  optical path difference 2 d n2 cos(theta2)
    virtual Triple xyz(double cos_theta, const Medium& film, double thickness_nm,
                       double path_nm) const = 0;

    ColorMethod::Kind kind_;
};

class Gaussian : public ClosedForm {
public:
    Gaussian(const Sensitivity& sensitivity, const Stack& held, std::size_t orders, Light light)
        : ClosedForm(middle_index("gaussian", held), sensitivity.white(),
                     ColorMethod::Kind::gaussian),
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

class Gltf : public ClosedForm {
public:
    Gltf(const Sensitivity& sensitivity, const Stack& held, const Triple& base_color)
        : ClosedForm(middle_index("gltf", held), sensitivity.white(), ColorMethod::Kind::gltf),
          xyz_from_rgb_(xyz_from_srgb(sensitivity.white())) {
        film_.outside_n = index_.incident;
        film_.film_n = index_.film.real();
        film_.base_f0 = base_color;
    }

private:
    Triple xyz(double cos_theta, const Medium&, double thickness_nm, double) const override {
        EngineFilm film = film_;
        film.cos_theta = cos_theta;
        film.thickness_nm = thickness_nm;
        return product(xyz_from_rgb_, gltf_reflectance(film));
    }

    ColorMatrix xyz_from_rgb_;
    EngineFilm film_;
};

}  // namespace

ColorMatrix xyz_from_srgb(const Triple& white) {
    const RgbSpace& srgb = rgb_space("srgb");
    const ColorMatrix adapted = bradford(srgb.white, white), plain = xyz_from_rgb(srgb);
    ColorMatrix result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) result[i][j] += adapted[i][k] * plain[k][j];
    return result;
}

std::unique_ptr<ColorAlgorithm> gaussian_color(const Sensitivity& sensitivity, const Stack& held,
                                               std::size_t orders, const ColorRequest& request) {
    return std::make_unique<Gaussian>(sensitivity, held, orders, request.light);
}

std::unique_ptr<ColorAlgorithm> gltf_color(const Sensitivity& sensitivity, const Stack& held,
                                           const Triple& base_color, const ColorRequest& request) {
    if (request.light != Light::unpolarized)
        throw DomainError("method gltf must have unpolarized light (got " +
                          std::string(request.light == Light::s ? "s" : "p") + ")");
    for (const double component : base_color) require_in_range("base colour", component, 0, 1);
    return std::make_unique<Gltf>(sensitivity, held, base_color);
}

}  // namespace irido
