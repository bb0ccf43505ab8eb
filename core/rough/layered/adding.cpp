#include "core/rough/layered/adding.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/gauss.hpp"
#include "core/math/parallel.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

using ModeMatrix = Eigen::MatrixXd;

/// Panels of 16 angles over a quarter turn, and azimuths over half a turn.
struct AddingLevel {
    std::size_t panels, azimuths;
};
constexpr std::array kLevels{AddingLevel{2, 24}, AddingLevel{4, 40},  AddingLevel{6, 48},
                             AddingLevel{8, 64}, AddingLevel{10, 96}, AddingLevel{12, 192}};

/// Wavelengths at which a level is judged.
constexpr std::size_t kJudged = 8;

/// Angles asked for that are solved together.
constexpr std::size_t kAnglesTogether = 48;

/// Part of the tolerance that modes which are left out may have.
constexpr double kModeShare = 0.05;

/// R over theta_d in steps of 1/kStepsPerDegree degrees, linear in between: the fastest fringes
/// that facets within 1 degree of each other do not wash out differ from that by 1e-5.
constexpr double kStepsPerDegree = 100;
constexpr std::size_t kSteps = 9000;

/// Modes of kernels computed together.
constexpr std::size_t kModesTogether = 16;

}  // namespace

/// Angles inside: nodes, then those asked for.
struct Adding::Grid {
    std::vector<double> theta_deg;
    Eigen::VectorXd weight;   ///< of the nodes
    Eigen::VectorXd coating;  ///< R0 at the nodes
    std::size_t nodes = 0;
};

/// The lobe of a layer between all angles at azimuths over half a turn, R left out. At grazing
/// angles its peak at 180 degrees is narrower than any azimuths: what R has there is split off, and
/// the modes of D alone are known. With |i + o|^2 = u + s + b (1 + cos phi)/2, q = (1 - alpha^2) u,
/// A = alpha^2 u + s + b/2 and B = b/2,
///     D = alpha^2/pi (1 + q/(A + B cos phi))^2,
/// whose mode m is, with S^2 = A^2 - B^2 and rho = B/(A + S),
///     alpha^2/pi ([m = 0] + (-rho)^m (2q/S + q^2 A/S^3 + m q^2/S^2)).
struct Adding::Lobes {
    std::vector<double> step, lobe;  ///< [i >= j][azimuth]; theta_d in steps of the table of R
    std::size_t azimuths = 0;
    struct Peak {
        double scale, ratio, constant, slope;  ///< -rho, and what stands with it and with m
    };
    std::vector<Peak> peaks;  ///< [i >= j]

    /// R at a place in steps.
    static double between(const std::vector<double>& R, double at) {
        const auto below = static_cast<std::size_t>(at);
        return R[below] + (at - static_cast<double>(below)) * (R[below + 1] - R[below]);
    }

    /// R at the peaks of one wavelength.
    ///   R  at the steps and one more
    std::vector<double> at_peaks(const std::vector<double>& R) const {
        std::vector<double> values;
        values.reserve(peaks.size());
        for (std::size_t pair = 0; pair < peaks.size(); ++pair)
            values.push_back(between(R, step[pair * (azimuths + 1) + azimuths]));
        return values;
    }

    /// The lobe times what R has more than at the peak, [azimuth][pair].
    ModeMatrix samples(const std::vector<double>& R, const std::vector<double>& at_peak) const {
        const std::size_t row = azimuths + 1;
        ModeMatrix values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(peaks.size()));
        double* to = values.data();
        for (std::size_t pair = 0; pair < peaks.size(); ++pair)
            for (std::size_t k = pair * row; k < (pair + 1) * row; ++k)
                *to++ = lobe[k] * (between(R, step[k]) - at_peak[pair]);
        return values;
    }
};

