#include "core/color/quadrature/branch_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/keep_once.hpp"
#include "core/math/square.hpp"

namespace irido {

namespace {

/// Equal pieces of the support. Where there are no rows, the most of them follow formulas.
constexpr std::array kPieces{32, 8};

/// Pieces tell of branch points so many times their own length away.
constexpr double kReach = 2;

/// Points further outside their piece than this part of its length belong to another one.
constexpr double kWithin = 0.1;

/// Newton's steps towards a branch point: pieces are nearly straight.
constexpr int kSteps = 4;

/// Materials of a substrate and of incoherent layers.
void add_outer(const std::vector<Element>& elements, std::vector<std::size_t>& materials) {
    for (const Element& element : elements) {
        if (const Group* group = std::get_if<Group>(&element.value)) {
            add_outer(group->elements, materials);
        } else if (const Layer& layer = std::get<Layer>(element.value); !layer.coherent) {
            materials.push_back(layer.material);
        }
    }
}

/// Whether a straight piece between values may have a zero within reach.
bool is_near(Complex from, Complex to) {
    return std::norm(from + to) < square(1 + 2 * kReach) * std::norm(from - to);
}

/// Whether values on a curve come close to some sine.
bool is_near_sines(std::span<const Complex> curve) {
    double re_least = curve[0].real(), re_most = re_least, im_least = curve[0].imag(),
           im_most = im_least, longest = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        re_least = std::min(re_least, curve[i].real());
        re_most = std::max(re_most, curve[i].real());
        im_least = std::min(im_least, curve[i].imag());
        im_most = std::max(im_most, curve[i].imag());
        if (i > 0) longest = std::max(longest, std::abs(curve[i] - curve[i - 1]));
    }
    const double extent = std::hypot(re_most - re_least, im_most - im_least);
    const double reach = (1 + kReach) * std::max(longest, extent / kPieces.back());
    return std::ranges::any_of(
        curve, [&](Complex at) { return at.real() <= 1 + reach && std::abs(at.imag()) <= reach; });
}

}  // namespace

double fall_rate(std::span<const BranchPoint> points, WavelengthRange panel) {
    const double first = 1 / panel.first_nm, last = 1 / panel.last_nm;
    const double middle = (first + last) / 2, half = (first - last) / 2;
    double rate = std::numeric_limits<double>::infinity();
    for (const BranchPoint& point : points) {
        if (point.range.last_nm <= panel.first_nm || point.range.first_nm >= panel.last_nm)
            continue;
        const Complex x = (point.inverse_nm - middle) / half, root = std::sqrt(x * x - 1.0);
        rate = std::min(rate, std::log(std::max(std::abs(x + root), std::abs(x - root))));
    }
    return rate;
}

double effect_of_branch(std::span<const BranchPoint> points, std::size_t material,
                        WavelengthRange panel) {
    double effect = 0;
    for (const BranchPoint& point : points) {
        if (std::ranges::find(point.materials, material) == point.materials.end()) continue;
        const double nm = (1.0 / point.inverse_nm).real();
        const double apart = kWithin * (point.range.last_nm - point.range.first_nm);
        if (nm < point.range.first_nm - apart || nm > point.range.last_nm + apart) continue;
        const double closest =
            std::clamp(point.inverse_nm.real(), 1 / panel.last_nm, 1 / panel.first_nm);
        effect = std::max(effect, 1 / (point.slope_nm * std::abs(point.inverse_nm - closest)));
    }
    return effect;
}

BranchPoints::BranchPoints(const Stack& stack, const IndexTable& rows) : stack_(stack) {
    std::vector<std::size_t> outer{stack.substrate};
    add_outer(stack.elements, outer);
    keep_once(outer);
    std::vector<Complex> curve;
    const auto add = [&](std::size_t material, std::size_t row) {
        if (row == rows.incident()) return;
        if (!rows.row_varies(row) && !rows.row_varies(rows.incident())) return;
        curve.clear();
        for (std::size_t w = 0; w < rows.wavelength_nm().size(); ++w)
            curve.push_back(rows.index(row, w) / rows.n(rows.incident(), w));
        if (is_near_sines(curve)) media_.push_back({material, row != material, {}});
    };
    for (const std::size_t m : outer) {
        add(m, m);
        if (rows.extraordinary(m) != m) add(m, rows.extraordinary(m));
    }
    if (media_.empty()) return;
    const double from = rows.wavelength_nm().front(), to = rows.wavelength_nm().back();
    for (const int pieces : kPieces) {
        grids_.emplace_back();
        for (int i = 0; i <= pieces; ++i) grids_.back().push_back(from + (to - from) * i / pieces);
    }
    grids_.push_back(rows.wavelength_nm());
    grids_.back().insert(grids_.back().end(), grids_.front().begin(), grids_.front().end());
    keep_once(grids_.back());
    for (Outer& medium : media_)
        for (const std::vector<double>& grid : grids_) {
            medium.ratios.emplace_back();
            for (const double nm : grid) medium.ratios.back().push_back(ratio_at(medium, nm));
        }
}

Complex BranchPoints::ratio_at(const Outer& medium, double nm) const {
    const Material& material = stack_.materials[medium.material];
    return (medium.is_extraordinary ? extraordinary_index_at(material, nm)
                                    : index_at(material, nm)) /
           index_at(stack_.materials[stack_.incident], nm).real();
}

void BranchPoints::find(IncidentAngle incidence, std::vector<BranchPoint>& points) const {
    points.clear();
    for (const Outer& medium : media_)
        for (std::size_t g = 0; g < grids_.size(); ++g)
            for (std::size_t i = 1; i < grids_[g].size(); ++i) {
                const Complex from = medium.ratios[g][i - 1] - incidence.sin,
                              to = medium.ratios[g][i] - incidence.sin;
                if (is_near(from, to))
                    add_point(medium, {grids_[g][i - 1], grids_[g][i]}, from, to, incidence,
                              points);
            }
}

void BranchPoints::add_point(const Outer& medium, WavelengthRange piece, Complex from, Complex to,
                             IncidentAngle incidence, std::vector<BranchPoint>& points) const {
    const double length = piece.last_nm - piece.first_nm;
    const Complex slope = (to - from) / length;
    Complex at = piece.first_nm - from / slope;
    for (int step = 0; step < kSteps; ++step) {
        const double nm = std::clamp(at.real(), piece.first_nm, piece.last_nm);
        at = nm - (ratio_at(medium, nm) - incidence.sin) / slope;
    }
    points.push_back(
        {piece, 1.0 / at, std::norm(at) * std::abs(slope), {medium.material, stack_.incident}});
}

}  // namespace irido
