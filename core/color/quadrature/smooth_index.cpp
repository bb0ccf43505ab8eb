#include "core/color/quadrature/smooth_index.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/keep_once.hpp"
#include "core/math/gauss.hpp"

namespace irido {

namespace {

/// Largest degree of the polynomials, one more than there are rows otherwise: enough for what a
/// smooth curve does over a panel, and too few to follow the kinks of a dense table.
constexpr std::size_t kLargestDegree = 8;

/// Squares of normal indices below this part of the index' own are taken to be that.
constexpr double kLeastNormal = 1e-6;

/// Least weight of a wavelength in the fit, of the mean.
constexpr double kLeastWeight = 1e-3;

/// Moments that are taken, and those that the fit makes small, each this much less than the one
/// before, as dR/dn has less of it; and what the mean square of delta counts beside their squares.
constexpr Eigen::Index kMoments = 33, kMatched = 6;
constexpr double kMatchedFall = 0.4, kSquares = 1e-4;

/// Points of a panel, a few in each cell between rows of anything.
struct CellPoints {
    std::vector<double> wavelength_nm;
    Eigen::ArrayXd x, fit_weight;
    std::array<Eigen::ArrayXd, 3> weight;  ///< with the sensitivity
};

template <int count>
void add_points(const Sensitivity& sensitivity, double first, double last, std::vector<double>& nm,
                std::vector<double>& width, std::vector<Triple>& weight) {
    const double reach = (last - first) / 2, centre = (last + first) / 2;
    for (const GaussNode& node : gauss_legendre<count>()) {
        nm.push_back(centre + reach * node.x);
        width.push_back(reach * node.weight);
        weight.push_back(sensitivity.at(nm.back()));
        for (double& channel : weight.back()) channel *= width.back();
    }
}

/// Enough points for the squares of polynomials of kLargestDegree and for moments, whatever the
/// number of cells.
CellPoints cell_points(const Sensitivity& sensitivity, WavelengthRange panel,
                       std::span<const double> rows, double middle, double half) {
    constexpr std::size_t kFew = 16, kSome = 64;
    const std::vector<double> cells = sensitivity.cells(panel);
    std::vector<double> ends, width;
    std::ranges::set_union(cells, rows, std::back_inserter(ends));
    CellPoints points;
    std::vector<Triple> weight;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const auto add = ends.size() <= kFew    ? add_points<8>
                         : ends.size() <= kSome ? add_points<4>
                                                : add_points<2>;
        add(sensitivity, ends[i], ends[i + 1], points.wavelength_nm, width, weight);
    }
    const auto size = static_cast<Eigen::Index>(width.size());
    points.x.resize(size);
    points.fit_weight.resize(size);
    for (Eigen::ArrayXd& channel : points.weight) channel.resize(size);
    for (Eigen::Index at = 0; at < size; ++at) {
        const auto i = static_cast<std::size_t>(at);
        points.x[at] = (1 / points.wavelength_nm[i] - middle) / half;
        points.fit_weight[at] = width[i];
        for (std::size_t c = 0; c < 3; ++c) points.weight[c][at] = weight[i][c];
    }
    const Eigen::ArrayXd light = points.weight[0] + points.weight[1] + points.weight[2];
    const double mean = light.sum() / points.fit_weight.sum();
    points.fit_weight = light + kLeastWeight * mean * points.fit_weight +
                        std::numeric_limits<double>::min() * points.fit_weight;
    return points;
}

/// T_k at the points, a column each.
Eigen::ArrayXXd chebyshev_polynomials(const Eigen::ArrayXd& x, Eigen::Index count) {
    Eigen::ArrayXXd values(x.size(), count);
    values.col(0) = 1;
    if (count > 1) values.col(1) = x;
    for (Eigen::Index k = 2; k < count; ++k)
        values.col(k) = 2 * x * values.col(k - 1) - values.col(k - 2);
    return values;
}

/// Largest sum_k g_k mu_k of coefficients of a function that is bounded by 1: those of a polynomial
/// of the degree, by their squares, or falling at a rate.
double largest_sum(const Eigen::VectorXd& moments, double all, std::size_t degree,
                   std::size_t rate) {
    const auto count = static_cast<Eigen::Index>(degree) + 1;
    const double by_squares = std::sqrt(2 * moments.head(count).squaredNorm());
    const double step = std::exp(-kFallRates[rate] / static_cast<double>(degree));
    double sum = std::abs(moments[0]), size = 2;
    for (Eigen::Index k = 1; k < moments.size(); ++k) {
        size *= step;
        sum += size * std::abs(moments[k]);
    }
    return std::min(by_squares, sum + size * step / (1 - step) * all);
}

}  // namespace