namespace {

/// Columns that make modes of samples at azimuths over half a turn: (1/2 pi) integral f cos(m phi)
/// dphi over the whole turn.
ModeMatrix mode_columns(std::size_t azimuths, std::size_t first, std::size_t count) {
    const auto last = static_cast<Eigen::Index>(azimuths);
    ModeMatrix columns(last + 1, static_cast<Eigen::Index>(count));
    for (Eigen::Index m = 0; m < columns.cols(); ++m)
        for (Eigen::Index k = 0; k <= last; ++k) {
            const auto turn = (first + static_cast<std::size_t>(m)) * static_cast<std::size_t>(k) %
                              (2 * azimuths);
            columns(k, m) =
                (k == 0 || k == last ? 0.5 : 1) / static_cast<double>(azimuths) *
                cos_deg(180 * static_cast<double>(turn) / static_cast<double>(azimuths));
        }
    return columns;
}

/// (1 - G)^-1 F, G a square matrix by what it does to a block of columns: G^n F summed up where few
/// columns are asked for and few n are needed, else by elimination.
template <class Apply, class Matrix>
void solve_series(const Apply& apply, const Matrix& matrix, const ModeMatrix& F, ModeMatrix& X) {
    constexpr int kMostTerms = 12;
    constexpr double kSmallTerm = 1e-7;
    constexpr Eigen::Index kFewColumns = 8;
    const double all = F.cwiseAbs().maxCoeff();
    X = F;
    if (!(all > 0)) return;
    if (F.cols() <= kFewColumns) {
        ModeMatrix term = F;
        for (int n = 0; n < kMostTerms; ++n) {
            term = apply(term);
            X += term;
            if (term.cwiseAbs().maxCoeff() <= kSmallTerm * all) return;
        }
    }
    const Eigen::Index size = F.rows();
    X = (ModeMatrix::Identity(size, size) - matrix()).partialPivLu().solve(F);
}

}  // namespace

Adding::Adding(const LayeredScattering& scattering, double tolerance, const Execution& execution)
    : scattering_(scattering), tolerance_(tolerance), execution_(execution) {}

std::size_t Adding::first_level() const {
    double alpha = 1;
    for (std::size_t l = 0; l < scattering_.layers(); ++l)
        alpha = std::min(alpha, scattering_.layer(l).alpha());
    return alpha >= 0.08 ? 0 : alpha >= 0.03 ? 1 : 3;
}

Adding::Grid Adding::grid_of(std::size_t level, std::span<const double> extra_deg) const {
    const double top = scattering_.coating().top_deg();
    const auto panels = static_cast<double>(kLevels[level].panels);
    Grid grid;
    std::vector<double> weights;
    const auto add = [&](double theta, double weight) {
        grid.theta_deg.push_back(theta);
        weights.push_back(kPi * kDegree * weight * sin_deg(2 * theta));
    };
    for (const auto& [from, to] : {std::pair(0.0, top), std::pair(top, 90.0)}) {
        if (!(from < to)) continue;
        const double count = std::max(1.0, std::round(panels * (to - from) / 90));
        const double width = (to - from) / count;
        std::vector<double> ends{from};
        while (static_cast<double>(ends.size()) < count) ends.push_back(ends.back() + width);
        for_each_node(ends, from, to, add);
        // the coating's reflectance ends as a square root, masking within alpha of grazing
        const std::vector<double> last{0, 1};
        for_each_node(last, 0, 1, [&, end = to](double u, double weight) {
            add(end - width * u * u, 2 * width * u * weight);
        });
    }
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
    lobes.peaks.resize(all * (all + 1) / 2);
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
            const MirrorFacet peak = facets(0, 1);
            const double alpha2 = alpha * alpha, q = (1 - alpha2) * facets.up2();
            const double B = 0.5 * facets.both(), p = alpha2 * facets.up2() + facets.across2();
            const double A = p + B, S = std::sqrt(p * (p + 2 * B));
            lobes.peaks[i * (i + 1) / 2 + j] = {
                0.25 * alpha2 / kPi * visibility(alpha, peak.cos_i, peak.sin_i) *
                    visibility(alpha, peak.cos_o, peak.sin_o),
                -B / (A + S), 2 * q / S + q * q * A / (S * S * S), q * q / (S * S)};
            for (const auto& [near, far] : halves) {
                const MirrorFacet facet = facets(near, far);
                lobes.step[at] = kStepsPerDegree * facet.theta_d_deg;
                lobes.lobe[at++] = lobe(alpha, facet);
            }
        }
    });
    return lobes;
}

std::vector<double> Adding::straight_of(const Grid& grid,
                                        const std::vector<double>& wavelength_nm) const {
    const std::size_t angles = grid.theta_deg.size(), L = scattering_.layers();
    std::vector<double> all(angles * wavelength_nm.size() * L);
    for (std::size_t l = 0; l < L; ++l) {
        const LayerTransport& layer = scattering_.layer(l);
        const AngleSeries powers = layer.powers(wavelength_nm);
        parallel_for(angles, execution_.threads, [&](std::size_t i) {
            const std::vector<double> tau =
                layer.straight(powers, grid.theta_deg[i], scattering_.crossings());
            for (std::size_t w = 0; w < tau.size(); ++w) all[(w * L + l) * angles + i] = tau[w];
        });
    }
    return all;
}

