#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/color/color_tables.hpp"
#include "core/colorimetry/space.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::tables {

/// The contents of a page to explore a stack.
struct ViewRequest {
    std::string title;
    std::string light;                       ///< illuminant and observer, in words
    const nlohmann::json* source = nullptr;  ///< the stack document as given
    const Stack* stack = nullptr;            ///< the same stack
    unsigned threads = 0;
};

/// A self-contained HTML page: the stack on shapes (WebGL 2), with sliders for its thicknesses,
/// repetitions and constant indices. The page computes reflectances itself, at wavelengths chosen
/// here, and states its largest error against stack_color(), in CIEDE2000, for the stack as given
/// and for the thickest layers that the sliders allow. Throws DomainError for stacks that a page
/// cannot compute: those with incoherent layers or thickness distributions.
std::string view_page(const ColorTables& tables, const RgbTransform& to_srgb,
                      const ViewRequest& request);

}  // namespace irido::tables
