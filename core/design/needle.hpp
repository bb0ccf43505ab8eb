#pragma once

#include <vector>

#include "core/design/global_search.hpp"

namespace irido {

/// One layer of a stack whose layers come and go.
struct NeedleLayer {
    static constexpr std::size_t kNew = static_cast<std::size_t>(-1);

    std::size_t material = 0;  ///< index into Stack::materials
    double thickness_nm = 0;
    std::size_t origin = kNew;  ///< index of the element that it was
    bool is_fixed = false;
};

struct NeedleSettings {
    SearchSettings search;
    std::vector<std::size_t> materials;  ///< to choose from, indices into Stack::materials
    std::size_t max_layers = 20;
    double min_thickness_nm = 2;  ///< of a layer that is not fixed; thinner ones vanish
    double max_thickness_nm = 500;
};

struct NeedleResult {
    std::vector<NeedleLayer> layers;
    double merit = 0;
    std::size_t evaluations = 0;
    std::vector<double> runs;     ///< merits of all runs, best first
    std::size_t runs_within = 0;  ///< of those, within 1 % of the best
    bool is_stopped = false;
};

/// The problem of these layers: those that are not fixed are free between the bounds.
DesignProblem problem_of_layers(const DesignProblem& problem,
                                const std::vector<NeedleLayer>& layers, double low_nm,
                                double high_nm);

/// Change of the objective per nm of a layer of no thickness.
struct NeedleSlope {
    std::size_t layer;     ///< its host
    double depth_nm;       ///< in the host, from the incident side
    std::size_t material;  ///< of the needle
    double slope;          ///< thickness is added
};

/// At the faces of every layer that is not fixed and at depths in between, at least eight a turn of
/// the phase at the shortest wavelength, for every other material: layers of no thickness in the
/// ordinary gradient.
/// Source: A. V. Tikhonravov, M. K. Trubetskov, G. W. DeBell, Appl. Opt. 35, 5493 (1996).
std::vector<NeedleSlope> needle_slopes(const DesignProblem& problem,
                                       const std::vector<NeedleLayer>& layers,
                                       const std::vector<std::size_t>& materials, SimdLevel simd);

/// Synthesis: refine, insert a layer where a needle lowers the objective most, refine, and so on;
/// layers that become thin vanish, equal neighbours merge; where no needle helps, a layer is added
/// at an end. Some runs, the first from the given layers, the others from one or two layers of
/// random thickness, none of which sees another; the same seed and evaluations give the same
/// answer.
///   problem  plain layers, whose free values are thicknesses of single layers
/// Throws DomainError for any other.
NeedleResult needle_search(const DesignProblem& problem, const NeedleSettings& settings);

}  // namespace irido
