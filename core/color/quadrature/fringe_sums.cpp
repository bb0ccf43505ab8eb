#include "core/color/quadrature/fringe_sums.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/constants.hpp"
#include "core/math/imaginary.hpp"

namespace irido {

namespace {

/// Degrees of the polynomials: of a panel, and of a piece of one between two rows.
constexpr int kPanelDegree = 16, kPieceDegree = 8;

/// Panels are not cut below this share of their wavelength.
constexpr double kNarrowestPanel = 1e-9;

/// Part of the tolerance for every panel, whatever it weighs.
constexpr double kOfPanel = 1e-3;

/// Parts of a panel's error for each wave that is left out, and for all that is not resolved.
constexpr double kLeftOut = 0.05, kUnresolved = 0.2;

/// Estimates look at a few points and coefficients: those left out may add up.
constexpr double kDoubt = 4, kSumOfTail = 16;

/// Rounding of a phase, as part of the largest: it is not resolved by narrower panels.
constexpr double kPhaseRounding = 4e-15;

/// Radians per degree over which a polynomial follows a wave as well as its amplitude.
constexpr double kStandsStill = 0.25;

/// A wave whose phase bends everywhere has an integral of at most 8 (|a| + variation of a) over the
/// root of psi'' (van der Corput).
constexpr double kCorput = 8;

/// A slope of the phase that varies by a larger factor may have a zero close by.
constexpr double kSteady = 4;

/// Beats of two elements are looked for up to this order.
constexpr int kFarthestBeat = 24;

/// Points, differentiation and coefficients of one degree on [-1, 1], at -cos(pi j/degree).
template <int degree>
struct ChebyshevGrid {
    using Square = Eigen::Matrix<double, degree + 1, degree + 1>;
    using Points = Eigen::Matrix<double, degree + 1, 1>;
    Points x, weight;  ///< of Clenshaw and Curtis
    Square slope, coefficient;

