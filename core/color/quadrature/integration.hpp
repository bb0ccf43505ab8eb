#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/color/quadrature/smooth_index.hpp"
#include "core/math/lazy.hpp"
#include "core/math/simd_level.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// A spectral range over which the integrands are smooth, with a guess at how fast they vary.
struct SpectralPanel {
    WavelengthRange range;
    /// Half the phase in radians by which the fastest fringe advances over the panel; the
    /// integrands need about as many Chebyshev polynomials.
    double half_turn = 0;
};

/// Wavelengths at which spectra are computed, with the data prepared for them.
struct SpectralPoints {
    std::vector<double> wavelength_nm;
    std::unique_ptr<const IndexTable> indices;  ///< of stacks
    std::size_t id = 0;                         ///< unique within one PanelTree, counted from 0
};
/// `fit` replaces the tabulated indices; nullptr if none are replaced.
using PointsMaker =
    std::function<SpectralPoints(std::vector<double> wavelength_nm, const IndexFit* fit)>;

/// Panels and their recursive halves, with rules and points created on first use. Thread-safe.
class PanelTree {
public:
    /// Refers to `tables` and, if given, to `indices`: panels with table rows inside are then split
    /// there and have a fit.
    PanelTree(const ColorTables& tables, PointsMaker make_points,
              const SmoothIndices* indices = nullptr)
        : tables_(tables), make_points_(std::move(make_points)), indices_(indices) {}

    class Node {
    public:
        Node(const PanelTree& tree, WavelengthRange range)
            : tree_(tree),
              range_(range),
              has_rows_(tree.indices_ != nullptr && tree.indices_->has_rows(range)) {}
        WavelengthRange range() const { return range_; }
        const IndexFit* fit();  ///< nullptr without rows
        /// Index of `degree`, or of the first degree that resolves the fit completely.
        std::size_t seeing(std::size_t degree);
        /// Half phase of fringes in one half, given that of the whole panel.
        double half_turn(std::size_t which, double half_turn);
        // of a degree, as an index into kDegrees
        const QuadratureRule& rule(std::size_t degree);
        const SpectralPoints& all_points(std::size_t degree);
        const SpectralPoints& added_points(std::size_t degree);  ///< those not among the points of
                                                                 ///< the previous degree
        Node& half(std::size_t which);

    private:
        const PanelTree& tree_;
        WavelengthRange range_;
        bool has_rows_;
        std::mutex lock_;
        Lazy<const IndexFit> fit_;
        std::array<Lazy<std::shared_ptr<const QuadratureRule>>, kDegrees.size()> rules_;
        std::array<Lazy<SpectralPoints>, kDegrees.size()> all_, added_;
        std::array<Lazy<Node>, 2> halves_;
    };

    /// Initial panels.
    struct Start {
        struct Panel {
            Node* node;
            std::size_t degree;  ///< index into kDegrees
            double half_turn;
            std::size_t first;  ///< index of its first point; neighbours share one
        };
        std::vector<Panel> panels;
        SpectralPoints points;
    };
    /// Starts with adjoining panels, short wavelengths first, that cover the support, and bisects
    /// each until its fringes suit a rule.
    ///   panels       to start with
    ///   tolerance    of X, Y, Z; determines the initial degrees
    ///   most_panels  limit on the number of panels made by bisection
    Start start(const std::vector<SpectralPanel>& panels, double tolerance,
                std::size_t most_panels = kMostPanels);
    static constexpr std::size_t kMostPanels = 1024;

private:
    SpectralPoints make_points(std::vector<double> wavelength_nm, const IndexFit* fit) const;
    void begin_with(Node& node, double half_turn, double largest_half_turn, double tolerance,
                    Start& start, std::vector<SpectralPoints>& parts);
    bool is_smooth(Node& node, double half_turn, std::size_t degree, double tolerance);

    const ColorTables& tables_;
    PointsMaker make_points_;
    const SmoothIndices* indices_;
    mutable std::atomic<std::size_t> points_made_ = 0;
    std::mutex lock_;
    std::map<std::pair<double, double>, Node> roots_;  ///< by the ends of their ranges
};

