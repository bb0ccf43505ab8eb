#pragma once

#include <optional>
#include <string>

#include "core/color/color_method.hpp"
#include "core/engines/engine.hpp"

namespace irido {

/// A candidate for comparison: a renderer's formula or a baseline among the colour methods.
struct ComparedEngine {
    std::string name;                ///< as typed
    const Engine* engine = nullptr;  ///< a formula, or null: `method` applies
    ColorMethod method = {};

    /// Whether it is given a film instead of the stack.
    bool takes_film() const { return engine || method.kind->needs_reflected_film; }
    /// Whether its result is declared as CIE RGB.
    bool is_cie_rgb() const;
};

/// How an engine's r, g, b are converted to Lab for CIEDE2000.
struct DifferenceRequest {
    /// White point that Lab refers to.
    ///   own     the engine's result to sRGB's D65, the exact colour to the white of its illuminant
    ///   common  both to that white, to which bradford() adapts the engine's result
    enum class White { own, common };
    White white = White::own;
    /// Reads MaterialX results as CIE RGB with white E, as its source says, instead of linear sRGB,
    /// as viewers interpret them.
    bool as_cie_rgb = false;
};

/// CIEDE2000 between an engine's result and an exact colour.
class EngineDifference {
public:
    /// `white` is that of the illuminant. Throws DomainError as bradford() does.
    EngineDifference(const DifferenceRequest& request, const Triple& white);

    /// CIEDE2000 of one engine's result.
    ///   engine  that produced it
    ///   rgb     as the engine returns it; may lie outside [0, 1]
    ///   xyz     exact colour under the illuminant
    double operator()(const ComparedEngine& engine, const Triple& rgb, const Triple& xyz) const;

    /// Lab of an engine's result and of an exact colour.
    Triple lab_of_engine(const ComparedEngine& engine, const Triple& rgb) const;
    Triple lab_of_exact(const Triple& xyz) const;

private:
    struct Reading {
        ColorMatrix xyz_from_rgb;
        Triple white;
    };
    Triple white_;
    Reading srgb_, cie_rgb_;
};

}  // namespace irido
