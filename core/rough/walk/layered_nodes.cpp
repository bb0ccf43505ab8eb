#include "core/rough/walk/layered_nodes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/math/random.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFittedPairs = 800, kCheckedPairs = 2000;
constexpr std::array<std::size_t, 12> kNodeCounts{3, 6, 9, 12, 15, 18, 21, 24, 30, 36, 48, 60};
constexpr std::array<std::size_t, 3> kAngleCounts{256, 512, 1024};

/// Fits of one number of nodes, each with more weight where the last one was worst.
constexpr int kRounds = 4;

/// Luminances below this count as this: of no colour.
constexpr double kDark = 0.01;

/// Linear between equally spaced angles: the value at the first and what to add.
struct AnglePlace {
    std::size_t below;
    double share;
    AnglePlace(double theta_deg, std::size_t angles) {
        const double place = std::clamp(theta_deg / 90, 0.0, 1.0) * static_cast<double>(angles - 1);
        below = std::min(static_cast<std::size_t>(place), angles - 2);
        share = place - static_cast<double>(below);
    }
    double mixed(double a, double b) const { return a + share * (b - a); }
};

/// A pair of directions inside the coating.
struct InnerPair {
    double theta_i_deg, theta_o_deg, transmitted;
    MirrorFacet facet;
    InnerPair(const Coating& coating, const ScatterPair& pair) {
        const Coating::Crossing i = coating.inward(pair.theta_i_deg);
        const Coating::Crossing o = coating.inward(pair.theta_o_deg);
        theta_i_deg = i.theta_deg;
        theta_o_deg = o.theta_deg;
        transmitted = i.T * o.T * coating.dilution();
        facet = mirror_facet(i.theta_deg, o.theta_deg, pair.phi_deg);
    }
    /// Of the layer, both ways.
    double masking(double alpha) const {
        return smith_masking(alpha, cos_of_incidence(theta_i_deg)) *
               smith_masking(alpha, cos_of_incidence(theta_o_deg));
    }
};

/// Pairs with their spectra: what gets through all layers down to layer l, and what is below it,
/// under the three sensitivities, times all that does not depend on the wavelength.
struct PairSpectra {
    std::vector<Triple> xyz, top;                ///< of pi times the BRDF; of the top layer alone
    std::vector<MatrixXd> through;               ///< [l](pair, wavelength)
    std::vector<std::array<MatrixXd, 3>> below;  ///< [l][c](pair, wavelength)
};

PairSpectra spectra_of(const LayeredScattering& scattering, const TabulatedScattering& exact,
                       std::span<const ScatterPair> pairs) {
    const std::size_t W = exact.wavelengths(), crossed = exact.straight().size();
    PairSpectra spectra;
    spectra.xyz.resize(pairs.size());
    spectra.top.resize(pairs.size());
    const auto P = static_cast<Index>(pairs.size()), columns = static_cast<Index>(W);
    spectra.through.assign(crossed, MatrixXd::Ones(P, columns));
    spectra.below.resize(crossed);
    for (std::array<MatrixXd, 3>& three : spectra.below) three.fill(MatrixXd::Zero(P, columns));
    std::vector<double> R(W), tau_i(W), tau_o(W);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const InnerPair pair(scattering.coating(), pairs[p]);
        const auto row = static_cast<Index>(p);
        double scale = kPi * pair.transmitted;
        for (std::size_t l = 0; l < scattering.layers() + 1; ++l) {
            const bool is_base = l == scattering.layers();
            if (is_base && exact.base().empty()) break;
            if (is_base) {
                R = exact.base();
            } else {
                exact.facets()[l].at(pair.facet.theta_d_deg, R);
            }
            const double lit =
                scale * (is_base ? 1 / kPi : lobe(scattering.layer(l).alpha(), pair.facet));
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t w = 0; w < W; ++w) {
                    const double seen = exact.weight()[c][w] * lit * R[w];
                    const auto column = static_cast<Index>(w);
                    if (l == 0) {
                        spectra.top[p][c] += seen;
                        spectra.xyz[p][c] += seen;
                    } else {
                        spectra.below[l - 1][c](row, column) = seen;
                        spectra.xyz[p][c] += seen * spectra.through[l - 1](row, column);
                    }
                }
            if (l >= crossed) break;
            exact.straight()[l].at(pair.theta_i_deg, tau_i);
            exact.straight()[l].at(pair.theta_o_deg, tau_o);
            for (std::size_t w = 0; w < W; ++w) {
                const auto column = static_cast<Index>(w);
                const double above = l > 0 ? spectra.through[l - 1](row, column) : 1;
                spectra.through[l](row, column) = above * tau_i[w] * tau_o[w];
            }
            scale *= pair.masking(scattering.layer(l).alpha());
        }
    }
    return spectra;
}

