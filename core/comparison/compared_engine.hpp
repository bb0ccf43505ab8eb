#pragma once

#include <optional>
#include <string>

#include "core/color/color_request.hpp"
#include "core/engines/engine.hpp"

namespace irido {

/// A candidate for comparison: a renderer's formula, or a method of core/color/baselines.
struct ComparedEngine {
    std::string name;                ///< as typed
    const Engine* engine = nullptr;  ///< or
    ColorMethod method = {};

    /// Whether its result claims to be CIE RGB.
    bool is_cie_rgb() const;
};

/// How an engine's r, g, b become Lab. Each choice ends in CIEDE2000.
struct DifferenceRequest {
    /// own     the engine's result against white D65 of sRGB, the exact colour against that of its
    ///         illuminant;
    /// common  the engine's result adapted to the illuminant by bradford(), both against its white
    enum class White { own, common };
    White white = White::own;
    /// MaterialX's results are CIE RGB with white E, as its source says, instead of linear sRGB,
    /// which is what viewers take them for.
    bool as_cie_rgb = false;
};

/// CIEDE2000 between an engine's result and an exact colour.
class EngineDifference {
public:
    /// `white` is that of the illuminant. Throws DomainError as bradford() does.
    EngineDifference(const DifferenceRequest& request, const Triple& white);

    /// rgb   as the engine returns it; may lie outside [0, 1]
    /// xyz   exact, under the illuminant
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
