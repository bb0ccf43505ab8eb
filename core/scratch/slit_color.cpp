#include "core/scratch/slit_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/sine_integral.hpp"
#include "core/math/vector_math.hpp"

namespace irido {

namespace {

constexpr double kNmPerUm = 1000;

void add_nodes(const PanelRule& rule, SpectralNodes& nodes) {
    for (std::size_t i = 0; i < rule.wavelength_nm.size(); ++i) {
        nodes.nu_per_um.push_back(kNmPerUm / rule.wavelength_nm[i]);
        for (std::size_t c = 0; c < 3; ++c) nodes.weight[c].push_back(rule.weight[c][i]);
    }
}

double sinc_of(double x, double sine) {
    return std::abs(x) < 1e-4 ? 1 - x * x / 6 : sine / x;
}

}  // namespace

/// The rule of degree 64 on a panel over which a wave turns by 2 x 30 radians is off by
/// J_65(30) = 3e-15.
SpectralNodes spectral_nodes(const Sensitivity& sensitivity, double path_um) {
    constexpr double kLongest_um = 1e4, kHalfTurn = 30;
    constexpr std::size_t kPanelDegree = 64;
    require_in_range("path_um", path_um, 0, kLongest_um);
    const WavelengthRange support = sensitivity.support();
    const double first = 1 / support.last_nm, last = 1 / support.first_nm;
    const int panels = 1 + static_cast<int>(kPi * kNmPerUm * path_um * (last - first) / kHalfTurn);
    SpectralNodes nodes;
    double longest_nm = support.last_nm;
    for (int i = 1; i <= panels; ++i) {
        const double shortest_nm =
            i == panels ? support.first_nm : 1 / (first + (last - first) * i / panels);
        add_nodes(panel_rule(sensitivity, {shortest_nm, longest_nm}, kPanelDegree), nodes);
        longest_nm = shortest_nm;
    }
    return nodes;
}

SpectralNodes one_panel_nodes(const Sensitivity& sensitivity, std::size_t count) {
    require_in_range("nodes", static_cast<double>(count), 5, 129);
    SpectralNodes nodes;
    add_nodes(panel_rule(sensitivity, sensitivity.support(), count - 1), nodes);
    return nodes;
}

SpectralNodes equal_nodes(const Sensitivity& sensitivity, std::size_t count) {
    constexpr double kFirst_nm = 380, kLast_nm = 780;
    require_in_range("wavelengths", static_cast<double>(count), 2, 1e5);
    const WavelengthRange support = sensitivity.support();
    const double first = std::max(kFirst_nm, support.first_nm),
                 last = std::min(kLast_nm, support.last_nm);
    SpectralNodes nodes;
    for (std::size_t i = 0; i < count; ++i) {
        const double wavelength_nm =
            first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1);
        const Triple s = sensitivity.at(wavelength_nm);
        nodes.nu_per_um.push_back(kNmPerUm / wavelength_nm);
        for (std::size_t c = 0; c < 3; ++c) nodes.weight[c].push_back(s[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const double weight : nodes.weight[c]) sum += weight;
        for (double& weight : nodes.weight[c]) weight *= sensitivity.white()[c] / sum;
    }
    return nodes;
}

SlitColors::SlitColors(const Sensitivity& sensitivity, double largest_u_um,
                       double largest_depth_um) {
    require_in_range("u_um", largest_u_um, 0, kLargest_u_um);
    require_in_range("depth_um", largest_depth_um, 0, 1e2);
    nodes_ = spectral_nodes(sensitivity, largest_u_um + 2 * largest_depth_um);
}

SlitColors::SlitColors(SpectralNodes nodes) : nodes_(std::move(nodes)) {}

/// sum over nodes of weight make(u, nu) 4 sin^2(2 pi D nu)
template <class Make>
std::vector<Triple> SlitColors::product(std::span<const double> u_um,
                                        std::span<const double> depth_um, const Make& make) const {
    const std::size_t size = nodes_.size();
    std::vector<double> angle(size), sine(size), cosine(size), of_u(size);
    std::vector<std::vector<double>> groove;
    for (const double depth : depth_um) {
        for (std::size_t i = 0; i < size; ++i) angle[i] = kTwoPi * depth * nodes_.nu_per_um[i];
        sin_cos(angle, sine, cosine, best_simd_level());
        for (double& value : sine) value = 4 * value * value;
        groove.push_back(sine);
    }
    std::vector<Triple> values;
    for (const double u : u_um) {
        for (std::size_t i = 0; i < size; ++i) of_u[i] = make(u, nodes_.nu_per_um[i]);
        std::array<std::vector<double>, 3> weighted = nodes_.weight;
        for (std::vector<double>& weight : weighted)
            for (std::size_t i = 0; i < size; ++i) weight[i] *= of_u[i];
        for (const std::vector<double>& power : groove) {
            Triple sum{};
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < size; ++i) sum[c] += weighted[c][i] * power[i];
            values.push_back(sum);
        }
    }
    return values;
}