/// Spectra that reproduce others from their values at the nodes.
struct NodeBasis {
    std::vector<Index> node;        ///< columns of the rule's wavelengths
    std::vector<MatrixXd> spectra;  ///< [l](node, wavelength)
    double error = 0;               ///< largest CIEDE2000 of the pairs that it was fitted to
};

class NodeFit {
public:
    NodeFit(PairSpectra pairs, const std::array<std::vector<double>, 3>& weight,
            const Triple& white)
        : pairs_(std::move(pairs)), white_(white) {
        const Index P = pairs_.through.front().rows(), W = pairs_.through.front().cols();
        MatrixXd all(P * static_cast<Index>(pairs_.through.size()), W);
        for (std::size_t l = 0; l < pairs_.through.size(); ++l)
            all.middleRows(static_cast<Index>(l) * P, P) = pairs_.through[l];
        for (Index w = 0; w < W; ++w) {
            double seen = 0;
            for (const std::vector<double>& one : weight) seen += one[static_cast<std::size_t>(w)];
            all.col(w) *= std::sqrt(std::max(0.0, seen));
        }
        const Eigen::ColPivHouseholderQR<MatrixXd> pivoted(all);
        for (Index k = 0; k < W; ++k) order_.push_back(pivoted.colsPermutation().indices()[k]);
    }

    NodeBasis operator()(std::size_t count) const {
        NodeBasis best;
        best.node.assign(order_.begin(), order_.begin() + static_cast<Index>(count));
        VectorXd importance(pairs_.through.front().rows());
        for (Index p = 0; p < importance.size(); ++p) {
            const double Y = pairs_.xyz[static_cast<std::size_t>(p)][1];
            importance[p] = std::pow(std::clamp(Y, kDark, 1.0), -2.0 / 3.0);  // as CIELAB
        }
        for (int round = 0; round < kRounds; ++round) {
            importance /= importance.mean();
            NodeBasis basis{best.node, {}, 0};
            for (const MatrixXd& through : pairs_.through)
                basis.spectra.push_back(fitted(through, basis.node, importance));
            const VectorXd errors = errors_of(basis);
            basis.error = errors.maxCoeff();
            if (round == 0 || basis.error < best.error) best = basis;
            const double mean = std::max(errors.mean(), 1e-9);
            importance.array() *= (errors.array() / mean + 0.1).sqrt();
        }
        return best;
    }

private:
    /// Least squares over the rows, with a little of a bound on the size.
    static MatrixXd fitted(const MatrixXd& through, const std::vector<Index>& node,
                           const VectorXd& importance) {
        constexpr double kRidge = 1e-9;
        const auto K = static_cast<Index>(node.size());
        MatrixXd at_nodes(through.rows(), K);
        for (Index k = 0; k < K; ++k)
            at_nodes.col(k) =
                through.col(node[static_cast<std::size_t>(k)]).cwiseProduct(importance);
        MatrixXd normal = at_nodes.transpose() * at_nodes;
        normal.diagonal().array() +=
            kRidge * std::max(normal.trace() / static_cast<double>(K), 1e-300);
        const MatrixXd right = at_nodes.transpose() * (importance.asDiagonal() * through);
        return normal.llt().solve(right);
    }