IndexFit::IndexFit(const Stack& stack, const Sensitivity& sensitivity, WavelengthRange panel,
                   std::span<const std::size_t> materials, std::span<const double> rows)
    : middle_((1 / panel.first_nm + 1 / panel.last_nm) / 2),
      half_((1 / panel.first_nm - 1 / panel.last_nm) / 2),
      degree_(std::min(kLargestDegree, rows.size() + 1)) {
    const CellPoints points = cell_points(sensitivity, panel, rows, middle_, half_);
    const auto free = static_cast<Eigen::Index>(degree_) - 1;
    const Eigen::MatrixXd polynomials = chebyshev_polynomials(points.x, kMoments).matrix();
    const Eigen::ArrayXd bubble = 1 - points.x.square();
    const Eigen::MatrixXd basis = (polynomials.leftCols(free).array().colwise() * bubble).matrix();
    // rows whose products with what is lost are to be small: first orders, and a little of squares
    const Eigen::Index squares = points.x.size(), firsts = 3 * kMatched;
    Eigen::MatrixXd rows_of_sums(firsts, squares);
    for (std::size_t c = 0; c < 3; ++c) {
        const double light = points.weight[c].abs().sum();
        double scale = light > 0 ? 1 / light : 0;
        for (Eigen::Index k = 0; k < kMatched; ++k, scale *= kMatchedFall)
            rows_of_sums.row(static_cast<Eigen::Index>(3) * k + static_cast<Eigen::Index>(c)) =
                (scale * points.weight[c] * polynomials.col(k).array()).matrix().transpose();
    }
    const Eigen::ArrayXd square_weight = kSquares / points.fit_weight.sum() * points.fit_weight;
    const Eigen::MatrixXd sums = rows_of_sums * basis;
    const Eigen::MatrixXd weighted = sums.transpose() * rows_of_sums +
                                     (basis.array().colwise() * square_weight).matrix().transpose();
    const Eigen::LDLT<Eigen::MatrixXd> solve(weighted * basis);
    for (const std::size_t m : materials) {
        const Material& material = stack.materials[m];
        const Complex from = index_at(material, panel.first_nm),
                      to = index_at(material, panel.last_nm);
        Curve curve{m, true, {{{from.real(), to.real()}, {from.imag(), to.imag()}}}, {}};
        std::array<Eigen::ArrayXd, 2> lost;
        for (Eigen::ArrayXd& values : lost) values.resize(points.x.size());
        for (Eigen::Index i = 0; i < points.x.size(); ++i) {
            const Complex index =
                index_at(material, points.wavelength_nm[static_cast<std::size_t>(i)]);
            lost[0][i] = index.real();
            lost[1][i] = index.imag();
        }
        curve.absorbs_only = lost[1].minCoeff() >= 0;
        const Eigen::ArrayXd table_n = lost[0], table_k = lost[1];
        for (std::size_t part = 0; part < 2; ++part) {
            const auto [a, b] = curve.ends[part];
            lost[part] -= (a + b) / 2 + (a - b) / 2 * points.x;
            const Eigen::VectorXd c = solve.solve(weighted * lost[part].matrix());
            curve.bubble[part].assign(c.data(), c.data() + c.size());
            lost[part] -= (basis * c).array();
        }
        const bool is_index = (table_n - lost[0]).minCoeff() > 0 || table_n.minCoeff() <= 0;
        // k is taken as 0 where the polynomial is below it
        const double below =
            curve.absorbs_only ? std::max(0.0, -(table_k - lost[1]).minCoeff()) : 0;
        std::array<std::array<Triple, kFallRates.size()>, kLevels> first{};
        Triple second{}, cut{};
        for (std::size_t c = 0; c < 3; ++c) {
            for (const Eigen::ArrayXd& part : lost) {
                const Eigen::ArrayXd weight = points.weight[c] * part;
                const Eigen::VectorXd moments = polynomials.transpose() * weight.matrix();
                for (std::size_t level = 0; level < kLevels; ++level)
                    for (std::size_t rate = 0; rate < kFallRates.size(); ++rate)
                        first[level][rate][c] +=
                            largest_sum(moments, weight.abs().sum(), kDegrees[level], rate);
                second[c] += (weight * part).sum();
            }
            cut[c] = below * points.weight[c].sum();
        }
        for (std::size_t level = 0; level < kLevels; ++level) {
            for (std::size_t rate = 0; rate < kFallRates.size(); ++rate) {
                Error error{m, first[level][rate], second};
                for (std::size_t c = 0; c < 3; ++c) {
                    error.first[c] += cut[c];
                    if (!is_index) error.first[c] = std::numeric_limits<double>::infinity();
                }
                errors_[level][rate].push_back(error);
            }
        }
        curves_.push_back(std::move(curve));
    }
}

