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

/// A part of the spectrum over which the integrands are smooth, and a guess at their richness.
struct SpectralPanel {
    WavelengthRange range;
    /// Half the turn in radians of the fastest fringe over the panel: the integrands need about as
    /// many Chebyshev polynomials.
    double half_turn = 0;
};

/// Wavelengths at which spectra are wanted, with what the spectra need there once.
struct SpectralPoints {
    std::vector<double> wavelength_nm;
    std::unique_ptr<const IndexTable> indices;  ///< of stacks
    std::size_t id = 0;                         ///< among all of one PanelTree, counted from 0
};
/// `fit` is what indices are taken to be there, nullptr if they are what they are.
using PointsMaker =
    std::function<SpectralPoints(std::vector<double> wavelength_nm, const IndexFit* fit)>;

/// Panels, their halves and the halves of these, with their rules and points, which are made when
/// first asked for. Safe from many threads.
class PanelTree {
public:
    /// Refers to the tables, and to the indices if there are any: panels with rows inside are cut
    /// there, and have a fit.
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
        /// The index of `degree`, or the first one that sees all of the fit.
        std::size_t seeing(std::size_t degree);
        /// Of fringes in a half, if they turn by half_turn in the whole.
        double half_turn(std::size_t which, double half_turn);
        // of a degree, as an index into kDegrees
        const QuadratureRule& rule(std::size_t degree);
        const SpectralPoints& all_points(std::size_t degree);
        const SpectralPoints& added_points(std::size_t degree);  ///< to those of the one before
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

    /// Panels to begin with.
    struct Start {
        struct Panel {
            Node* node;
            std::size_t degree;  ///< index into kDegrees
            double half_turn;
            std::size_t first;  ///< of its points; neighbours share one
        };
        std::vector<Panel> panels;
        SpectralPoints points;
    };
    /// Begins with adjoining panels, short wavelengths first, that cover the sensitivity's support,
    /// each halved until it has no more fringes than a rule should take.
    ///   tolerance    of X, Y, Z: it decides with which degrees to begin
    ///   most_panels  more panels than that are not made by halving
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

/// Spectra at the same points, in rows that can be read kMostLanes + 1 past their last point.
class Samples {
public:
    /// Makes room, keeping memory from before.
    ///   spectra       such as R and T
    ///   denominators  complex functions without poles, one a polarization, whose zeros are the
    ///                 poles of the spectra; they betray a resonance between two points
    void resize(std::size_t spectra, std::size_t denominators, std::size_t points);
    std::size_t points() const { return points_; }
    std::size_t rows() const { return rows_; }

    /// The spectra, values in [0, 1], then for each denominator its real and imaginary part and the
    /// logarithm of a factor of both.
    double* row(std::size_t row) { return numbers_.data() + row * stride_; }
    const double* row(std::size_t row) const { return numbers_.data() + row * stride_; }

private:
    std::size_t rows_ = 0, points_ = 0, stride_ = 0;
    std::vector<double> numbers_;
};

/// Fills the samples, which have the right size, at the points of all parts, one after the other.
using SampleAt =
    std::function<void(std::span<const SpectralPoints* const> parts, Samples& samples)>;

/// Scratch memory of calls that follow each other; its content means nothing.
struct IntegrationMemory {
    /// A panel at one degree, an index into kDegrees.
    struct Job {
        PanelTree::Node* node = nullptr;
        std::size_t degree = 0;
        double half_turn = 0;
        double share = 0;                              ///< of the tolerance
        std::optional<Samples> coarse = std::nullopt;  ///< at the points of the degree before
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
    double error = 0;  ///< estimate of the largest error of X, Y, Z
    std::size_t evaluations = 0;
};

struct IntegrationLimits {
    double tolerance = 1e-6;             ///< largest error of X, Y, Z; [1e-12, 1]
    std::size_t evaluations = 1U << 20;  ///< a spectrum; past it the best value is returned
    SimdLevel simd = best_simd_level();
    /// Of every material |n| / |kz/k0|^2, the largest over the spectrum; none where no index is
    /// fitted. See index_effect().
    std::span<const double> index_effects{};
};

/// Bound of |dR/dn| and |dT/dn|, n and k of one material, on a panel. A phase k0 n d of light that
/// passes once, or as often as it stays in the stack, is what turns denominators: n dR/dn is no
/// more than 1 from faces, and |dD/d ln lambda| / |D| from what is between them. Not proven for
/// every stack, but held on random ones with a factor of 4 to spare.
///   effect  |n| / |kz/k0|^2: a change of n is one of kz, larger off the normal
///   slope   largest |dD/d ln lambda| / |D| of the denominators
inline double index_effect(double effect, double slope) {
    return effect * (1 + slope);
}

/// Integrals of spectra that are computed together times the sensitivity over adjoining panels that
/// cover its support. Each panel doubles its degree or is halved, whichever promises more, until
/// the estimate is below its share of the tolerance: the last Chebyshev coefficients against the
/// moments, and the whole weight of every point near which a denominator has a zero closer than the
/// next point. A spectrum equal to 1 at every point gives exactly the white. If the evaluations run
/// out, error > tolerance.
///   denominators  of the samples, 0 to 2
///   integrals     one a spectrum
void integrate_color(const Sensitivity& sensitivity, const PanelTree::Start& start,
                     std::size_t denominators, const SampleAt& sample,
                     const IntegrationLimits& limits, IntegrationMemory& memory,
                     std::span<ColorIntegral> integrals);

}  // namespace irido
