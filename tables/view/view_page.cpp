#include "tables/view/view_page.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/render/color_nodes.hpp"
#include "core/render/noise.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;

/// CIEDE2000 between colours computed with the page's wavelengths and with twice as many.
constexpr double kViewTolerance = 0.05;
/// More nodes would make the page slow.
constexpr std::size_t kMostNodes = 600;

constexpr const char* kPage =
#include "view_page.inc"
    ;

/// Upper end of the slider for a layer's thickness.
double largest_thickness(double thickness_nm) {
    constexpr double kThin_nm = 1000, kRoom_nm = 400;
    const double most =
        thickness_nm > kThin_nm ? 1.2 * thickness_nm : std::max(2 * thickness_nm, kRoom_nm);
    return std::ceil(most / 10) * 10;
}

json elements_of(const std::vector<Element>& elements) {
    json result = json::array();
    for (const Element& element : elements) {
        if (const auto* group = std::get_if<Group>(&element.value)) {
            result.push_back({{"repeat", group->repeat}, {"layers", elements_of(group->elements)}});
            continue;
        }
        const Layer& layer = std::get<Layer>(element.value);
        if (!layer.coherent) throw DomainError("an incoherent layer cannot be shown on a page yet");
        if (layer.thickness_sigma_nm != 0)
            throw DomainError("a distribution of thickness cannot be shown on a page yet");
        result.push_back({{"medium", layer.material},
                          {"thickness_nm", layer.thickness_nm},
                          {"largest_nm", largest_thickness(layer.thickness_nm)}});
    }
    return result;
}

void make_thickest(std::vector<Element>& elements) {
    for (Element& element : elements) {
        if (auto* group = std::get_if<Group>(&element.value)) {
            make_thickest(group->elements);
        } else {
            Layer& layer = std::get<Layer>(element.value);
            layer.thickness_nm = largest_thickness(layer.thickness_nm);
        }
    }
}

std::vector<double> checked_angles_deg() {
    return {0, 15, 30, 45, 60, 70, 80, 85};
}

/// Linear sRGB of a stack at these angles, computed as the page does.
std::vector<Triple> page_colors(const Stack& stack, const ColorNodes& nodes) {
    std::vector<IncidentAngle> incidence;
    for (const double angle_deg : checked_angles_deg())
        incidence.push_back(incident_angle(angle_deg));
    const std::size_t count = nodes.wavelength_nm.size();
    const Spectra found = spectra(StackPower(stack), IndexTable(stack, nodes.wavelength_nm),
                                  incidence, {.T = false, .A = false}, {1});
    std::vector<Triple> colors(incidence.size());
    for (std::size_t i = 0; i < incidence.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < count; ++k)
                colors[i][c] +=
                    nodes.weight[c][k] / 2 * (found.s.R[i * count + k] + found.p.R[i * count + k]);
    return colors;
}

/// Rounded up to two digits.
double rounded_up(double value) {
    if (value < 1e-4) return 1e-4;
    const double unit = std::pow(10, 1 - std::floor(std::log10(value)));
    return std::ceil(value * unit) / unit;
}

/// The largest error of the page's colours.
double measured_error(const ColorTables& tables, const RgbTransform& to_srgb, const Stack& stack,
                      const ColorNodes& nodes, unsigned threads) {
    const std::vector<Triple> colors = page_colors(stack, nodes);
    auto color = colors.begin();
    double most = 0;
    for (const StackColor& exact :
         stack_color(tables, stack, {}, {}, checked_angles_deg(), threads))
        most = std::max(most, srgb_difference(*color++, to_srgb(exact.xyz)));
    return rounded_up(most);
}

json media_of(const Stack& stack, const std::vector<double>& wavelength_nm) {
    const IndexTable indices(stack, wavelength_nm);
    json media = json::array();
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        const bool constant = indices.is_constant(m);
        json medium{{"name", stack.materials[m].name}, {"constant", constant}};
        if (constant) {
            medium["n"] = indices.n(m, 0);
            medium["k"] = indices.k(m, 0);
        } else {
            for (std::size_t w = 0; w < wavelength_nm.size(); ++w) {
                medium["n"].push_back(indices.n(m, w));
                medium["k"].push_back(indices.k(m, w));
            }
        }
        media.push_back(std::move(medium));
    }
    return media;
}

/// JSON that is safe inside HTML.
std::string inert(const json& data) {
    std::string text;
    for (const char c : data.dump(-1, ' ', false, json::error_handler_t::replace)) {
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    }
    return text;
}

}  // namespace

std::string view_page(const ColorTables& tables, const RgbTransform& to_srgb,
                      const ViewRequest& request) {
    const json elements = elements_of(request.stack->elements);
    const Stack stack = held_stack(*request.stack, tables.sensitivity());
    Stack thickest = stack;
    make_thickest(thickest.elements);
    // chosen for the thickest layers if possible, and at least for the given ones
    const auto nodes_for = [&](const std::vector<const Stack*>& stacks) {
        return enough_nodes(
            tables.sensitivity(), to_srgb,
            [&](const ColorNodes& nodes) {
                std::vector<Triple> colors;
                for (const Stack* one : stacks)
                    for (const Triple& color : page_colors(*one, nodes)) colors.push_back(color);
                return colors;
            },
            kViewTolerance, kMostNodes);
    };
    ColorNodes nodes = nodes_for({&stack, &thickest});
    if (!nodes.are_enough) nodes = nodes_for({&stack});
    const auto error = [&](const Stack& of) {
        return measured_error(tables, to_srgb, of, nodes, request.threads);
    };
    const RgbSpace& srgb = rgb_space("srgb");
    const json data{{"title", request.title},
                    {"light", request.light},
                    {"error", {{"given", error(stack)}, {"thickest", error(thickest)}}},
                    {"nodes", {{"wavelength_nm", nodes.wavelength_nm}, {"weight", nodes.weight}}},
                    {"white", srgb.white},
                    {"xyz_from_srgb", xyz_from_rgb(srgb)},
                    {"stack",
                     {{"media", media_of(stack, nodes.wavelength_nm)},
                      {"incident", stack.incident},
                      {"substrate", stack.substrate},
                      {"elements", elements}}},
                    {"permutation", PerlinNoise().permutation()},
                    {"document", *request.source}};
    std::string page = kPage;
    const std::string mark = "IRIDO_DATA";
    page.replace(page.find(mark), mark.size(), inert(data));
    return page;
}

}  // namespace irido::tables
