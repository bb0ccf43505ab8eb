#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/color/quadrature/smooth_index.hpp"
#include "core/math/lazy.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

/// A spectral range over which the integrands are smooth, with a guess at how fast they vary.
struct SpectralPanel {
    WavelengthRange range;
    /// Half the phase in radians by which the fastest fringe advances over the panel; the
    /// integrands need about as many Chebyshev polynomials.
    double half_turn = 0;
};

/// Panels between neighbouring wavelengths, nm, for fringes of an optical path, nm.
std::vector<SpectralPanel> panels_of(const std::vector<double>& ends, double path_nm);

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
            std::size_t first;    ///< index of its first point; neighbours share one
            std::size_t sampled;  ///< degree of its points, up to `degree`
        };
        std::vector<Panel> panels;
        SpectralPoints points;
    };
    /// Starts with adjoining panels, short wavelengths first, that cover the support, and bisects
    /// each until its fringes suit a rule.
    ///   panels       to start with
    ///   tolerance    of X, Y, Z; determines the initial degrees
    ///   most_panels  limit on the number of panels made by bisection
    ///   follows      whether points need only resolve denominators, see Transmission
    Start start(const std::vector<SpectralPanel>& panels, double tolerance,
                std::size_t most_panels = kMostPanels, bool follows = false);
    static constexpr std::size_t kMostPanels = 1024;

    std::size_t points_made() const { return points_made_; }  ///< ids given so far

private:
    SpectralPoints make_points(std::vector<double> wavelength_nm, const IndexFit* fit) const;
    /// How far bisection goes, and what the points of the panels resolve.
    struct Begin {
        double largest_half_turn, tolerance;
        bool follows;
    };
    /// Points of neighbouring panels with the same fit.
    struct Part {
        const IndexFit* fit;
        std::vector<double> wavelength_nm;
    };
    void begin_with(Node& node, double half_turn, const Begin& begin, Start& start,
                    std::vector<Part>& parts);
    SpectralPoints joined(std::vector<Part> parts) const;
    bool is_smooth(Node& node, double half_turn, std::size_t degree, double tolerance);

    const ColorTables& tables_;
    PointsMaker make_points_;
    const SmoothIndices* indices_;
    mutable std::atomic<std::size_t> points_made_ = 0;
    std::mutex lock_;
    std::map<std::pair<double, double>, Node> roots_;  ///< by the ends of their ranges
};

}  // namespace irido
