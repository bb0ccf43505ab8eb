#include "schemas/documents/surface_document.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/inner_stack.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/documents/scratched_document.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

bool same_medium(const Material& a, const Material& b) {
    return a.model == b.model;
}

/// Builds a layered surface. Collects all problems.
class LayeredReader {
public:
    LayeredReader(const json& document, const std::string& file, const std::string& folder)
        : document_(document), file_(file), folder_(folder) {}

    std::vector<InputError> problems;
    std::vector<std::string> notes;

    LayeredSurface read() {
        const json outside = document_.value("outside", json(1));
        surface_.outside = surface_.inside = medium(outside, "/outside");
        if (document_.contains("inside")) surface_.inside = medium(document_["inside"], "/inside");
        if (problems.empty()) check_coating();
        if (document_.contains("base")) surface_.base_albedo = albedo(document_["base"]["albedo"]);
        if (document_.contains("layers"))
            for (std::size_t i = 0; i < document_["layers"].size(); ++i)
                add_layer(document_["layers"][i], "/layers/" + std::to_string(i));
        if (surface_.layers.empty() && !document_.contains("base"))
            report("/layers", "must have a layer where there is no base");
        if (problems.empty()) check_order();
        return std::move(surface_);
    }

private:
    void report(const std::string& pointer, const std::string& message) {
        problems.emplace_back(file_, pointer, message);
    }

    /// A transparent medium.
    Material medium(const json& value, const std::string& pointer) {
        const json stack{{"incident", value}, {"layers", json::array()}, {"substrate", value}};
        try {
            const StackDocument read = read_stack(stack, file_, folder_);
            notes.insert(notes.end(), read.notes.begin(), read.notes.end());
            return read.stack.materials[read.stack.incident];
        } catch (const InputError& error) {
            constexpr std::string_view kOwn = "/incident";
            const bool is_own = error.where.starts_with(kOwn);
            report(pointer + (is_own ? error.where.substr(kOwn.size()) : ""), error.message);
            return {};
        }
    }

    void check_coating() {
        if (!surface_.is_coated()) return;
        for (const auto& [media, pointer] :
             {std::pair(&surface_.outside, "/outside"), std::pair(&surface_.inside, "/inside")})
            if (!is_constant(*media))
                report(pointer, "must be constant where \"inside\" is not \"outside\" (got " +
                                    media->name + ")");
    }

    Dispersion albedo(const json& value) {
        if (value.is_number()) return Constant{value.get<double>()};
        Table table;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double wavelength = value[i][0].get<double>();
            if (i > 0 && wavelength <= table.wavelength_nm.back())
                report("/base/albedo/" + std::to_string(i) + "/0",
                       "must be above that of the row before, " +
                           to_text(table.wavelength_nm.back()) + " (got " + to_text(wavelength) +
                           ")");
            table.wavelength_nm.push_back(wavelength);
            table.value.push_back(value[i][1].get<double>());
        }
        return table;
    }

    void add_layer(const json& object, const std::string& pointer) {
        RoughLayer layer;
        layer.alpha = object["alpha"].get<double>();
        const std::string place = pointer + "/stack";
        StackSource source;
        try {
            source = inner_stack(object["stack"], place, folder_);
            const StackDocument read = read_source(source);
            notes.insert(notes.end(), read.notes.begin(), read.notes.end());
            layer.stack = read.stack;
        } catch (const InputError& error) {
            const bool is_inline = error.file == place || error.file.empty();
            report(error.file == place ? place + error.where : place,
                   is_inline ? error.message : error.what());
            return;
        }
        const Stack& stack = layer.stack;
        const Material& incident = stack.materials[stack.incident];
        const Material& substrate = stack.materials[stack.substrate];
        if (!same_medium(incident, surface_.inside))
            report(place, "its incident medium must be the one inside the surface, " +
                              surface_.inside.name + " (got " + incident.name + ")");
        layer.is_passable = same_medium(substrate, surface_.inside);
        surface_.layers.push_back(std::move(layer));
    }

    /// Checks that nothing lies below a layer that does not transmit light straight on.
    void check_order() {
        for (std::size_t i = 0; i < surface_.layers.size(); ++i) {
            const RoughLayer& layer = surface_.layers[i];
            if (layer.is_passable) continue;
            const std::string reason = "the substrate of layer " + std::to_string(i) +
                                       " must be the medium inside, " + surface_.inside.name +
                                       " (got " +
                                       layer.stack.materials[layer.stack.substrate].name + ")";
            if (i + 1 < surface_.layers.size())
                report("/layers/" + std::to_string(i + 1), "is not seen: " + reason);
            else if (document_.contains("base"))
                report("/base", "is not seen: " + reason);
        }
    }

    const json& document_;
    const std::string& file_;
    const std::string& folder_;
    LayeredSurface surface_;
};

/// The surface, and the problems of its document.
SurfaceDocument read_checked(const json& document, const std::string& file,
                             const std::string& folder, std::vector<InputError>& problems) {
    static const Schema schema(json::parse(surface_schema_text()));
    for (const Problem& problem : check(schema, document))
        problems.emplace_back(file, problem.pointer, problem.message);
    SurfaceDocument result;
    if (!problems.empty()) return result;
    result.file = file;
    result.name = document.value("name", "");
    if (is_scratched(document)) {
        result.surface = read_scratched(document, file, folder, problems, result.notes);
        return result;
    }
    LayeredReader reader(document, file, folder);
    result.surface = reader.read();
    result.notes = std::move(reader.notes);
    problems = std::move(reader.problems);
    return result;
}

/// A stack document as a surface of one layer.
SurfaceDocument rough_stack(const StackSource& source, std::optional<double> alpha) {
    StackDocument read = read_source(source);
    if (!alpha)
        throw InputError(read.file, "", "a stack requires --alpha, the roughness of its facets");
    SurfaceDocument result;
    const Material medium = read.stack.materials[read.stack.incident];
    const bool is_passable = same_medium(medium, read.stack.materials[read.stack.substrate]);
    result.surface =
        LayeredSurface{medium, medium, {{std::move(read.stack), *alpha, is_passable}}, Constant{0}};
    result.file = std::move(read.file);
    result.name = std::move(read.name);
    result.notes = std::move(read.notes);
    return result;
}

}  // namespace

const char* surface_schema_text() {
    return
#include "surface_schema.inc"
        ;
}

SurfaceDocument read_surface(const json& document, const std::string& file,
                             const std::string& folder) {
    std::vector<InputError> problems;
    SurfaceDocument result = read_checked(document, file, folder, problems);
    if (!problems.empty()) throw InputError(problems.front());
    return result;
}

SurfaceDocument read_surface(const SurfaceRequest& request) {
    const StackSource source = load_stack(request.source);
    if (kind_of(source.document) != DocumentKind::surface) {
        if (!request.takes_stacks)
            throw InputError(source.file, "", "must be a surface with scratches");
        return rough_stack(source, request.alpha);
    }
    if (request.alpha)
        throw InputError(source.file, "",
                         "--alpha applies to stacks only: a surface document states its roughness");
    if (source.reverse) throw InputError(source.file, "", "--reverse applies to stacks only");
    return read_surface(source.document, source.file, source.folder);
}

std::vector<std::string> surface_problems(const json& document, const std::string& file,
                                          const std::string& folder) {
    std::vector<InputError> problems;
    read_checked(document, file, folder, problems);
    std::vector<std::string> lines;
    for (const InputError& problem : problems) lines.emplace_back(problem.what());
    return lines;
}

}  // namespace irido::schemas