    VectorXd errors_of(const NodeBasis& basis) const {
        std::vector<Triple> xyz = pairs_.top;
        const auto K = static_cast<Index>(basis.node.size());
        for (std::size_t l = 0; l < basis.spectra.size(); ++l)
            for (std::size_t c = 0; c < 3; ++c) {
                const MatrixXd parts = pairs_.below[l][c] * basis.spectra[l].transpose();
                for (Index p = 0; p < parts.rows(); ++p)
                    for (Index k = 0; k < K; ++k)
                        xyz[static_cast<std::size_t>(p)][c] +=
                            parts(p, k) *
                            pairs_.through[l](p, basis.node[static_cast<std::size_t>(k)]);
            }
        VectorXd errors(static_cast<Index>(xyz.size()));
        for (std::size_t p = 0; p < xyz.size(); ++p) {
            Triple a{}, b{};
            for (std::size_t c = 0; c < 3; ++c) {
                a[c] = xyz[p][c] / kPi;
                b[c] = pairs_.xyz[p][c] / kPi;
            }
            errors[static_cast<Index>(p)] = scatter_difference(a, b, white_);
        }
        return errors;
    }

    PairSpectra pairs_;
    Triple white_;
    std::vector<Index> order_;  ///< of the rule's wavelengths, the most telling first
};

/// Exact colours of R of the top layer.
std::vector<Triple> top_colors(const LayeredScattering& scattering, const ColorTables& tables,
                               std::span<const double> theta_deg, const Execution& execution) {
    ColorRequest request;
    request.colors = theta_deg.size();
    request.simd = execution.simd;
    request.tolerance = 1e-5;
    std::vector<Triple> colors;
    for (const StackColor& one : stack_color(tables, scattering.layer(0).facets().stack(), {},
                                             request, theta_deg, execution.threads))
        colors.push_back(one.xyz);
    return colors;
}

/// Everything at the angles of a table.
LayeredNodes tabulated(const LayeredScattering& scattering, const TabulatedScattering& exact,
                       const ColorTables& tables, const NodeBasis& basis, std::size_t angles,
                       const NodeRequest& request, const Execution& execution) {
    const std::size_t W = exact.wavelengths(), K = basis.node.size();
    LayeredNodes result;
    result.angles = angles;
    std::vector<double> theta_deg(angles);
    for (std::size_t k = 0; k < angles; ++k)
        theta_deg[k] = 90 * static_cast<double>(k) / static_cast<double>(angles - 1);
    result.top = top_colors(scattering, tables, theta_deg, execution);
    std::vector<double> row(W);
    for (std::size_t l = 0; l < basis.spectra.size(); ++l) {
        std::vector<double> straight;
        std::vector<Triple> below;
        std::array<std::vector<double>, 3> part;  // of each node, [node][wavelength]
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t j = 0; j < K; ++j)
                for (std::size_t w = 0; w < W; ++w)
                    part[c].push_back(
                        exact.weight()[c][w] *
                        basis.spectra[l](static_cast<Index>(j), static_cast<Index>(w)));
        for (std::size_t k = 0; k < angles; ++k) {
            exact.straight()[l].at(theta_deg[k], row);
            for (const Index node : basis.node)
                straight.push_back(row[static_cast<std::size_t>(node)]);
            if (l + 1 < scattering.layers())
                exact.facets()[l + 1].at(theta_deg[k], row);
            else
                row = exact.base();
            for (std::size_t j = 0; j < K; ++j) {
                Triple& xyz = below.emplace_back();
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t w = 0; w < W; ++w) xyz[c] += part[c][j * W + w] * row[w];
            }
        }
        result.straight.push_back(std::move(straight));
        result.below.push_back(std::move(below));
    }
    for (const Index node : basis.node)
        result.wavelength_nm.push_back(exact.wavelength_nm()[static_cast<std::size_t>(node)]);
    const auto store = [&](std::vector<Triple>& colors) {
        for (Triple& xyz : colors)
            for (double& part : xyz) part = request.stored(part);
    };
    store(result.top);
    for (std::vector<Triple>& colors : result.below) store(colors);
    for (std::vector<double>& values : result.straight)
        for (double& value : values) value = request.stored(value);
    return result;
}

