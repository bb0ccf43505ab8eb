#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/color/color_tables.hpp"
#include "core/colorimetry/space.hpp"
#include "schemas/documents/stack_document.hpp"

namespace irido::tables {

/// What a page to explore a stack is made of.
struct ViewRequest {
    std::string title;
    std::string light;                       ///< illuminant and observer, in words
    const nlohmann::json* source = nullptr;  ///< the stack as it was written
    const Stack* stack = nullptr;            ///< the same stack
    unsigned threads = 0;
};

/// One HTML page that needs nothing else: the stack on shapes (WebGL 2), with sliders for its
/// thicknesses, repetitions and constant indices. It computes reflectances itself, at wavelengths
/// that are chosen here; the largest error against stack_color(), in CIEDE2000, stands on it, of
/// the stack as given and with the thickest layers that the sliders reach. Throws DomainError for
/// stacks that a page cannot compute: with incoherent layers or distributions of thickness.
std::string view_page(const ColorTables& tables, const RgbTransform& to_srgb,
                      const ViewRequest& request);

}  // namespace irido::tables