    ChebyshevGrid() {
        for (int j = 0; j <= degree; ++j)
            x[j] = std::sin(std::numbers::pi * (2 * j - degree) / (2 * degree));
        const auto end = [](int j) { return j == 0 || j == degree ? 2.0 : 1.0; };
        for (int i = 0; i <= degree; ++i) {
            double sum = 0;
            for (int j = 0; j <= degree; ++j) {
                const double sign = (i + j) % 2 == 0 ? 1 : -1;
                coefficient(i, j) = 2 * std::cos(std::numbers::pi * i * (degree - j) / degree) /
                                    (degree * end(i) * end(j));
                if (i == j) continue;
                slope(i, j) = sign * end(i) / end(j) / (x[i] - x[j]);
                sum += slope(i, j);
            }
            slope(i, i) = -sum;
        }
        weight.setZero();
        for (int k = 0; k <= degree; k += 2)
            weight += coefficient.row(k).transpose() * (2 / (1.0 - k * k));
    }
};

template <int degree>
const ChebyshevGrid<degree>& chebyshev_grid() {
    static const ChebyshevGrid<degree> grid;
    return grid;
}

using PanelPoints = ChebyshevGrid<kPanelDegree>::Points;
using PanelWave = Eigen::Matrix<Complex, kPanelDegree + 1, 1>;

/// Largest of the last two coefficients.
template <class Values>
double tail_of(const Values& values) {
    const auto& rows = chebyshev_grid<kPanelDegree>().coefficient;
    double largest = 0;
    for (int k = kPanelDegree - 1; k <= kPanelDegree; ++k)
        largest = std::max(largest, std::abs((rows.row(k) * values)(0)));
    return largest;
}

/// From the points of a panel to those of a part [from, to] of it, in its x.
template <int degree>
Eigen::Matrix<double, degree + 1, kPanelDegree + 1> interpolation(double from, double to) {
    const PanelPoints& x = chebyshev_grid<kPanelDegree>().x;
    Eigen::Matrix<double, degree + 1, kPanelDegree + 1> rows;
    for (int i = 0; i <= degree; ++i) {
        const double at = (from + to) / 2 + (to - from) / 2 * chebyshev_grid<degree>().x[i];
        rows.row(i).setZero();
        double sum = 0;
        for (int j = 0; j <= kPanelDegree; ++j) {
            if (at == x[j]) {
                rows.row(i).setZero();
                rows(i, j) = sum = 1;
                break;
            }
            const double half = j == 0 || j == kPanelDegree ? 0.5 : 1;
            rows(i, j) = (j % 2 == 0 ? half : -half) / (at - x[j]);
            sum += rows(i, j);
        }
        rows.row(i) /= sum;
    }
    return rows;
}

/// A wave on the points of a panel.
struct PanelHarmonic {
    std::size_t h;
    PanelPoints phase, slope;          ///< and its derivative in x
    std::vector<PanelWave> amplitude;  ///< of each side
};

using SideTriples = std::vector<std::array<Complex, 3>>;

/// Adds the integrals of a wave over a part of a panel, where the sensitivity is smooth.
template <int degree>
void add_part(const Eigen::Matrix<double, degree + 1, kPanelDegree + 1>& rows,
              const Eigen::Matrix<double, degree + 1, 3>& weight, double half_width, double in_x,
              const PanelHarmonic& of, SideTriples& sums) {
    using Points = Eigen::Matrix<double, degree + 1, 1>;
    using Columns = Eigen::Matrix<Complex, degree + 1, 3>;
    const ChebyshevGrid<degree>& grid = chebyshev_grid<degree>();
    const Points phase = rows * of.phase;
    const bool is_still = phase.maxCoeff() - phase.minCoeff() < kStandsStill * degree;
    if (is_still) {
        for (std::size_t side = 0; side < sums.size(); ++side)
            for (int j = 0; j <= degree; ++j) {
                const Complex value = (rows.row(j) * of.amplitude[side])(0) *
                                      std::polar(half_width * grid.weight[j], phase[j]);
                for (std::size_t c = 0; c < 3; ++c)
                    sums[side].at(c) += weight(j, static_cast<int>(c)) * value;
            }
        return;
    }
    // in the part's own x, where it is of length 2
    const Points slope = rows * of.slope * in_x;
    Eigen::Matrix<Complex, degree + 1, degree + 1> system = grid.slope.template cast<Complex>();
    for (int j = 0; j <= degree; ++j) system(j, j) += kI * slope[j];
    const Eigen::PartialPivLU<decltype(system)> factors(system);
    const Complex first = std::polar(half_width, phase[0]),
                  last = std::polar(half_width, phase[degree]);
    for (std::size_t side = 0; side < sums.size(); ++side) {
        const Eigen::Matrix<Complex, degree + 1, 1> amplitude = rows * of.amplitude[side];
        Columns right;
        for (int j = 0; j <= degree; ++j)
            for (int c = 0; c < 3; ++c) right(j, c) = weight(j, c) * amplitude[j];
        const Columns p = factors.solve(right);
        for (int c = 0; c < 3; ++c)
            sums[side].at(static_cast<std::size_t>(c)) += p(degree, c) * last - p(0, c) * first;
    }
}

class FringeSums {
public:
    FringeSums(const Sensitivity& sensitivity, std::size_t elements, std::span<const Side> sides,
               const FringeForms& forms, const FringeLimits& limits)
        : sensitivity_(sensitivity),
          elements_(elements),
          waves_(elements == 1 ? FringeHarmonics::kOfOne : FringeHarmonics::kOfTwo),
          sides_(sides),
          forms_(forms),
          limits_(limits),
          values_(waves_, SideTriples(sides.size())) {}