double IndexFit::x(double wavelength_nm) const {
    return std::clamp((1 / wavelength_nm - middle_) / half_, -1.0, 1.0);
}

void IndexFit::replace(IndexTable& table) const {
    std::vector<Complex> index(table.wavelength_nm().size());
    for (const Curve& curve : curves_) {
        for (std::size_t w = 0; w < index.size(); ++w) {
            const double at = x(table.wavelength_nm()[w]);
            std::array<double, 2> value;
            for (std::size_t part = 0; part < 2; ++part) {
                const auto [a, b] = curve.ends[part];
                double next = 0, after = 0;  // Clenshaw's sum
                for (std::size_t k = curve.bubble[part].size(); k-- > 1;)
                    after = std::exchange(next, curve.bubble[part][k] + 2 * at * next - after);
                const double series = curve.bubble[part][0] + at * next - after;
                value[part] = (a + b) / 2 + (a - b) / 2 * at + (1 - at * at) * series;
            }
            if (curve.absorbs_only) value[1] = std::max(0.0, value[1]);
            index[w] = {value[0], value[1]};
        }
        table.replace(curve.material, index);
    }
}

SmoothIndices::SmoothIndices(const Stack& stack, const Sensitivity& sensitivity)
    : stack_(stack), sensitivity_(sensitivity) {
    material_rows_.reserve(stack.materials.size());
    for (const Material& material : stack.materials) {
        material_rows_.push_back(table_rows(material, sensitivity.support()));
        rows_.insert(rows_.end(), material_rows_.back().begin(), material_rows_.back().end());
    }
    keep_once(rows_);
}

std::span<const double> SmoothIndices::rows_in(WavelengthRange panel) const {
    const auto from = std::ranges::upper_bound(rows_, panel.first_nm);
    const auto to = std::ranges::lower_bound(rows_, panel.last_nm);
    if (from >= to) return {};
    return {from, to};
}

double SmoothIndices::middle_row(WavelengthRange panel) const {
    const double middle = (1 / panel.first_nm + 1 / panel.last_nm) / 2;
    return std::ranges::min(rows_in(panel), {},
                            [&](double nm) { return std::abs(1 / nm - middle); });
}

std::unique_ptr<const IndexFit> SmoothIndices::fit(WavelengthRange panel) const {
    std::vector<std::size_t> materials;
    for (std::size_t m = 0; m < material_rows_.size(); ++m) {
        const auto above = std::ranges::upper_bound(material_rows_[m], panel.first_nm);
        if (above != material_rows_[m].end() && *above < panel.last_nm) materials.push_back(m);
    }
    return std::make_unique<const IndexFit>(stack_, sensitivity_, panel, materials, rows_in(panel));
}

std::vector<double> SmoothIndices::inverse_indices(WavelengthRange panel) const {
    std::vector<double> inverse;
    for (const Material& material : stack_.materials)
        inverse.push_back(
            1 / std::abs(index_at(material, 2 / (1 / panel.first_nm + 1 / panel.last_nm))));
    return inverse;
}

std::span<const double> SmoothIndices::effects(const IndexTable& table, IncidentAngle incidence,
                                               std::vector<double>& effects) const {
    effects.assign(table.materials(), 0);
    for (std::size_t m = 0; m < effects.size(); ++m) {
        if (!is_tabulated(m)) continue;
        for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w) {
            const Medium here = medium(table.index(m, w), table.n(table.incident(), w), incidence);
            const double eps = std::sqrt(std::norm(here.eps)), q2 = std::sqrt(std::norm(here.q2));
            effects[m] = std::max(effects[m], std::sqrt(eps) / std::max(q2, kLeastNormal * eps));
        }
    }
    return effects;
}

}  // namespace irido
