#include "core/rough/layered/adding.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

using ModeMatrix = Eigen::MatrixXd;

/// Panels of 16 angles per quarter turn, and azimuths per half turn.
struct AddingLevel {
    std::size_t panels, azimuths;
};
constexpr std::array kLevels{AddingLevel{2, 32}, AddingLevel{4, 64}, AddingLevel{8, 128},
                             AddingLevel{12, 256}};

/// Angles asked for that are solved together.
constexpr std::size_t kAnglesTogether = 48;

/// Fraction of the tolerance allotted to the modes left out.
constexpr double kModeShare = 0.05;

/// R is tabulated over theta_d in steps of 1/kStepsPerDegree degrees and interpolated linearly: for
/// the fastest fringes that facets 1 degree apart do not average out, the error is 1e-5.
constexpr double kStepsPerDegree = 100;
constexpr std::size_t kSteps = 9000;

/// Modes of kernels computed together.
constexpr std::size_t kModesTogether = 16;

}  // namespace

/// Angles inside: nodes, then the angles requested.
struct Adding::Grid {
    std::vector<double> theta_deg;
    Eigen::VectorXd weight;   ///< of the nodes
    Eigen::VectorXd coating;  ///< R0 at the nodes
    std::size_t nodes = 0;
};

/// The lobe of a layer between all angles at azimuths over half a turn, R left out.
struct Adding::Lobes {
    std::vector<double> step, lobe;  ///< [i >= j][azimuth]; theta_d in steps of R's table
    std::size_t azimuths = 0;

    /// Times R at one wavelength: columns of azimuths.
    ModeMatrix samples(const AngleSeries& series) const {
        std::vector<double> R(kSteps + 2);
        for (std::size_t k = 0; k <= kSteps; ++k)
            R[k] = series.value(LayerTransport::kR, static_cast<double>(k) / kStepsPerDegree);
        R.back() = R[kSteps];
        const auto row = static_cast<Eigen::Index>(azimuths + 1);
        ModeMatrix values(row, static_cast<Eigen::Index>(lobe.size()) / row);
        double* to = values.data();
        for (std::size_t k = 0; k < lobe.size(); ++k) {
            const auto below = static_cast<std::size_t>(step[k]);
            const double share = step[k] - static_cast<double>(below);
            to[k] = lobe[k] * (R[below] + share * (R[below + 1] - R[below]));
        }
        return values;
    }
};

namespace {

/// Rows that make modes of samples at azimuths over half a turn: (1/2 pi) integral f cos(m phi)
/// dphi over the whole turn.
ModeMatrix mode_rows(std::size_t azimuths, std::size_t first, std::size_t count) {
    const auto last = static_cast<Eigen::Index>(azimuths);
    ModeMatrix rows(static_cast<Eigen::Index>(count), last + 1);
    for (Eigen::Index m = 0; m < rows.rows(); ++m)
        for (Eigen::Index k = 0; k <= last; ++k) {
            const auto turn = (first + static_cast<std::size_t>(m)) * static_cast<std::size_t>(k) %
                              (2 * azimuths);
            rows(m, k) = (k == 0 || k == last ? 0.5 : 1) / static_cast<double>(azimuths) *
                         cos_deg(180 * static_cast<double>(turn) / static_cast<double>(azimuths));
        }
    return rows;
}

}  // namespace

Adding::Adding(const LayeredScattering& scattering, double tolerance, const Execution& execution)
    : scattering_(scattering), tolerance_(tolerance), execution_(execution) {}

std::size_t Adding::first_level() const {
    double alpha = 1;
    for (std::size_t l = 0; l < scattering_.layers(); ++l)
        alpha = std::min(alpha, scattering_.layer(l).alpha());
    return alpha >= 0.08 ? 0 : alpha >= 0.03 ? 1 : 2;
}