    std::vector<FringeSum> over(std::span<const double> ends) {
        std::vector<WavelengthRange> open;
        for (std::size_t i = ends.size() - 1; i-- > 0;) open.push_back({ends[i], ends[i + 1]});
        while (!open.empty()) {
            const WavelengthRange panel = open.back();
            open.pop_back();
            if (settle(panel)) continue;
            const double middle = (panel.first_nm + panel.last_nm) / 2;
            open.push_back({middle, panel.last_nm});
            open.push_back({panel.first_nm, middle});
        }
        std::vector<FringeSum> sums(sides_.size());
        for (std::size_t side = 0; side < sums.size(); ++side) {
            double last = 0;
            for (std::size_t h = 0; h < waves_; ++h) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const Complex value = values_[h][side].at(c);
                    sums[side].xyz.at(c) += value.real();
                    if (is_last(h)) last = std::max(last, std::abs(value));
                }
            }
            sums[side].error = kDoubt * (error_ + last);
        }
        return sums;
    }

private:
    /// Adds a panel's waves; false if it has to be halved.
    bool settle(WavelengthRange panel) {
        const ChebyshevGrid<kPanelDegree>& grid = chebyshev_grid<kPanelDegree>();
        const double width = panel.last_nm - panel.first_nm;
        const bool must_end =
            width < kNarrowestPanel * panel.first_nm || evaluations_ > limits_.evaluations;
        const Triple part = sensitivity_.integral(panel);
        const double light = std::ranges::max(part);
        const WavelengthRange support = sensitivity_.support();
        const double allowed = limits_.tolerance / 2 *
                               (light / std::ranges::max(sensitivity_.white()) +
                                width / (support.last_nm - support.first_nm) + kOfPanel);
        if (light < kLeftOut * allowed || must_end) {
            // all that fringes may add
            error_ += light;
            return true;
        }
        std::vector<double> nm(kPanelDegree + 1);
        std::vector<double> highest(nm.size());  ///< of X, Y and Z
        for (int j = 0; j <= kPanelDegree; ++j) {
            const auto at = static_cast<std::size_t>(j);
            nm[at] = std::clamp((panel.first_nm + panel.last_nm) / 2 + width / 2 * grid.x[j],
                                panel.first_nm, panel.last_nm);
            highest[at] = std::ranges::max(sensitivity_.at(nm[at]));
        }
        at_.resize(nm.size());
        forms_(nm, at_);
        evaluations_ += nm.size();
        std::array<PanelPoints, 2> turn;
        std::array<double, 2> turn_tail{}, rounding{};
        for (std::size_t e = 0; e < elements_; ++e) {
            for (int j = 0; j <= kPanelDegree; ++j) {
                const FringeForm& form = at_[static_cast<std::size_t>(j)];
                double phase = form.turn.at(e);
                const double wrapped = form.wrapped.at(e);
                if (j > 0 && wrapped > 0)
                    phase += wrapped * std::round((turn.at(e)[j - 1] - phase) / wrapped);
                turn.at(e)[j] = phase;
            }
            rounding.at(e) = kPhaseRounding * turn.at(e).cwiseAbs().maxCoeff();
            turn_tail.at(e) = tail_of(turn.at(e));
            if (turn_tail.at(e) < rounding.at(e)) turn_tail.at(e) = 0;
        }
        const std::size_t points = nm.size();
        harmonics_.clear();
        for (const FringeForm& form : at_) harmonics_.push_back(fringe_harmonics(form, elements_));
        std::vector<PanelHarmonic> kept;
        double error = 0;
        std::array<double, 2> pure_sizes{};  ///< of waves of one element, the last

        for (std::size_t h = 0; h < waves_; ++h) {
            const auto [m1, m2] = FringeHarmonics::wave(h);
            PanelHarmonic wave{h, m1 * turn[0], {}, {}};
            if (m2 != 0) wave.phase += m2 * turn[1];
            wave.slope = grid.slope * wave.phase;
            double size = 0, tail = 0;
            for (const Side side : sides_) {
                PanelWave& amplitude = wave.amplitude.emplace_back();
                for (std::size_t j = 0; j < points; ++j)
                    amplitude[static_cast<Eigen::Index>(j)] =
                        side == Side::reflected ? harmonics_[j].R.at(h) : harmonics_[j].T.at(h);
                size = std::max(size, amplitude.cwiseAbs().maxCoeff());
                tail = std::max(tail, tail_of(amplitude));
            }
            if (!(size < kInfinity)) return false;
            if (size == 0) continue;
            if (is_last(h) && m2 == 0) pure_sizes[0] = size;
            if (is_last(h) && m1 == 0) pure_sizes[1] = size;
            const double low = wave.slope.minCoeff(), high = wave.slope.maxCoeff();
            const double slowest = low * high > 0 ? std::min(std::abs(low), std::abs(high)) : 0;
            const double fastest = std::max(std::abs(low), std::abs(high));
            const bool steady = slowest * kSteady > fastest;
            const PanelPoints bend = grid.slope * wave.slope;
            const double root =
                bend.minCoeff() * bend.maxCoeff() > 0 ? std::sqrt(bend.cwiseAbs().minCoeff()) : 0;
            double varies = 0;  // what the ends leave, which cancel between panels
            for (std::size_t side = 0; steady && side < sides_.size(); ++side) {
                double sum = 0;
                for (int j = 0; j <= kPanelDegree; ++j) {
                    const auto end = [&](int i) {
                        return wave.amplitude[side][i] * highest[static_cast<std::size_t>(i)] /
                               wave.slope[i];
                    };
                    if (j > 0) sum += std::abs(end(j) - end(j - 1));
                }
                varies = std::max(varies, sum);
            }
            const Triple bounds{size * light, steady ? width * varies : kInfinity,
                                kCorput * size * std::ranges::max(highest) * width / root};
            const double bound = std::ranges::min(bounds);
            if (bound < kLeftOut * allowed) {
                error += bound;
                continue;
            }
            const double turned = std::abs(m1) * turn_tail[0] + m2 * turn_tail[1];
            const double unresolved = std::min(kSumOfTail * (tail + size * turned) * light, bound);
            const double range = wave.phase.maxCoeff() - wave.phase.minCoeff();
            const bool is_still = range < kStandsStill * kPanelDegree;
            if (unresolved > kUnresolved * allowed || (!is_still && !steady)) return false;
            error += unresolved + (std::abs(m1) * rounding[0] + m2 * rounding[1]) * bound;
            kept.push_back(std::move(wave));
        }
        if (elements_ == 2) error += kDoubt * far_beats(turn, pure_sizes) * light;
        add_panel(panel, kept);
        error_ += error;
        return true;
    }