/// Calls take(mode, rest) with the light reflected more than once, [angle asked for][angle asked
/// for, or node] without what the coating takes on the way in and out, until take() says that no
/// more is needed.
///   tau       [layer][angle]
///   to_nodes  the columns are the nodes
template <class Take>
void Adding::solve(const Grid& grid, std::span<const Lobes> lobes, std::span<const double> tau,
                   double wavelength_nm, std::size_t most_modes, bool to_nodes,
                   const Take& take) const {
    const std::size_t layers = lobes.size(), all = grid.theta_deg.size();
    const auto size = static_cast<Eigen::Index>(all), nodes = static_cast<Eigen::Index>(grid.nodes);
    const Eigen::Index extra = size - nodes, columns = to_nodes ? nodes : extra;
    const Eigen::Index from = to_nodes ? 0 : nodes;    // of the columns
    std::vector<ModeMatrix> samples, kernels(layers);  // of each layer
    std::vector<double> theta_d(kSteps + 1);
    for (std::size_t k = 0; k <= kSteps; ++k) theta_d[k] = static_cast<double>(k) / kStepsPerDegree;
    std::vector<std::vector<double>> peaks, powers;  // R at the peaks of each layer, (-rho)^mode
    for (std::size_t l = 0; l < layers; ++l) {
        std::vector<double> R = scattering_.layer(l).facets().values(theta_d, {wavelength_nm});
        R.resize(kSteps + 1);
        R.push_back(R.back());
        peaks.push_back(lobes[l].at_peaks(R));
        powers.emplace_back(peaks[l].size(), 1.0);
        samples.push_back(lobes[l].samples(R, peaks[l]));
    }
    const bool is_coated = scattering_.coating().is_there();
    // B is once + more: light reflected once, and more than once; wKw a kernel with its weights
    ModeMatrix once(size, size), more(size, size), B, K(size, size), wKw, BwKw, F, X;
    ModeMatrix result(extra, columns);
    for (std::size_t mode = 0; mode <= most_modes; ++mode) {
        if (mode % kModesTogether == 0)
            for (std::size_t l = 0; l < layers; ++l)
                kernels[l].noalias() =
                    samples[l].transpose() *
                    mode_columns(lobes[l].azimuths, mode,
                                 std::min(kModesTogether, most_modes + 1 - mode));
        const double base =
            mode == 0 && scattering_.has_base() ? scattering_.base_albedo(wavelength_nm) / kPi : 0;
        once.setConstant(base);
        more.setZero();
        result.setZero();
        bool is_dark = base == 0;
        for (std::size_t l = layers; l-- > 0;) {
            const auto column = static_cast<Eigen::Index>(mode % kModesTogether);
            const double* pair = kernels[l].data() + column * kernels[l].rows();
            const double* R = peaks[l].data();
            const Lobes::Peak* peak = lobes[l].peaks.data();
            double* power = powers[l].data();
            const auto m = static_cast<double>(mode);
            for (Eigen::Index i = 0; i < size; ++i)
                for (Eigen::Index j = 0; j <= i; ++j, ++R, ++peak, ++power) {
                    const double D = *power * (peak->constant + m * peak->slope);
                    K(i, j) = K(j, i) = *pair++ + *R * peak->scale * (mode == 0 ? 1 + D : D);
                    *power *= peak->ratio;
                }
            if (!is_dark) {
                const Eigen::Map<const Eigen::VectorXd> through(tau.data() + l * all, size);
                B = once + more;
                // X = B + B w K w X
                wKw.noalias() = grid.weight.asDiagonal() * K.topLeftCorner(nodes, nodes) *
                                grid.weight.asDiagonal();
                const auto apply = [&](const ModeMatrix& x) -> ModeMatrix {
                    return B.topLeftCorner(nodes, nodes) * (wKw * x);
                };
                const auto matrix = [&]() -> ModeMatrix {
                    return B.topLeftCorner(nodes, nodes) * wKw;
                };
                if (l == 0 && !is_coated) {
                    F = B.block(0, from, nodes, columns);
                    solve_series(apply, matrix, F, X);
                    result.noalias() = B.bottomLeftCorner(extra, nodes) * (wKw * X);
                    result += more.block(nodes, from, extra, columns);
                    result = through.tail(extra).asDiagonal() * result *
                             through.segment(from, columns).asDiagonal();
                    break;
                }
                BwKw.noalias() = B.leftCols(nodes) * wKw;
                F = B.topRows(nodes);
                X = (ModeMatrix::Identity(nodes, nodes) - BwKw.topRows(nodes))
                        .partialPivLu()
                        .solve(F);
                more.noalias() += BwKw * X;
                more = through.asDiagonal() * more * through.asDiagonal();
                once = through.asDiagonal() * once * through.asDiagonal();
            }
            once += K;
            is_dark = false;
        }
        if (is_coated) {
            const double sign = mode % 2 == 0 ? 1 : -1;
            const Eigen::VectorXd mirror = sign * grid.weight.cwiseProduct(grid.coating);
            B = once + more;
            const auto apply = [&](const ModeMatrix& x) -> ModeMatrix {
                return B.topLeftCorner(nodes, nodes) * (mirror.asDiagonal() * x);
            };
            const auto matrix = [&]() -> ModeMatrix {
                return B.topLeftCorner(nodes, nodes) * mirror.asDiagonal();
            };
            F = B.block(0, from, nodes, columns);
            solve_series(apply, matrix, F, X);
            result.noalias() = B.bottomLeftCorner(extra, nodes) * (mirror.asDiagonal() * X);
            result += more.block(nodes, from, extra, columns);
        }
        if (!take(mode, result)) return;
    }
}