/// Spectra at common points, in rows readable kMostLanes + 1 past their last point.
class Samples {
public:
    /// Resizes, keeping allocated memory.
    ///   spectra       such as R and T
    ///   denominators  pole-free complex functions, one per polarization, whose zeros are the poles
    ///                 of the spectra; they reveal a resonance between two points
    ///   points        number of points
    void resize(std::size_t spectra, std::size_t denominators, std::size_t points);
    std::size_t points() const { return points_; }
    std::size_t rows() const { return rows_; }

    /// Row of a spectrum, with values in [0, 1]; after the spectra, each denominator has three
    /// rows: real part, imaginary part and logarithm of a common factor.
    double* row(std::size_t row) { return numbers_.data() + row * stride_; }
    const double* row(std::size_t row) const { return numbers_.data() + row * stride_; }

private:
    std::size_t rows_ = 0, points_ = 0, stride_ = 0;
    std::vector<double> numbers_;
};

/// Fills `samples`, already sized, at the points of all parts in sequence.
using SampleAt =
    std::function<void(std::span<const SpectralPoints* const> parts, Samples& samples)>;

/// Scratch buffers, reusable between calls.
struct IntegrationMemory {
    /// A panel at one degree, an index into kDegrees.
    struct Job {
        PanelTree::Node* node = nullptr;
        std::size_t degree = 0;
        double half_turn = 0;
        double share = 0;                              ///< of the tolerance
        std::optional<Samples> coarse = std::nullopt;  ///< at the points of the previous degree
        const QuadratureRule& rule() const { return node->rule(degree); }
    };
    /// A denominator on a panel and its derivative.
    struct Zeros {
        std::array<std::vector<double>, 2> parts, slopes;  ///< real and imaginary
    };
    Zeros zeros;
    std::vector<bool> marked;
    std::vector<Job> now, next;
    std::vector<const SpectralPoints*> parts;
    std::vector<double> reference, sums;
    std::vector<Triple> errors, panel_errors;
    std::vector<Samples> spare;
};

/// X, Y, Z of one spectrum.
struct ColorIntegral {
    Triple xyz{};
    double error = 0;  ///< estimated largest error of X, Y, Z
    std::size_t evaluations = 0;
};

struct IntegrationLimits {
    double tolerance = 1e-6;             ///< largest error of X, Y, Z; [1e-12, 1]
    std::size_t evaluations = 1U << 20;  ///< limit per spectrum; past it the best value is returned
    SimdLevel simd = best_simd_level();
    /// Per material the largest |n| / |kz/k0|^2 over the spectrum; empty if no index is fitted. See
    /// index_effect().
    std::span<const double> index_effects{};
};

/// Bound on |dR/dn| and |dT/dn|, for n and k of one material, on a panel. The phase k0 n d of light
/// crossing once, or as often as it stays in the stack, is what varies a denominator: n dR/dn is at
/// most 1 due to interfaces, and |dD/d ln lambda| / |D| due to what lies between them. Not proven
/// for every stack, but satisfied by random ones with a factor of 4 to spare.
///   effect  |n| / |kz/k0|^2: a change of n is one of kz, larger off the normal
///   slope   largest |dD/d ln lambda| / |D| of the denominators
inline double index_effect(double effect, double slope) {
    return effect * (1 + slope);
}

/// Integrates spectra that are computed together, times the weighted colour-matching functions,
/// over adjoining panels that cover the support. Each panel doubles its degree or is bisected,
/// whichever promises more, until the estimate is below its share of the tolerance. The estimate
/// combines the last Chebyshev coefficients with the moments, and counts the full weight of every
/// point near which a denominator has a zero closer than the next point. A spectrum equal to 1 at
/// every point gives exactly the white. If the evaluations run out, error > tolerance.
///   sensitivity   weighted colour-matching functions
///   start         initial panels
///   denominators  number in the samples, 0 to 2
///   sample        computes spectra and denominators
///   limits        tolerance and effort
///   memory        scratch
///   integrals     results, one per spectrum
void integrate_color(const Sensitivity& sensitivity, const PanelTree::Start& start,
                     std::size_t denominators, const SampleAt& sample,
                     const IntegrationLimits& limits, IntegrationMemory& memory,
                     std::span<ColorIntegral> integrals);

}  // namespace irido