    /// Whether the sum does not go beyond the order of a wave.
    static bool is_last(std::size_t h) {
        const auto [m1, m2] = FringeHarmonics::wave(h);
        return std::max(std::abs(m1), m2) == FringeHarmonics::kMost;
    }

    /// Estimate of the amplitudes of waves of higher order than the sum has, m1 phases of the one
    /// and m2 of the other, that stand still on a panel: phases that are multiples of one another
    /// do not average out.
    ///   turn   phases of the elements
    ///   sizes  of the waves (kMost, 0) and (0, kMost); each phase more takes a constant factor
    static double far_beats(const std::array<PanelPoints, 2>& turn,
                            const std::array<double, 2>& sizes) {
        const auto turned = [](const PanelPoints& phase) { return phase[kPanelDegree] - phase[0]; };
        if (turned(turn[1]) == 0) return 0;
        const double ratio = turned(turn[0]) / turned(turn[1]);
        double sum = 0;
        for (int m1 = 1; m1 <= kFarthestBeat; ++m1) {
            const double m2 = -std::round(m1 * ratio);
            const double order = std::max<double>(m1, std::abs(m2));
            if (order <= FringeHarmonics::kMost || order > kFarthestBeat) continue;
            const PanelPoints beat = m1 * turn[0] + m2 * turn[1];
            if (beat.maxCoeff() - beat.minCoeff() < kStandsStill * kPanelDegree)
                sum += std::pow(sizes[0], m1 / double{FringeHarmonics::kMost}) *
                       std::pow(sizes[1], std::abs(m2) / FringeHarmonics::kMost);
        }
        return sum;
    }

    void add_panel(WavelengthRange panel, const std::vector<PanelHarmonic>& waves) {
        if (waves.empty()) return;
        const std::vector<double> cells = sensitivity_.cells(panel);
        const double width = panel.last_nm - panel.first_nm;
        for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
            const WavelengthRange cell{cells[i], cells[i + 1]};
            if (cell.last_nm - cell.first_nm > width / 2)
                add_cell<kPanelDegree>(panel, cell, waves);
            else
                add_cell<kPieceDegree>(panel, cell, waves);
        }
    }

    template <int degree>
    void add_cell(WavelengthRange panel, WavelengthRange cell,
                  const std::vector<PanelHarmonic>& waves) {
        const double width = panel.last_nm - panel.first_nm,
                     half = (cell.last_nm - cell.first_nm) / 2;
        const auto x = [&](double nm) { return 2 * (nm - panel.first_nm) / width - 1; };
        const auto rows = interpolation<degree>(x(cell.first_nm), x(cell.last_nm));
        Eigen::Matrix<double, degree + 1, 3> weight;
        for (int j = 0; j <= degree; ++j) {
            const double nm = cell.first_nm + half * (1 + chebyshev_grid<degree>().x[j]);
            const Triple s = sensitivity_.at(std::clamp(nm, cell.first_nm, cell.last_nm));
            for (int c = 0; c < 3; ++c) weight(j, c) = s.at(static_cast<std::size_t>(c));
        }
        for (const PanelHarmonic& wave : waves)
            add_part<degree>(rows, weight, half, 2 * half / width, wave, values_[wave.h]);
    }

    const Sensitivity& sensitivity_;
    std::size_t elements_, waves_;
    std::span<const Side> sides_;
    const FringeForms& forms_;
    FringeLimits limits_;
    std::vector<SideTriples> values_;  ///< of each wave
    std::vector<FringeForm> at_;
    std::vector<FringeHarmonics> harmonics_;
    std::size_t evaluations_ = 0;
    double error_ = 0;
};

}  // namespace

std::vector<FringeSum> fringe_sums(const Sensitivity& sensitivity, std::span<const double> ends,
                                   std::size_t elements, std::span<const Side> sides,
                                   const FringeForms& forms, const FringeLimits& limits) {
    return FringeSums(sensitivity, elements, sides, forms, limits).over(ends);
}

}  // namespace irido
