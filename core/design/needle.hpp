#pragma once

#include <vector>

#include "core/design/global_search.hpp"

namespace irido {

/// One layer of a stack that gains and loses layers.
struct NeedleLayer {
    static constexpr std::size_t kNew = static_cast<std::size_t>(-1);

    std::size_t material = 0;  ///< index into Stack::materials
    double thickness_nm = 0;
    std::size_t origin = kNew;  ///< index of the original element, or kNew
    bool is_fixed = false;
};

struct NeedleSettings {
    SearchSettings search;
    std::vector<std::size_t> materials;  ///< candidates, indices into Stack::materials
    std::size_t max_layers = 20;
    double min_thickness_nm = 2;  ///< of free layers; thinner ones are removed
    double max_thickness_nm = 500;
};

struct NeedleResult {
    std::vector<NeedleLayer> layers;
    double merit = 0;
    std::size_t evaluations = 0;
    std::vector<double> runs;     ///< merits of all runs, best first
    std::size_t runs_within = 0;  ///< number of them within 1 % of the best
    bool is_stopped = false;
};

/// The problem with these layers; free layers vary between the bounds.
///   problem          targets and materials
///   layers           from the incident side
///   low_nm, high_nm  bounds of the thickness of free layers
DesignProblem problem_of_layers(const DesignProblem& problem,
                                const std::vector<NeedleLayer>& layers, double low_nm,
                                double high_nm);

/// Derivative of the objective with respect to the thickness of an inserted layer of 0 nm.
struct NeedleSlope {
    std::size_t layer;     ///< layer to insert it into
    double depth_nm;       ///< inside that layer, from the incident side
    std::size_t material;  ///< of the needle
    double slope;          ///< the needle adds to the host's thickness
};

/// Needle derivatives for every other material at the faces of each free layer and at depths in
/// between, at least eight per cycle of phase at the shortest wavelength. Layers of zero thickness
/// are inserted and the ordinary gradient taken.
///   problem    targets and materials
///   layers     current design
///   materials  candidates, indices into Stack::materials
///   simd       instruction set
/// Source: A. V. Tikhonravov, M. K. Trubetskov, G. W. DeBell, Appl. Opt. 35, 5493 (1996).
std::vector<NeedleSlope> needle_slopes(const DesignProblem& problem,
                                       const std::vector<NeedleLayer>& layers,
                                       const std::vector<std::size_t>& materials, SimdLevel simd);

/// Needle synthesis: refine, insert a layer where it lowers the objective most, refine, and so on.
/// Layers that become thin are removed and equal neighbours merged; when no needle helps, a layer
/// is added at one end. Of several independent runs, the first starts from the given layers, the
/// others from one or two layers of random thickness. The same seed and number of evaluations give
/// the same result.
///   problem   plain layers, with thicknesses of single layers as free values; else DomainError
///   settings  materials, limits and search
NeedleResult needle_search(const DesignProblem& problem, const NeedleSettings& settings);

}  // namespace irido
