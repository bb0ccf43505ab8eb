#include "core/scratch/slit_color.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/math/sine_integral.hpp"
#include "core/math/vector_math.hpp"
#include "core/scratch/diffraction.hpp"

namespace irido {

namespace {

constexpr double kNmPerUm = 1000;

void add_nodes(const PanelRule& rule, SpectralNodes& nodes) {
    for (std::size_t i = 0; i < rule.wavelength_nm.size(); ++i) {
        nodes.nu_per_um.push_back(kNmPerUm / rule.wavelength_nm[i]);
        for (std::size_t c = 0; c < 3; ++c) nodes.weight[c].push_back(rule.weight[c][i]);
    }
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

SpectralNodes three_wavelengths() {
    SpectralNodes nodes;
    for (const double wavelength_nm : {650.0, 510.0, 475.0})
        nodes.nu_per_um.push_back(kNmPerUm / wavelength_nm);
    const ColorMatrix matrix = xyz_from_rgb(rgb_space("srgb"));
    for (std::size_t c = 0; c < 3; ++c) nodes.weight[c].assign(matrix[c].begin(), matrix[c].end());
    return nodes;
}

double published_slit_integral(double x) {
    constexpr double a0 = 0.66142739, b0 = 0.38272292;
    const double sign = x < 0 ? -1 : 1, off = x - sign * b0;
    const double si = kPi / 2 * std::tanh(x) - a0 * x / (1 + off * off) +
                      sign * (1 - std::cos(x)) / (1 + std::abs(x));
    return x == 0 ? 0 : si - (1 - std::cos(x)) / x;
}

SlitColors::SlitColors(const Sensitivity& sensitivity, double largest_u_um,
                       double largest_depth_um) {
    constexpr double kFirst_um = 8, kGrowth = 4;
    require_in_range("u_um", largest_u_um, 0, kLargest_u_um);
    require_in_range("depth_um", largest_depth_um, 0, kDeepest_um);
    double reach_um = 0;
    while (reach_um < largest_u_um || levels_.empty()) {
        reach_um = std::min(levels_.empty() ? kFirst_um : kGrowth * reach_um, kLargest_u_um);
        levels_.push_back({reach_um, spectral_nodes(sensitivity, std::min(reach_um, largest_u_um) +
                                                                     2 * largest_depth_um)});
    }
}

SlitColors::SlitColors(SpectralNodes nodes) {
    levels_.push_back({kLargest_u_um, std::move(nodes)});
}

const SlitColors::Level& SlitColors::level_of(double u_um) const {
    require_in_range("u_um", u_um, -kLargest_u_um, kLargest_u_um);
    for (const Level& level : levels_)
        if (std::abs(u_um) <= level.largest_u_um) return level;
    throw DomainError("u_um must be within the range prepared for (got " + to_text(u_um) + ")");
}

std::shared_ptr<const SlitColors::Waves> SlitColors::waves_of(const Level& level,
                                                              std::span<const double> depth_um,
                                                              const Triple* carrier_um) const {
    std::unique_lock guard(lock_);
    Waves wanted{&level, {depth_um.begin(), depth_um.end()}, {}, {}};
    if (carrier_um) wanted.carrier_um = *carrier_um;
    for (const auto& kept : kept_)
        if (kept->level == wanted.level && kept->depth_um == wanted.depth_um &&
            kept->carrier_um == wanted.carrier_um)
            return kept;
    const SpectralNodes& nodes = level.nodes;
    const std::size_t size = nodes.size(), width = carrier_um ? 6 : 3,
                      columns = width * depth_um.size();
    const bool is_kept = size * columns <= kMostKeptValues;
    if (!is_kept) guard.unlock();
    wanted.values.resize(size * columns);
    std::vector<double> angle(size), sine(size), cosine(size);
    for (std::size_t d = 0; d < depth_um.size(); ++d) {
        const double turn = (carrier_um ? 2 : 1) * kTwoPi * depth_um[d];
        for (std::size_t i = 0; i < size; ++i) angle[i] = turn * nodes.nu_per_um[i];
        sin_cos(angle, sine, cosine, best_simd_level());
        std::array<Complex, 3> shift{};
        for (std::size_t c = 0; c < 3 && carrier_um; ++c)
            shift[c] = std::polar(1.0, -turn / (*carrier_um)[c]);
        for (std::size_t i = 0; i < size; ++i) {
            double* const row = wanted.values.data() + i * columns + d * width;
            for (std::size_t c = 0; c < 3; ++c) {
                const double weight = nodes.weight[c][i];
                if (!carrier_um) {
                    row[c] = weight * 4 * sine[i] * sine[i];
                    continue;
                }
                row[c] = weight * (cosine[i] * shift[c].real() - sine[i] * shift[c].imag());
                row[c + 3] = weight * (cosine[i] * shift[c].imag() + sine[i] * shift[c].real());
            }
        }
    }
    if (!is_kept) return std::make_shared<const Waves>(std::move(wanted));
    if (kept_.size() >= kMostKept) kept_.erase(kept_.begin());
    return kept_.emplace_back(std::make_shared<const Waves>(std::move(wanted)));
}

/// sum over nodes of of_slit(u, nu) times the waves of each depth.
std::vector<double> SlitColors::products(std::span<const double> u_um,
                                         std::span<const double> depth_um, const Triple* carrier_um,
                                         OfSlit of_slit) const {
    const std::size_t columns = (carrier_um ? 6 : 3) * depth_um.size();
    std::vector<double> values(u_um.size() * columns, 0.0);
    std::shared_ptr<const Waves> waves;
    for (std::size_t row = 0; row < u_um.size(); ++row) {
        const Level& level = level_of(u_um[row]);
        if (!waves || waves->level != &level) waves = waves_of(level, depth_um, carrier_um);
        double* const sums = values.data() + row * columns;
        for (std::size_t i = 0; i < level.nodes.size(); ++i) {
            const double slit = of_slit(u_um[row], level.nodes.nu_per_um[i]);
            const double* const wave = waves->values.data() + i * columns;
            for (std::size_t k = 0; k < columns; ++k) sums[k] += slit * wave[k];
        }
    }
    return values;
}

std::vector<Triple> SlitColors::grooves(std::span<const double> u_um,
                                        std::span<const double> depth_um, OfSlit of_slit) const {
    const std::vector<double> values = products(u_um, depth_um, nullptr, of_slit);
    std::vector<Triple> triples(values.size() / 3);
    for (std::size_t i = 0; i < values.size(); ++i) triples[i / 3][i % 3] = values[i];
    return triples;
}

std::vector<ComplexTriple> SlitColors::carriers(std::span<const double> u_um,
                                                std::span<const double> depth_um,
                                                const Triple& carrier_um, OfSlit of_slit) const {
    const std::vector<double> values = products(u_um, depth_um, &carrier_um, of_slit);
    std::vector<ComplexTriple> triples(values.size() / 6);
    for (std::size_t i = 0; i < triples.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            triples[i][c] = {values[6 * i + c], values[6 * i + 3 + c]};
    return triples;
}

namespace {

double lobe_up_to(double u_um, double nu_per_um) {
    return slit_integral(kTwoPi * u_um * nu_per_um) / kPi;
}
double lobe_at(double u_um, double nu_per_um) {
    const double x = kPi * u_um * nu_per_um, sinc = sinc_of(x, std::sin(x));
    return nu_per_um * sinc * sinc;
}

}  // namespace

std::vector<Triple> SlitColors::power(std::span<const double> u_um,
                                      std::span<const double> depth_um) const {
    return grooves(u_um, depth_um, lobe_up_to);
}

std::vector<Triple> SlitColors::slope(std::span<const double> u_um,
                                      std::span<const double> depth_um) const {
    return grooves(u_um, depth_um, lobe_at);
}

std::vector<ComplexTriple> SlitColors::carried(std::span<const double> u_um,
                                               std::span<const double> depth_um,
                                               const Triple& carrier_um) const {
    return carriers(u_um, depth_um, carrier_um, lobe_up_to);
}

std::vector<ComplexTriple> SlitColors::carried_slope(std::span<const double> u_um,
                                                     std::span<const double> depth_um,
                                                     const Triple& carrier_um) const {
    return carriers(u_um, depth_um, carrier_um, lobe_at);
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
    constexpr double kLongestPath_nm = 4e5, kAccuracy = 1e-13;
    require_in_range("blur_um", lobe.blur_um, 0, 0);
    if (lobe.xi2 == 0) throw DomainError("xi2 must not be 0");
    const SensitivityTransform& h = transform_.get(lock_, [&] {
        return std::make_unique<SensitivityTransform>(sensitivity_, kLongestPath_nm, kAccuracy);
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
