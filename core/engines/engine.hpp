#pragma once

#include <span>
#include <string_view>

#include "core/engines/engine_film.hpp"

namespace irido {

/// A renderer's formula for the reflectance of a thin film, evaluated in double precision.
struct Engine {
    std::string_view name;
    std::string_view title;
    std::string_view version;  ///< of the source followed
    std::string_view date;     ///< of that version
    std::string_view source;
    std::string_view inputs;  ///< with units
    std::string_view space;   ///< of the result, as declared by the engine
    std::string_view white;
    std::string_view limits;  ///< missing inputs and known errors of the formula
    /// r, g, b of a film; 1 for a perfect mirror. Finite for every film that with_base() returns.
    Triple (*reflectance)(const EngineFilm& film);
};

/// Follows the README of KHR_materials_iridescence to the letter: total reflection gives {1, 1, 1},
/// a film of zero thickness keeps its fringes, and an F0 of 1 yields a negative index, which shifts
/// the phase by pi. Only at F0 = 0.9999, where the text divides by zero, the limit is used.
Triple gltf_reflectance(const EngineFilm& film);
/// The same with the extension's factor in [0, 1]; 0 gives the bare base by Schlick's formula.
Triple gltf_reflectance(const EngineFilm& film, double factor);
Triple three_reflectance(const EngineFilm& film);
Triple babylon_reflectance(const EngineFilm& film);
/// Thickness and film index enter through unity_slider() only.
Triple unity_reflectance(const EngineFilm& film);
Triple materialx_reflectance(const EngineFilm& film);
Triple materialx_gltf_reflectance(const EngineFilm& film);
Triple openpbr_reflectance(const EngineFilm& film);
Triple cycles_reflectance(const EngineFilm& film);
Triple cycles_principled_reflectance(const EngineFilm& film);

/// Unity's slider value for the film's optical thickness: 2 n d / 3 um, at most 1.
double unity_slider(const EngineFilm& film);

/// MaterialX's conversion of XYZ to CIE RGB: white E.
extern const ColorMatrix kMaterialXRgb;

extern const Engine kGltfEngine, kThreeEngine, kBabylonEngine, kUnityEngine, kMaterialXEngine,
    kMaterialXGltfEngine, kOpenPbrEngine, kCyclesEngine, kCyclesPrincipledEngine;

/// All engines.
std::span<const Engine* const> engines();

}  // namespace irido
