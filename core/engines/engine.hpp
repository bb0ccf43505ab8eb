#pragma once

#include <span>
#include <string_view>

#include "core/engines/engine_film.hpp"

namespace irido {

/// A renderer's formula for the reflectance of a thin film, evaluated in double precision.
struct Engine {
    std::string_view name;
    std::string_view title;
    std::string_view version;  ///< of the text that was followed
    std::string_view date;     ///< of that version
    std::string_view source;
    std::string_view inputs;  ///< with units
    std::string_view space;   ///< of the result, as the engine claims
    std::string_view white;
    std::string_view limits;  ///< inputs it lacks, known errors of its formula
    /// r, g, b of a film; a perfect mirror is 1. Finite for every film that with_base() returns.
    Triple (*reflectance)(const EngineFilm& film);
};

/// The README of KHR_materials_iridescence to the letter: total reflection is {1, 1, 1}, a film
/// without thickness keeps its fringes, and an F0 of 1 becomes a negative index, which turns the
/// phase by pi. Only F0 = 0.9999, where the text divides by zero, has its limit.
Triple gltf_reflectance(const EngineFilm& film);
/// The same with the extension's factor in [0, 1]: 0 is the bare base by Schlick's formula.
Triple gltf_reflectance(const EngineFilm& film, double factor);
Triple three_reflectance(const EngineFilm& film);
Triple babylon_reflectance(const EngineFilm& film);
/// Thickness and film index enter by unity_slider() only.
Triple unity_reflectance(const EngineFilm& film);
Triple materialx_reflectance(const EngineFilm& film);
Triple materialx_gltf_reflectance(const EngineFilm& film);
Triple openpbr_reflectance(const EngineFilm& film);
Triple cycles_reflectance(const EngineFilm& film);
Triple cycles_principled_reflectance(const EngineFilm& film);

/// The value of Unity's slider with the film's optical thickness: 2 n d / 3 um, at most 1.
double unity_slider(const EngineFilm& film);

/// CIE RGB of XYZ as MaterialX has it: white E.
extern const ColorMatrix kMaterialXRgb;

extern const Engine kGltfEngine, kThreeEngine, kBabylonEngine, kUnityEngine, kMaterialXEngine,
    kMaterialXGltfEngine, kOpenPbrEngine, kCyclesEngine, kCyclesPrincipledEngine;

/// All of them.
std::span<const Engine* const> engines();

}  // namespace irido