Adding::Grid Adding::grid_of(std::size_t level, std::span<const double> extra_deg) const {
    const double top = scattering_.coating().top_deg();
    std::vector<double> ends{0};
    const auto panels = static_cast<double>(kLevels[level].panels);
    for (const auto& [from, to] : {std::pair(0.0, top), std::pair(top, 90.0)}) {
        const double count = std::max(1.0, std::round(panels * (to - from) / 90));
        if (from < to)
            for (double k = 1; k <= count; ++k) ends.push_back(from + (to - from) * k / count);
    }
    Grid grid;
    std::vector<double> weights;
    for_each_node(ends, 0, 90, [&](double theta, double weight) {
        grid.theta_deg.push_back(theta);
        weights.push_back(kPi * kDegree * weight * sin_deg(2 * theta));
    });
    grid.nodes = weights.size();
    grid.weight =
        Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(grid.nodes));
    grid.coating.resize(static_cast<Eigen::Index>(grid.nodes));
    for (std::size_t j = 0; j < grid.nodes; ++j)
        grid.coating[static_cast<Eigen::Index>(j)] =
            scattering_.coating().outward(grid.theta_deg[j]).R;
    grid.theta_deg.insert(grid.theta_deg.end(), extra_deg.begin(), extra_deg.end());
    return grid;
}

Adding::Lobes Adding::lobes_of(const Grid& grid, std::size_t layer, std::size_t azimuths) const {
    Lobes lobes;
    lobes.azimuths = azimuths;
    const std::size_t all = grid.theta_deg.size(), row = azimuths + 1;
    lobes.step.resize(all * (all + 1) / 2 * row);
    lobes.lobe.resize(lobes.step.size());
    std::vector<std::pair<double, double>> halves;  // cos and sin of half the azimuths
    for (std::size_t k = 0; k <= azimuths; ++k) {
        const double half_deg = 90 * static_cast<double>(k) / static_cast<double>(azimuths);
        halves.emplace_back(sin_deg(90 - half_deg), sin_deg(half_deg));
    }
    const double alpha = scattering_.layer(layer).alpha();
    parallel_for(all, execution_.threads, [&](std::size_t i) {
        std::size_t at = i * (i + 1) / 2 * row;
        for (std::size_t j = 0; j <= i; ++j) {
            const MirrorFacets facets(grid.theta_deg[i], grid.theta_deg[j]);
            for (const auto& [near, far] : halves) {
                const MirrorFacet facet = facets(near, far);
                lobes.step[at] = kStepsPerDegree * facet.theta_d_deg;
                lobes.lobe[at++] = lobe(alpha, facet);
            }
        }
    });
    return lobes;
}

/// Calls take(mode, rest) with the light reflected more than once, [angle][angle] without what the
/// coating takes on the way in and out, until take() says that no more is needed.
///   tau  [layer][angle]
template <class Take>
void Adding::solve(const Grid& grid, std::span<const Lobes> lobes, std::span<const double> tau,
                   double wavelength_nm, std::size_t most_modes, const Take& take) const {
    const std::size_t layers = lobes.size(), all = grid.theta_deg.size();
    const auto size = static_cast<Eigen::Index>(all), nodes = static_cast<Eigen::Index>(grid.nodes);
    std::vector<ModeMatrix> samples, kernels(layers);  // of each layer
    for (std::size_t l = 0; l < layers; ++l)
        samples.push_back(lobes[l].samples(*scattering_.layer(l).facets()(wavelength_nm)));
    const bool is_coated = scattering_.coating().is_there();
    for (std::size_t mode = 0; mode <= most_modes; ++mode) {
        if (mode % kModesTogether == 0)
            for (std::size_t l = 0; l < layers; ++l)
                kernels[l] = mode_rows(lobes[l].azimuths, mode,
                                       std::min(kModesTogether, most_modes + 1 - mode)) *
                             samples[l];
        const double base =
            mode == 0 && scattering_.has_base() ? scattering_.base_albedo(wavelength_nm) / kPi : 0;
        ModeMatrix once = ModeMatrix::Constant(size, size, base);  // reflected once
        ModeMatrix more = ModeMatrix::Zero(size, size);            // more than once
        bool is_dark = base == 0;
        for (std::size_t l = layers; l-- > 0;) {
            ModeMatrix K(size, size);
            const auto row = static_cast<Eigen::Index>(mode % kModesTogether);
            for (Eigen::Index i = 0, pair = 0; i < size; ++i)
                for (Eigen::Index j = 0; j <= i; ++j, ++pair)
                    K(i, j) = K(j, i) = kernels[l](row, pair);
            if (!is_dark) {
                const Eigen::Map<const Eigen::VectorXd> through(tau.data() + l * all, size);
                const ModeMatrix B = once + more;
                // X = B + B w K w X
                const ModeMatrix wKw = grid.weight.asDiagonal() * K.topLeftCorner(nodes, nodes) *
                                       grid.weight.asDiagonal();
                const ModeMatrix BwKw = B.leftCols(nodes) * wKw;
                const ModeMatrix X = (ModeMatrix::Identity(nodes, nodes) - BwKw.topRows(nodes))
                                         .partialPivLu()
                                         .solve(B.topRows(nodes));
                more = through.asDiagonal() * (more + BwKw * X) * through.asDiagonal();
                once = through.asDiagonal() * once * through.asDiagonal();
            }
            once += K;
            is_dark = false;
        }
        if (is_coated) {
            const double sign = mode % 2 == 0 ? 1 : -1;
            const Eigen::VectorXd mirror = sign * grid.weight.cwiseProduct(grid.coating);
            const ModeMatrix B = once + more;
            const ModeMatrix BwR = B.leftCols(nodes) * mirror.asDiagonal();
            const ModeMatrix U = (ModeMatrix::Identity(nodes, nodes) - BwR.topRows(nodes))
                                     .partialPivLu()
                                     .solve(B.topRows(nodes));
            more += BwR * U;
        }
        if (!take(mode, more)) return;
    }
}

