#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/math/lazy.hpp"

namespace irido {

/// Wavenumbers and weights of X, Y, Z for integrands that are smooth but for waves: the product
/// rules of panel_rule(), side by side.
struct SpectralNodes {
    std::vector<double> nu_per_um;
    std::array<std::vector<double>, 3> weight;

    std::size_t size() const { return nu_per_um.size(); }
};

/// As many as waves of paths up to `path_um`, [0, 1e4], need for 1e-13 of the white.
SpectralNodes spectral_nodes(const Sensitivity& sensitivity, double path_um);

/// One panel of `count` nodes, [5, 129]; equally spaced wavelengths from 380 to 780 nm for
/// comparisons.
SpectralNodes one_panel_nodes(const Sensitivity& sensitivity, std::size_t count);
SpectralNodes equal_nodes(const Sensitivity& sensitivity, std::size_t count);

/// Three wavelengths, 650, 510 and 475 nm, as linear sRGB: for comparisons.
SpectralNodes three_wavelengths();

/// F(x) with the sine integral's fit of VWH18 eq. 29: off by up to 0.05, its tail a third too low,
/// and not monotonic, so that it takes light away between many pairs of directions.
double published_slit_integral(double x);

/// Colours that a scratch of depth D diffracts up to u = W q, all widths and directions in one
/// table; v = 2 D, nu = 1/lambda, F of slit_integral():
///     T_j(u, D)  = int s_j 4 sin^2(2 pi D nu) F(2 pi u nu)/pi dlambda,   odd in u
///     T_j'(u, D) = int s_j 4 sin^2(2 pi D nu) nu sinc^2(pi u nu) dlambda, per um
///     Q_j(u, D)  = exp(-4 pi i D/lambda_j) int s_j exp(4 pi i D nu) F(2 pi u nu)/pi dlambda,
///     T_j = 2 Q_j(u, 0) - 2 Re[exp(4 pi i D/lambda_j) Q_j(u, D)],
/// Q being smooth in D. An area light's colour is rho [T(W q1, D) - T(W q0, D)], many scratches'
/// far field rho p(a) W T'(W |xi|, D)/|xi|. u in [-1e3, 1e3] um, D in [0, 1e2] um, else
/// DomainError; errors below 1e-12. Safe from many threads.
class SlitColors {
public:
    SlitColors(const Sensitivity& sensitivity, double largest_u_um, double largest_depth_um);
    /// The same by other nodes.
    explicit SlitColors(SpectralNodes nodes);

    /// At all combinations, [u][depth]: T, T', Q and dQ/du.
    std::vector<Triple> power(std::span<const double> u_um, std::span<const double> depth_um) const;
    std::vector<Triple> slope(std::span<const double> u_um, std::span<const double> depth_um) const;
    std::vector<ComplexTriple> carried(std::span<const double> u_um,
                                       std::span<const double> depth_um,
                                       const Triple& carrier_um) const;
    std::vector<ComplexTriple> carried_slope(std::span<const double> u_um,
                                             std::span<const double> depth_um,
                                             const Triple& carrier_um) const;

    static constexpr double kLargest_u_um = 1e3;

private:
    /// Nodes for u up to a largest one.
    struct Level {
        double largest_u_um;
        SpectralNodes nodes;
    };
    /// What varies with u, F/pi or its derivative, at a node.
    using OfSlit = double (*)(double u_um, double nu_per_um);
    /// What varies with the depth, times the weights: [node][depth][X, Y, Z], or with a carrier
    /// [node][depth][real X, Y, Z, imaginary X, Y, Z].
    struct Waves {
        const Level* level;
        std::vector<double> depth_um;
        Triple carrier_um;  ///< 0 without one
        std::vector<double> values;
    };
    const Level& level_of(double u_um) const;
    std::shared_ptr<const Waves> waves_of(const Level& level, std::span<const double> depth_um,
                                          const Triple* carrier_um) const;
    std::vector<double> products(std::span<const double> u_um, std::span<const double> depth_um,
                                 const Triple* carrier_um, OfSlit of_slit) const;
    std::vector<Triple> grooves(std::span<const double> u_um, std::span<const double> depth_um,
                                OfSlit of_slit) const;
    std::vector<ComplexTriple> carriers(std::span<const double> u_um,
                                        std::span<const double> depth_um, const Triple& carrier_um,
                                        OfSlit of_slit) const;

    std::vector<Level> levels_;  ///< ascending
    /// The last ones asked for: tables come in parts that share their depths.
    static constexpr std::size_t kMostKept = 5, kMostKeptValues = 1U << 22;
    mutable std::vector<std::shared_ptr<const Waves>> kept_;
    mutable std::mutex lock_;
};

/// lambda_j of the carriers of Q, um: near the centroids of the largest lobes of X, Y, Z in
/// daylight. The identity above holds for any.
inline constexpr Triple kSlitCarriers_um{0.575, 0.557, 0.452};

/// Colour of one infinite scratch under a point light in a perfect mirror, without exp(-s_b^2 /
/// sigma^2): X, Y, Z per sr of int s_j 2 W^2 nu^2 sinc^2 |d|^2 exp(-(2 pi sigma xi_1 nu)^2)
/// dlambda.
struct PointLobe {
    double width_um, xi2, path_um;
    double blur_um = 0;  ///< sigma |xi_1|
};
class PointColors {
public:
    explicit PointColors(const Sensitivity& sensitivity);

    /// Summed over the spectrum, error below 1e-12 of the value but for rounding of 1e-13 of
    /// W^2 nu^2; some microseconds for paths below 24 um.
    Triple operator()(const PointLobe& lobe) const;

    /// For blur 0, from the table of the transform H_j:
    ///     2/(pi xi_2)^2 [H(0) - H(u) - H(v) + (H(u + v) + H(u - v))/2],   u = W xi_2,
    /// within 1e-12/(pi xi_2)^2. |xi_2| > 0 and paths up to 0.4 mm, else DomainError.
    Triple by_transform(const PointLobe& lobe) const;

private:
    const SpectralNodes& nodes(double path_um) const;

    const Sensitivity& sensitivity_;
    mutable std::array<Lazy<SpectralNodes>, 12> nodes_;
    mutable Lazy<SensitivityTransform> transform_;
    mutable std::mutex lock_;
};

}  // namespace irido