/// The rest of pairs whose angles are few.
std::vector<double> Adding::block_at(std::span<const ScatterPair> pairs,
                                     const std::vector<double>& wavelength_nm,
                                     std::size_t level) const {
    const std::size_t W = wavelength_nm.size(), layers = scattering_.layers();
    const Coating& coating = scattering_.coating();
    std::map<double, std::size_t> places;  // of angles inside
    for (const ScatterPair& pair : pairs)
        for (const double theta : {pair.theta_i_deg, pair.theta_o_deg})
            places.try_emplace(coating.inward(theta).theta_deg, 0);
    std::vector<double> extra;
    for (auto& [theta, place] : places) {
        place = extra.size();
        extra.push_back(theta);
    }
    struct Seen {
        Eigen::Index i, o;
        double factor, turn_deg;
    };
    std::vector<Seen> seen;
    for (const ScatterPair& pair : pairs) {
        const Coating::Crossing i = coating.inward(pair.theta_i_deg);
        const Coating::Crossing o = coating.inward(pair.theta_o_deg);
        seen.push_back({static_cast<Eigen::Index>(places.at(i.theta_deg)),
                        static_cast<Eigen::Index>(places.at(o.theta_deg)),
                        i.T * o.T * coating.dilution(), 180 - pair.phi_deg});  // exact at 180
    }
    const std::vector<double> once = scattering_.brdf(pairs, wavelength_nm, Paths::single);
    const Grid grid = grid_of(level, extra);
    std::vector<Lobes> lobes;
    for (std::size_t l = 0; l < layers; ++l)
        lobes.push_back(lobes_of(grid, l, kLevels[level].azimuths));
    const std::vector<double> tau = straight_of(grid, wavelength_nm);
    const std::size_t all = grid.theta_deg.size();
    std::vector<double> rest(pairs.size() * W);
    parallel_for(W, execution_.threads, [&](std::size_t w) {
        std::size_t small = 0;
        solve(grid, lobes, std::span(tau).subspan(w * layers * all, layers * all), wavelength_nm[w],
              kLevels[level].azimuths - 1, false, [&](std::size_t mode, const ModeMatrix& more) {
                  bool is_small = true;
                  for (std::size_t p = 0; p < seen.size(); ++p) {
                      const auto& [i, o, factor, turn_deg] = seen[p];
                      const double part = (mode == 0 ? 1 : 2) * factor * more(i, o) *
                                          (mode % 2 == 0 ? 1 : -1) *
                                          cos_deg(static_cast<double>(mode) * turn_deg);
                      const double largest = 2 * factor * std::abs(more(i, o));
                      double& sum = rest[p * W + w];
                      sum += part;
                      is_small = is_small && largest <= kModeShare * tolerance_ *
                                                            (once[p * W + w] + std::abs(sum));
                  }
                  small = is_small ? small + 1 : 0;
                  return small < 3;
              });
    });
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = std::max(-once[k], rest[k]);
    return rest;
}

std::vector<double> Adding::brdf_rest(std::span<const ScatterPair> pairs,
                                      const std::vector<double>& wavelength_nm,
                                      std::size_t level) const {
    std::vector<double> rest;
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
        std::set<double> angles;
        for (; end < pairs.size() && (angles.size() + 2 <= kAnglesTogether || end == begin); ++end)
            angles.insert({pairs[end].theta_i_deg, pairs[end].theta_o_deg});
        const std::vector<double> some =
            block_at(pairs.subspan(begin, end - begin), wavelength_nm, level);
        rest.insert(rest.end(), some.begin(), some.end());
    }
    return rest;
}

