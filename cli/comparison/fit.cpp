#include "cli/comparison/fit.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace irido::cli {

namespace {

struct MaterialFormat {
    std::string_view name;
    std::vector<std::string_view> engines;
};

const std::vector<MaterialFormat>& material_formats() {
    static const std::vector<MaterialFormat> all{
        {"gltf", {"gltf", "three", "babylon"}},
        {"mtlx", {"materialx", "materialx-gltf", "openpbr"}},
        {"py", {"cycles", "cycles-principled"}}};
    return all;
}

/// "r, g, b" of parameters that end in _r, _g, _b.
std::string channels_of(const EngineFit& fit, const std::string& stem) {
    std::string text;
    for (const char* const channel : {"_r", "_g", "_b"})
        text += (text.empty() ? "" : ", ") + to_text(fit.value_of(stem + channel));
    return text;
}

std::string gltf_text(const NamedFit& named, const std::string& name) {
    struct Names {
        std::string_view engine;
        std::string color, ior, thickness;
    };
    const std::array<Names, 3> all{
        Names{"gltf", "baseColorFactor", "iridescenceIor", "iridescenceThicknessMaximum"},
        Names{"three", "color", "iridescenceIOR", "iridescenceThicknessRange_1"},
        Names{"babylon", "albedoColor", "indexOfRefraction", "maximumThickness"}};
    const Names& of = *std::ranges::find(all, named.engine, &Names::engine);
    const EngineFit& fit = named.fit;
    const auto value = [&](const std::string& parameter) { return fit.value_of(parameter); };
    const double thickness_nm = value(of.thickness);
    nlohmann::ordered_json color = nlohmann::ordered_json::array();
    for (const char* const channel : {"_r", "_g", "_b"}) color.push_back(value(of.color + channel));
    color.push_back(1);
    const nlohmann::ordered_json document{
        {"asset", {{"version", "2.0"}, {"generator", "irido compare --fit"}}},
        {"extensionsUsed", {"KHR_materials_iridescence"}},
        {"materials",
         {{{"name", name},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", color}, {"metallicFactor", 1}, {"roughnessFactor", 0}}},
           {"extensions",
            {{"KHR_materials_iridescence",
              {{"iridescenceFactor", named.engine == "gltf" ? value("iridescenceFactor") : 1},
               {"iridescenceIor", value(of.ior)},
               {"iridescenceThicknessMinimum", thickness_nm},
               {"iridescenceThicknessMaximum", thickness_nm}}}}}}}}};
    return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// A name of letters, digits and underscores.
std::string identifier(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const bool is_plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (is_plain) {
            result += c;
        } else if (!result.empty() && result.back() != '_') {
            result += '_';
        }
    }
    while (!result.empty() && result.back() == '_') result.pop_back();
    return result.empty() || (result[0] >= '0' && result[0] <= '9') ? "film_" + result : result;
}

std::string mtlx_input(const std::string& name, const std::string& type, const std::string& value) {
    return "    <input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\" />\n";
}

std::string mtlx_text(const NamedFit& named, const std::string& title) {
    const EngineFit& fit = named.fit;
    const auto number = [&](const char* input, const char* parameter) {
        return mtlx_input(input, "float", to_text(fit.value_of(parameter)));
    };
    const auto color = [&](const char* input, const char* stem) {
        return mtlx_input(input, "color3", channels_of(fit, stem));
    };
    const std::string name = identifier(title);
    std::string text =
        "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\" colorspace=\"lin_rec709\">\n";
    if (named.engine == "materialx") {
        text += "  <conductor_bsdf name=\"" + name + "_bsdf\" type=\"BSDF\">\n" +
                color("ior", "ior") + color("extinction", "extinction") +
                mtlx_input("roughness", "vector2", "0, 0") +
                number("thinfilm_ior", "thinfilm_ior") +
                number("thinfilm_thickness", "thinfilm_thickness") +
                "  </conductor_bsdf>\n  <surface name=\"" + name +
                "\" type=\"surfaceshader\">\n    <input name=\"bsdf\" type=\"BSDF\" nodename=\"" +
                name + "_bsdf\" />\n  </surface>\n";
    } else if (named.engine == "materialx-gltf") {
        text += "  <gltf_pbr name=\"" + name + "\" type=\"surfaceshader\">\n" +
                color("base_color", "base_color") + mtlx_input("metallic", "float", "1") +
                mtlx_input("roughness", "float", "0") + mtlx_input("iridescence", "float", "1") +
                number("iridescence_ior", "iridescence_ior") +
                number("iridescence_thickness", "iridescence_thickness") + "  </gltf_pbr>\n";
    } else {
        const bool is_metal = fit.form == "metal";
        text += "  <open_pbr_surface name=\"" + name + "\" type=\"surfaceshader\">\n" +
                mtlx_input("base_metalness", "float", is_metal ? "1" : "0") +
                (is_metal
                     ? color("base_color", "base_color") + color("specular_color", "specular_color")
                     : mtlx_input("base_weight", "float", "0") +
                           number("specular_ior", "specular_ior")) +
                mtlx_input("specular_roughness", "float", "0") +
                mtlx_input("thin_film_weight", "float", "1") +
                number("thin_film_ior", "thin_film_ior") +
                number("thin_film_thickness", "thin_film_thickness") + "  </open_pbr_surface>\n";
    }
    return text + "  <surfacematerial name=\"M_" + name +
           "\" type=\"material\">\n    <input name=\"surfaceshader\" type=\"surfaceshader\" "
           "nodename=\"" +
           name + "\" />\n  </surfacematerial>\n</materialx>\n";
}

std::string blender_text(const NamedFit& named, const std::string& title) {
    const EngineFit& fit = named.fit;
    std::string text = "import bpy\nmaterial = bpy.data.materials.new(\"" + identifier(title) +
                       "\")\nmaterial.use_nodes = True\nnodes = material.node_tree.nodes\n";
    const auto set = [&](const char* input, const std::string& value) {
        text += std::string("node.inputs[\"") + input + "\"].default_value = " + value + "\n";
    };
    const auto number = [&](const char* input, const char* parameter) {
        set(input, to_text(fit.value_of(parameter)));
    };
    if (named.engine == "cycles") {
        text +=
            "node = nodes.new(\"ShaderNodeBsdfMetallic\")\n"
            "node.fresnel_type = \"PHYSICAL_CONDUCTOR\"\n"
            "material.node_tree.links.new(node.outputs[\"BSDF\"], "
            "nodes[\"Material Output\"].inputs[\"Surface\"])\n";
        set("IOR", "(" + channels_of(fit, "ior") + ")");
        set("Extinction", "(" + channels_of(fit, "extinction") + ")");
    } else {
        const bool is_metal = fit.form == "metal";
        text += "node = nodes[\"Principled BSDF\"]\n";
        set("Metallic", is_metal ? "1" : "0");
        set("Base Color", "(" + (is_metal ? channels_of(fit, "base_color") : "0, 0, 0") + ", 1)");
        if (is_metal) {
            set("Specular Tint", "(" + channels_of(fit, "specular_tint") + ", 1)");
        } else {
            number("IOR", "ior");
        }
    }
    set("Roughness", "0");
    number("Thin Film IOR", "thin_film_ior");
    number("Thin Film Thickness", "thin_film_thickness");
    return text;
}

std::string two_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

}  // namespace