/// XYZ of the BRDF of pairs, by the rule but for the top layer.
std::vector<Triple> colors_of(const LayeredScattering& scattering, const TabulatedScattering& exact,
                              const ColorTables& tables, std::span<const ScatterPair> pairs,
                              const Execution& execution) {
    std::vector<InnerPair> inner;
    std::vector<double> theta_d_deg;
    for (const ScatterPair& pair : pairs) {
        inner.emplace_back(scattering.coating(), pair);
        theta_d_deg.push_back(inner.back().facet.theta_d_deg);
    }
    const std::vector<Triple> top = top_colors(scattering, tables, theta_d_deg, execution);
    std::vector<Triple> colors;
    std::vector<double> R(exact.wavelengths());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const double half_deg = 0.5 * pairs[p].phi_deg;
        Triple& xyz = colors.emplace_back(exact(exact.direction(pairs[p].theta_i_deg),
                                                exact.direction(pairs[p].theta_o_deg),
                                                sin_deg(90 - half_deg), sin_deg(half_deg)));
        exact.facets()[0].at(theta_d_deg[p], R);
        const double scale =
            inner[p].transmitted * lobe(scattering.layer(0).alpha(), inner[p].facet);
        for (std::size_t c = 0; c < 3; ++c) {
            double by_rule = 0;
            for (std::size_t w = 0; w < R.size(); ++w) by_rule += exact.weight()[c][w] * R[w];
            xyz[c] += scale * (top[p][c] - by_rule);
        }
    }
    return colors;
}

/// Largest CIEDE2000 of colours multiplied in linear sRGB in the place of spectra.
double product_error(const LayeredScattering& scattering, const TabulatedScattering& exact,
                     const Triple& white, std::span<const ScatterPair> pairs,
                     std::span<const Triple> truth) {
    const RgbTransform rgb(rgb_space("srgb"), white, Adaptation::bradford);
    std::vector<double> row(exact.wavelengths());
    const auto color_of = [&](const std::vector<double>& spectrum) {
        Triple xyz{};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t w = 0; w < spectrum.size(); ++w)
                xyz[c] += exact.weight()[c][w] * spectrum[w];
        return rgb(xyz);
    };
    double worst = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const InnerPair pair(scattering.coating(), pairs[p]);
        Triple through{1, 1, 1}, sum{};
        const auto multiply = [&](Triple& to, const Triple& by, double scale) {
            for (std::size_t c = 0; c < 3; ++c) to[c] *= scale * by[c];
        };
        const auto add = [&](Triple part, double scale) {
            multiply(part, through, scale * pair.transmitted);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += part[c];
        };
        for (std::size_t l = 0; l < scattering.layers(); ++l) {
            const double alpha = scattering.layer(l).alpha();
            exact.facets()[l].at(pair.facet.theta_d_deg, row);
            add(color_of(row), lobe(alpha, pair.facet));
            if (l >= exact.straight().size()) break;
            for (const double theta : {pair.theta_i_deg, pair.theta_o_deg}) {
                exact.straight()[l].at(theta, row);
                multiply(through, color_of(row), smith_masking(alpha, cos_of_incidence(theta)));
            }
        }
        if (!exact.base().empty()) add(color_of(exact.base()), 1 / kPi);
        worst = std::max(worst, scatter_difference(rgb.xyz_of(sum), truth[p], white));
    }
    return worst;
}

}  // namespace