std::vector<Triple> SlitColors::power(std::span<const double> u_um,
                                      std::span<const double> depth_um) const {
    return product(u_um, depth_um,
                   [](double u, double nu) { return slit_integral(kTwoPi * u * nu) / kPi; });
}

std::vector<Triple> SlitColors::slope(std::span<const double> u_um,
                                      std::span<const double> depth_um) const {
    return product(u_um, depth_um, [](double u, double nu) {
        const double x = kPi * u * nu, sinc = sinc_of(x, std::sin(x));
        return nu * sinc * sinc;
    });
}

std::vector<ComplexTriple> SlitColors::carried(std::span<const double> u_um,
                                               std::span<const double> depth_um,
                                               const Triple& carrier_um) const {
    const std::size_t size = nodes_.size();
    std::vector<std::array<std::vector<Complex>, 3>> waves;  // of each depth
    for (const double depth : depth_um) {
        std::array<std::vector<Complex>, 3>& wave = waves.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < size; ++i)
                wave[c].push_back(nodes_.weight[c][i] *
                                  std::polar(1.0, 2 * kTwoPi * depth *
                                                      (nodes_.nu_per_um[i] - 1 / carrier_um[c])));
    }
    std::vector<ComplexTriple> values;
    std::vector<double> of_u(size);
    for (const double u : u_um) {
        for (std::size_t i = 0; i < size; ++i)
            of_u[i] = slit_integral(kTwoPi * u * nodes_.nu_per_um[i]) / kPi;
        for (const auto& wave : waves) {
            ComplexTriple sum{};
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < size; ++i) sum[c] += of_u[i] * wave[c][i];
            values.push_back(sum);
        }
    }
    return values;
}

PointColors::PointColors(const Sensitivity& sensitivity) : sensitivity_(sensitivity) {}

const SpectralNodes& PointColors::nodes(double path_um) const {
    constexpr double kFirst_um = 6;
    std::size_t level = 0;
    double reach_um = kFirst_um;
    while (reach_um < path_um && level + 1 < nodes_.size()) reach_um *= 2, ++level;
    require_in_range("path_um", path_um, 0, reach_um);
    return nodes_[level].get(lock_, [&] {
        return std::make_unique<SpectralNodes>(spectral_nodes(sensitivity_, reach_um));
    });
}

Triple PointColors::operator()(const PointLobe& lobe) const {
    // a Gaussian of the wavenumber is as fast as a wave of a path that grows with its steepness
    constexpr double kPathPerBlur = 2;
    const double u = lobe.width_um * lobe.xi2;
    const SpectralNodes& nodes =
        this->nodes(std::abs(u) + std::abs(lobe.path_um) + kPathPerBlur * lobe.blur_um);
    const std::size_t size = nodes.size();
    thread_local std::vector<double> angle, sine, cosine, power;
    for (std::vector<double>* row : {&angle, &sine, &cosine, &power}) row->resize(size);
    for (std::size_t i = 0; i < size; ++i) angle[i] = kPi * u * nodes.nu_per_um[i];
    sin_cos(angle, sine, cosine, best_simd_level());
    for (std::size_t i = 0; i < size; ++i) {
        const double sinc = sinc_of(angle[i], sine[i]);
        power[i] = sinc * nodes.nu_per_um[i];
        angle[i] = kPi * lobe.path_um * nodes.nu_per_um[i];
    }
    sin_cos(angle, sine, cosine, best_simd_level());
    for (std::size_t i = 0; i < size; ++i) {
        const double amplitude = power[i] * sine[i];
        power[i] = amplitude * amplitude;
    }
    if (lobe.blur_um > 0)
        for (std::size_t i = 0; i < size; ++i) {
            const double y = kTwoPi * lobe.blur_um * nodes.nu_per_um[i];
            power[i] *= std::exp(-y * y);
        }
    Triple sum{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < size; ++i) sum[c] += nodes.weight[c][i] * power[i];
        sum[c] *= 8 * lobe.width_um * lobe.width_um;
    }
    return sum;
}

Triple PointColors::by_transform(const PointLobe& lobe) const {
    constexpr double kLongest_nm = 4e5, kAccuracy = 1e-13;
    require_in_range("blur_um", lobe.blur_um, 0, 0);
    if (lobe.xi2 == 0) throw DomainError("xi2 must not be 0");
    const SensitivityTransform& h = transform_.get(lock_, [&] {
        return std::make_unique<SensitivityTransform>(sensitivity_, kLongest_nm, kAccuracy);
    });
    const double u = kNmPerUm * std::abs(lobe.width_um * lobe.xi2), v = kNmPerUm * lobe.path_um;
    const ComplexTriple at_u = h(u), at_v = h(v), sum = h(u + v), difference = h(std::abs(u - v));
    const double scale = 2 / (kPi * kPi * lobe.xi2 * lobe.xi2);
    Triple xyz{};
    for (std::size_t c = 0; c < 3; ++c)
        xyz[c] = scale * (sensitivity_.white()[c] - at_u[c].real() - at_v[c].real() +
                          (sum[c].real() + difference[c].real()) / 2);
    return xyz;
}

}  // namespace irido
