#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/coherent/fresnel.hpp"
#include "core/color/baselines/film_approximation.hpp"
#include "core/color/fourier/one_film.hpp"
#include "core/error.hpp"

namespace irido {

namespace {

/// Where closed forms take the indices of all wavelengths, nm.
constexpr double kMiddle_nm = 550;

constexpr std::size_t kGaussianOrders = 3, kGltfOrders = 2;

/// A Gaussian in the wavenumber 1/lambda (1/m) as part of the observer under E. Source: BB17,
/// supplemental code.
struct Fit {
    std::size_t channel;
    double height, center, variance;
};
constexpr std::array kFits{
    Fit{0, 5.4856e-13, 1.6810e6, 4.3278e9}, Fit{0, 9.7470e-14, 2.2399e6, 4.5282e9},
    Fit{1, 4.4201e-13, 1.7953e6, 9.3046e9}, Fit{2, 5.2481e-13, 2.2084e6, 6.6121e9}};
constexpr double kFitScale = 1.0685e-7;

/// Fourier transform of the fitted observer at one optical path.
class FittedObserver {
public:
    explicit FittedObserver(double path_nm) : phase_(2 * std::numbers::pi * 1e-9 * path_nm) {
        for (std::size_t i = 0; i < kFits.size(); ++i)
            heights_[i] = kFits[i].height * std::sqrt(2 * std::numbers::pi * kFits[i].variance) *
                          std::exp(-kFits[i].variance * phase_ * phase_) / kFitScale;
    }

    /// Its real part, turned by `shift` radians, for each channel.
    Triple operator()(const Triple& shift) const {
        Triple xyz{};
        for (std::size_t i = 0; i < kFits.size(); ++i)
            xyz[kFits[i].channel] +=
                heights_[i] * std::cos(kFits[i].center * phase_ + shift[kFits[i].channel]);
        return xyz;
    }

private:
    double phase_;
    std::array<double, kFits.size()> heights_{};
};

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
            colors[a].xyz = film.q2.real() > 0
                                ? xyz(cos_theta, film, 2 * thickness_nm * std::sqrt(film.q2.real()))
                                : white_;
        }
    }

protected:
    FilmIndex index_;
    Triple white_;

private:
    /// path_nm  optical path difference 2 d n2 cos(theta2)
    virtual Triple xyz(double cos_theta, const Medium& film, double path_nm) const = 0;

    ColorMethod::Kind kind_;
};

class Gaussian : public ClosedForm {
public:
    Gaussian(const Sensitivity& sensitivity, const Stack& held, std::size_t orders, Light light)
        : ClosedForm(middle_index("gaussian", held), sensitivity.white(),
                     ColorMethod::Kind::gaussian),
          orders_(orders == 0 ? kGaussianOrders : orders),
          polarizations_(polarizations(light)),
          mirror_(FittedObserver(0)({})) {}

private:
    /// R_j = C_0 + 2 sum_m C_m Re(exp(i m phi) H_j(m D)), with the names of BB17's appendix.
    Triple xyz(double cos_theta, const Medium& film, double path_nm) const override {
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
            const FittedObserver observer(order * path_nm);
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

/// Keeps the base's index finite: added to its F0, and the most that F0 may be then.
constexpr double kF0Guard = 1e-4, kLargestF0 = 0.9999;

class Gltf : public ClosedForm {
public:
    Gltf(const Sensitivity& sensitivity, const Stack& held, const Triple& base_color)
        : ClosedForm(middle_index("gltf", held), sensitivity.white(), ColorMethod::Kind::gltf),
          xyz_from_rgb_(xyz_from_srgb(sensitivity.white())),
          rgb_from_xyz_(rgb_from_xyz(rgb_space("srgb"))) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double root = std::sqrt(std::min(base_color[c] + kF0Guard, kLargestF0));
            base_[c] = (1 + root) / (1 - root);
        }
    }

private:
    Triple xyz(double cos_theta, const Medium&, double path_nm) const override {
        const double film = index_.film.real(), outside = index_.incident;
        const double sine = outside / film * std::sqrt((1 - cos_theta) * (1 + cos_theta));
        const double cos_film = std::sqrt(std::max(0.0, 1 - sine * sine));
        const double R12 = schlick(normal_reflectance(film, outside), cos_theta);
        const double T121 = 1 - R12, phi21 = film < outside ? 0 : std::numbers::pi;
        Triple rgb{}, step{}, amplitude{}, phi{};
        for (std::size_t c = 0; c < 3; ++c) {
            const double R23 = schlick(normal_reflectance(base_[c], film), cos_film);
            const double R123 = std::clamp(R12 * R23, 1e-5, 0.9999);
            const double Rs = T121 * T121 * R23 / (1 - R123);
            rgb[c] = R12 + Rs;
            step[c] = std::sqrt(R123);
            amplitude[c] = 2 * (Rs - T121);
            phi[c] = phi21 + (base_[c] < film ? std::numbers::pi : 0);
        }
        for (std::size_t m = 1; m <= kGltfOrders; ++m) {
            const auto order = static_cast<double>(m);
            // the phases of r, g, b serve X, Y, Z
            const Triple turned =
                FittedObserver(order * path_nm)({order * phi[0], order * phi[1], order * phi[2]});
            for (std::size_t c = 0; c < 3; ++c) {
                amplitude[c] *= step[c];
                rgb[c] += amplitude[c] * product(rgb_from_xyz_[c], turned);
            }
        }
        for (double& component : rgb) component = std::max(component, 0.0);
        return {product(xyz_from_rgb_[0], rgb), product(xyz_from_rgb_[1], rgb),
                product(xyz_from_rgb_[2], rgb)};
    }

    static double product(const Triple& row, const Triple& column) {
        return row[0] * column[0] + row[1] * column[1] + row[2] * column[2];
    }

    ColorMatrix xyz_from_rgb_, rgb_from_xyz_;
    Triple base_{};  ///< real indices
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