Triple LayeredNodes::operator()(const LayeredScattering& scattering,
                                const ScatterPair& pair) const {
    const InnerPair inner(scattering.coating(), pair);
    const AnglePlace d(inner.facet.theta_d_deg, angles), i(inner.theta_i_deg, angles),
        o(inner.theta_o_deg, angles);
    Triple xyz{};
    for (std::size_t c = 0; c < 3; ++c)
        xyz[c] = d.mixed(top[d.below][c], top[d.below + 1][c]) *
                 lobe(scattering.layer(0).alpha(), inner.facet);
    const std::size_t K = wavelength_nm.size();
    std::vector<double> through(K, 1);
    double masking = 1;
    for (std::size_t l = 0; l < straight.size(); ++l) {
        masking *= inner.masking(scattering.layer(l).alpha());
        const bool is_base = l + 1 == scattering.layers();
        const double lit =
            masking * (is_base ? 1 / kPi : lobe(scattering.layer(l + 1).alpha(), inner.facet));
        for (std::size_t j = 0; j < K; ++j) {
            for (const AnglePlace& at : {i, o})
                through[j] *=
                    at.mixed(straight[l][at.below * K + j], straight[l][(at.below + 1) * K + j]);
            const Triple& low = below[l][d.below * K + j];
            const Triple& high = below[l][(d.below + 1) * K + j];
            for (std::size_t c = 0; c < 3; ++c)
                xyz[c] += lit * through[j] * d.mixed(low[c], high[c]);
        }
    }
    for (double& part : xyz) part *= inner.transmitted;
    return xyz;
}

double scatter_difference(const Triple& a, const Triple& b, const Triple& white) {
    const double scale = kPi / std::max({1.0, kPi * a[1], kPi * b[1]});
    const auto lab_of = [&](const Triple& xyz) {
        Triple scaled{};
        for (std::size_t c = 0; c < 3; ++c) scaled[c] = std::max(0.0, scale * xyz[c]);
        return lab(scaled, white);
    };
    return ciede2000(lab_of(a), lab_of(b));
}

std::vector<ScatterPair> sample_pairs(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<ScatterPair> pairs;
    for (std::size_t k = 0; k < count; ++k) {
        const double theta = random.uniform(0, 80);
        if (k % 2 == 0) {
            const double near = std::clamp(theta + random.uniform(-10, 10), 0.0, 85.0);
            pairs.push_back({theta, near, random.uniform(170, 180)});
        } else {
            const double other = random.uniform(0, 80);
            pairs.push_back({theta, other, random.uniform(0, 180)});
        }
    }
    return pairs;
}

FoundNodes find_nodes(const LayeredScattering& scattering, const TabulatedScattering& exact,
                      const ColorTables& tables, const NodeRequest& request,
                      const Execution& execution) {
    const Triple& white = tables.sensitivity().white();
    const std::vector<ScatterPair> checked = sample_pairs(kCheckedPairs, 2);
    const std::vector<Triple> truth = colors_of(scattering, exact, tables, checked, execution);
    const auto error_of = [&](const LayeredNodes& table) {
        double worst = 0;
        for (std::size_t p = 0; p < checked.size(); ++p)
            worst =
                std::max(worst, scatter_difference(table(scattering, checked[p]), truth[p], white));
        return worst;
    };
    std::vector<std::size_t> counts(kNodeCounts.begin(), kNodeCounts.end());
    if (request.nodes) counts = {*request.nodes};
    std::optional<NodeFit> fit;
    if (exact.straight().empty())
        counts = {0};
    else
        fit.emplace(spectra_of(scattering, exact, sample_pairs(kFittedPairs, 1)), exact.weight(),
                    white);
    std::size_t angles = request.angles.value_or(kAngleCounts.front());
    std::optional<FoundNodes> best;
    for (const std::size_t count : counts) {
        const NodeBasis basis = fit ? (*fit)(count) : NodeBasis{};
        for (;;) {
            FoundNodes found{
                tabulated(scattering, exact, tables, basis, angles, request, execution), 0, 0};
            found.error = error_of(found.table);
            if (!best || found.error < best->error) best = std::move(found);
            // more angles where more nodes would not help
            if (best->error <= request.tolerance || request.angles ||
                angles >= kAngleCounts.back() || basis.error > 0.5 * request.tolerance)
                break;
            angles *= 2;
        }
        if (best->error <= request.tolerance) break;
    }
    best->products = product_error(scattering, exact, white, checked, truth);
    return std::move(*best);
}

}  // namespace irido