template <class Once>
Adding::Level Adding::level_of(const std::vector<double>& wavelength_nm, const Once& once,
                               const AtLevel& at_level, std::vector<double>* finer) const {
    const std::vector<double> by_one = once(wavelength_nm);
    Level level{first_level(), 0};
    std::vector<double> now = at_level(wavelength_nm, level.level);
    while (true) {
        std::vector<double> next = at_level(wavelength_nm, level.level + 1);
        level.error = 0;
        for (std::size_t k = 0; k < now.size(); ++k)
            if (const double whole = by_one[k] + std::abs(next[k]); whole > 0)
                level.error = std::max(level.error, std::abs(next[k] - now[k]) / whole);
        if (finer) *finer = next;
        if (level.error <= tolerance_ || level.level + 2 == kLevels.size()) return level;
        ++level.level;
        now = std::move(next);
    }
}

template <class Once>
Adding::Values Adding::refined(const std::vector<double>& wavelength_nm, const Once& once,
                               const AtLevel& at_level) const {
    Values result;
    if (wavelength_nm.size() <= kJudged) {
        result.error = level_of(wavelength_nm, once, at_level, &result.values).error;
        return result;
    }
    std::vector<double> some;
    for (std::size_t k = 0; k < kJudged; ++k)
        some.push_back(wavelength_nm[k * (wavelength_nm.size() - 1) / (kJudged - 1)]);
    const Level level = level_of(some, once, at_level, nullptr);
    result.error = level.error;
    // the finer one where the coarser one has hardly met it, as others may not have
    const bool is_met = level.error <= 0.5 * tolerance_;
    result.values = at_level(wavelength_nm, is_met ? level.level : level.level + 1);
    return result;
}

Adding::Level Adding::level_of(std::span<const ScatterPair> pairs,
                               const std::vector<double>& wavelength_nm) const {
    return level_of(
        wavelength_nm,
        [&](const std::vector<double>& nm) { return scattering_.brdf(pairs, nm, Paths::single); },
        [&](const std::vector<double>& nm, std::size_t level) {
            return brdf_rest(pairs, nm, level);
        },
        nullptr);
}

Adding::Values Adding::brdf_rest(std::span<const ScatterPair> pairs,
                                 const std::vector<double>& wavelength_nm) const {
    return refined(
        wavelength_nm,
        [&](const std::vector<double>& nm) { return scattering_.brdf(pairs, nm, Paths::single); },
        [&](const std::vector<double>& nm, std::size_t level) {
            return brdf_rest(pairs, nm, level);
        });
}

Adding::Values Adding::albedo_rest(std::span<const double> theta_i_deg,
                                   const std::vector<double>& wavelength_nm) const {
    const std::size_t layers = scattering_.layers();
    const Coating& coating = scattering_.coating();
    std::vector<double> extra;
    for (const double theta : theta_i_deg) extra.push_back(coating.inward(theta).theta_deg);
    const auto at_level = [&](const std::vector<double>& nm, std::size_t level) {
        const std::size_t W = nm.size();
        const Grid grid = grid_of(level, extra);
        std::vector<Lobes> lobes;
        for (std::size_t l = 0; l < layers; ++l)
            lobes.push_back(lobes_of(grid, l, kLevels[level].azimuths));
        const std::vector<double> tau = straight_of(grid, nm);
        const std::size_t all = grid.theta_deg.size();
        std::vector<double> rest(extra.size() * W);
        parallel_for(W, execution_.threads, [&](std::size_t w) {
            solve(grid, lobes, std::span(tau).subspan(w * layers * all, layers * all), nm[w], 0,
                  true, [&](std::size_t, const ModeMatrix& more) {
                      for (std::size_t i = 0; i < extra.size(); ++i) {
                          double sum = 0;
                          for (std::size_t j = 0; j < grid.nodes; ++j) {
                              const auto node = static_cast<Eigen::Index>(j);
                              sum += more(static_cast<Eigen::Index>(i), node) * grid.weight[node] *
                                     coating.outward(grid.theta_deg[j]).T;
                          }
                          rest[i * W + w] = coating.inward(theta_i_deg[i]).T * sum;
                      }
                      return false;
                  });
        });
        return rest;
    };
    return refined(
        wavelength_nm,
        [&](const std::vector<double>& nm) {
            return scattering_.albedo(theta_i_deg, nm, Paths::single);
        },
        at_level);
}

}  // namespace irido