Adding::Values Adding::brdf_rest(std::span<const ScatterPair> pairs,
                                 const std::vector<double>& wavelength_nm) const {
    const std::size_t W = wavelength_nm.size(), layers = scattering_.layers();
    const Coating& coating = scattering_.coating();
    Values result{std::vector<double>(pairs.size() * W), 0};
    const std::vector<double> once = scattering_.brdf(pairs, wavelength_nm, Paths::single);
    for (std::size_t l = 0; l < layers; ++l)
        scattering_.layer(l).facets().prepare(wavelength_nm, execution_.threads);
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
        std::map<double, std::size_t> places;  // of angles inside
        for (; end < pairs.size() && (places.size() + 2 <= kAnglesTogether || end == begin); ++end)
            for (const double theta : {pairs[end].theta_i_deg, pairs[end].theta_o_deg})
                places.try_emplace(coating.inward(theta).theta_deg, 0);
        std::vector<double> extra;
        for (auto& [theta, place] : places) {
            place = extra.size();
            extra.push_back(theta);
        }
        const std::span<const ScatterPair> some = pairs.subspan(begin, end - begin);
        const auto at_level = [&](std::size_t level) {
            const Grid grid = grid_of(level, extra);
            std::vector<Lobes> lobes;
            for (std::size_t l = 0; l < layers; ++l)
                lobes.push_back(lobes_of(grid, l, kLevels[level].azimuths));
            const std::vector<double> tau = scattering_.straight_of_all(
                grid.theta_deg, wavelength_nm, execution_.threads);  // [wavelength][layer][angle]
            const std::size_t all = grid.theta_deg.size();
            std::vector<double> rest(some.size() * W);
            parallel_for(W, execution_.threads, [&](std::size_t w) {
                std::size_t small = 0;
                solve(grid, lobes, std::span(tau).subspan(w * layers * all, layers * all),
                      wavelength_nm[w], kLevels[level].azimuths - 1,
                      [&](std::size_t mode, const ModeMatrix& more) {
                          bool is_small = true;
                          for (std::size_t p = 0; p < some.size(); ++p) {
                              const Coating::Crossing i = coating.inward(some[p].theta_i_deg);
                              const Coating::Crossing o = coating.inward(some[p].theta_o_deg);
                              const auto a =
                                  static_cast<Eigen::Index>(grid.nodes + places.at(i.theta_deg));
                              const auto b =
                                  static_cast<Eigen::Index>(grid.nodes + places.at(o.theta_deg));
                              const double turn = 180 - some[p].phi_deg;  // exact at 180
                              const double part = (mode == 0 ? 1 : 2) * i.T * o.T *
                                                  coating.dilution() * more(a, b) *
                                                  (mode % 2 == 0 ? 1 : -1) *
                                                  cos_deg(static_cast<double>(mode) * turn);
                              const double largest =
                                  2 * i.T * o.T * coating.dilution() * std::abs(more(a, b));
                              double& sum = rest[p * W + w];
                              sum += part;
                              is_small = is_small &&
                                         largest <= kModeShare * tolerance_ *
                                                        (once[(begin + p) * W + w] + std::abs(sum));
                          }
                          small = is_small ? small + 1 : 0;
                          return small < 3;
                      });
            });
            return rest;
        };
        std::size_t level = first_level();
        std::vector<double> before = at_level(level), now;
        double error = 0;
        while (true) {
            now = at_level(++level);
            error = 0;
            for (std::size_t p = 0; p < some.size(); ++p)
                for (std::size_t w = 0; w < W; ++w) {
                    const double whole = once[(begin + p) * W + w] + std::abs(now[p * W + w]);
                    if (whole > 0)
                        error =
                            std::max(error, std::abs(now[p * W + w] - before[p * W + w]) / whole);
                }
            if (error <= tolerance_ || level + 1 == kLevels.size()) break;
            before = std::move(now);
        }
        result.error = std::max(result.error, error);
        for (std::size_t k = 0; k < now.size(); ++k)
            result.values[begin * W + k] = std::max(-once[begin * W + k], now[k]);
    }
    return result;
}