std::vector<double> parse_weights(const std::string& text, std::size_t angles) {
    if (text.empty()) return std::vector<double>(angles, 1);
    const std::vector<double> weights = parse_list("--weights", text, 0, 1e9);
    if (weights.size() != angles)
        throw UsageError("--weights: must have one value per angle, " + std::to_string(angles) +
                         " (got " + std::to_string(weights.size()) + ")");
    if (std::ranges::max(weights) == 0) throw UsageError("--weights: must not all be 0");
    return weights;
}

std::vector<NamedFit> fits_of(const ComparisonQuery& query, const PreparedStack& prepared,
                              const std::vector<double>& weights, unsigned threads,
                              const std::function<void(const std::string&)>& say) {
    for (const ComparedEngine& engine : query.engines())
        if (!has_parameters(engine))
            throw UsageError("--engine: " + engine.name + " has no parameters to fit");
    const StackComparison& comparison = ComparisonQuery::comparison_of(prepared);
    const Stack& stack = prepared.document.stack;
    const std::vector<EngineColor> colors = comparison(stack, query.angles_deg());
    std::vector<Triple> xyz;
    for (std::size_t a = 0; a < query.angles_deg().size(); ++a) {
        require_exact(prepared.document.file, colors[a].exact_error);
        xyz.push_back(colors[a].exact_xyz.value());
    }
    std::vector<NamedFit> fits;
    for (const ComparedEngine& engine : query.engines()) {
        fits.push_back(
            {engine.name, fit_engine(engine, query.difference(), {query.angles_deg(), weights, xyz},
                                     comparison.given().with_thickness_of(stack), threads)});
        const double mean = fits.back().fit.delta_e_mean;
        if (mean >= kNoMatch)
            say(prepared.document.file + ": no match exists: the mean difference of " +
                engine.name + " stays at " + two_digits(mean));
    }
    return fits;
}

tables::Records fit_rows(const std::vector<NamedFit>& fits) {
    tables::Column::Texts engine, parameter;
    tables::Column::Numbers value;
    const auto add = [&](const std::string& name, const std::string& of, double number) {
        engine.push_back(name);
        parameter.push_back(of);
        value.push_back(number);
    };
    for (const NamedFit& named : fits) {
        for (const FittedParameter& fitted : named.fit.parameters)
            add(named.engine, fitted.name, fitted.value);
        add(named.engine, "delta_e_mean", named.fit.delta_e_mean);
        add(named.engine, "delta_e_max", named.fit.delta_e_max);
    }
    return {{{"engine", engine}, {"parameter", parameter}, {"value", value}}};
}

bool is_material_format(const std::string& format) {
    return std::ranges::find(material_formats(), format, &MaterialFormat::name) !=
           material_formats().end();
}

void check_material_format(const std::string& format, const std::string& engine) {
    const auto of = std::ranges::find(material_formats(), format, &MaterialFormat::name);
    if (std::ranges::find(of->engines, engine) == of->engines.end())
        throw UsageError("--format: " + format + " requires --engine " +
                         joined({of->engines.begin(), of->engines.end()}, " or ") + " (got '" +
                         engine + "')");
}

std::string material_text(const std::string& format, const NamedFit& fit, const std::string& name) {
    return format == "gltf"   ? gltf_text(fit, name)
           : format == "mtlx" ? mtlx_text(fit, name)
                              : blender_text(fit, name);
}

}  // namespace irido::cli