Adding::Values Adding::albedo_rest(std::span<const double> theta_i_deg,
                                   const std::vector<double>& wavelength_nm) const {
    const std::size_t W = wavelength_nm.size(), layers = scattering_.layers();
    const Coating& coating = scattering_.coating();
    const std::vector<double> once = scattering_.albedo(theta_i_deg, wavelength_nm, Paths::single);
    Values result;
    std::vector<double> extra;
    for (const double theta : theta_i_deg) extra.push_back(coating.inward(theta).theta_deg);
    const auto at_level = [&](std::size_t level) {
        const Grid grid = grid_of(level, extra);
        std::vector<Lobes> lobes;
        for (std::size_t l = 0; l < layers; ++l)
            lobes.push_back(lobes_of(grid, l, kLevels[level].azimuths));
        const std::vector<double> tau =
            scattering_.straight_of_all(grid.theta_deg, wavelength_nm, execution_.threads);
        const std::size_t all = grid.theta_deg.size();
        std::vector<double> rest(extra.size() * W);
        parallel_for(W, execution_.threads, [&](std::size_t w) {
            solve(grid, lobes, std::span(tau).subspan(w * layers * all, layers * all),
                  wavelength_nm[w], 0, [&](std::size_t, const ModeMatrix& more) {
                      for (std::size_t i = 0; i < extra.size(); ++i) {
                          double sum = 0;
                          for (std::size_t j = 0; j < grid.nodes; ++j)
                              sum += more(static_cast<Eigen::Index>(grid.nodes + i),
                                          static_cast<Eigen::Index>(j)) *
                                     grid.weight[static_cast<Eigen::Index>(j)] *
                                     coating.outward(grid.theta_deg[j]).T;
                          rest[i * W + w] = coating.inward(theta_i_deg[i]).T * sum;
                      }
                      return false;
                  });
        });
        return rest;
    };
    std::size_t level = first_level();
    std::vector<double> before = at_level(level), now;
    while (true) {
        now = at_level(++level);
        result.error = 0;
        for (std::size_t k = 0; k < now.size(); ++k)
            if (const double whole = once[k] + now[k]; whole > 0)
                result.error = std::max(result.error, std::abs(now[k] - before[k]) / whole);
        if (result.error <= tolerance_ || level + 1 == kLevels.size()) break;
        before = std::move(now);
    }
    result.values = std::move(now);
    return result;
}

}  // namespace irido
