#include "schemas/documents/scene_document.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/inner_stack.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/documents/surface_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

constexpr std::array<std::pair<Shading, std::string_view>, 7> kShadings{
    {{Shading::color, "color"},
     {Shading::fourier, "fourier"},
     {Shading::bragg, "bragg"},
     {Shading::rough_layers, "rough-layers"},
     {Shading::albedo, "albedo"},
     {Shading::facets, "facets"},
     {Shading::scratches, "scratches"}}};

Shading shading_of(std::string_view name) {
    return std::ranges::find(kShadings, name, &std::pair<Shading, std::string_view>::second)->first;
}

ValueRange range_of(const json& value) {
    if (value.is_number()) return {value.get<double>(), value.get<double>()};
    return {value[0].get<double>(), value[1].get<double>()};
}

std::string out_of_order(const ValueRange& range) {
    return "must ascend (got [" + to_text(range.first) + ", " + to_text(range.last) + "])";
}

/// Schema violations or, if there are none, duplicate names and ranges of lights that descend.
std::vector<Problem> broken_rules(const json& document) {
    static const Schema schema(json::parse(scene_schema_text()));
    std::vector<Problem> problems = check(schema, document);
    if (!problems.empty()) return problems;
    for (std::size_t i = 0; document.contains("lights") && i < document["lights"].size(); ++i) {
        const ValueRange range = range_of(document["lights"][i]["diameter_deg"]);
        if (range.first > range.last)
            problems.push_back(
                {"/lights/" + std::to_string(i) + "/diameter_deg", out_of_order(range)});
    }
    std::set<std::string> names;
    for (std::size_t i = 0; i < document["materials"].size(); ++i) {
        const std::string name = document["materials"][i]["name"].get<std::string>();
        if (!names.insert(name).second)
            problems.push_back({"/materials/" + std::to_string(i) + "/name",
                                "must be unique (got \"" + name + "\")"});
    }
    return problems;
}

class SceneReader {
public:
    SceneReader(const json& document, std::string file, std::string folder)
        : document_(document), file_(std::move(file)), folder_(std::move(folder)) {}

    Scene read() {
        for (const Problem& problem : broken_rules(document_)) {
            if (const std::string other = other_kind(document_, DocumentKind::scene);
                !other.empty())
                throw InputError(file_, "", other);
            throw InputError(file_, problem.pointer, problem.message);
        }
        read_settings();
        for (std::size_t i = 0; i < document_["materials"].size(); ++i)
            scene_.materials.push_back(
                material(document_["materials"][i], "/materials/" + std::to_string(i)));
        return std::move(scene_);
    }

    /// The materials that break no rule, in the default light. The faults in the stacks and
    /// surfaces of the others are added to `lines`.
    Scene read_rest(const std::vector<Problem>& problems, std::vector<std::string>& lines) {
        scene_.file = file_;
        const auto materials = document_.find("materials");
        if (materials == document_.end() || !materials->is_array()) return std::move(scene_);
        for (std::size_t i = 0; i < materials->size(); ++i) {
            const json& object = (*materials)[i];
            const std::string pointer = "/materials/" + std::to_string(i);
            const bool is_broken = std::ranges::any_of(problems, [&](const Problem& problem) {
                return (problem.pointer + "/").starts_with(pointer + "/");
            });
            if (!is_broken) {
                scene_.materials.push_back(material(object, pointer));
            } else if (object.is_object()) {
                const SceneMaterial broken = inside_of(object, pointer);
                for (const SceneFault& fault : broken.faults)
                    lines.push_back(fault_text(scene_, broken.name, fault));
            }
        }
        return std::move(scene_);
    }

private:
    void read_settings() {
        scene_.file = file_;
        scene_.name = document_.value("name", "");
        scene_.space = document_.value("space", scene_.space);
        scene_.illuminant = document_.value("illuminant", scene_.illuminant);
        scene_.adaptation = document_.value("adaptation", scene_.adaptation);
        scene_.observer_deg = static_cast<int>(document_.value("observer", 2.0));
        scene_.format = document_.value("format", scene_.format);
        scene_.type = document_.value("dtype", scene_.type);
        if (const auto tolerance = document_.find("tolerance"); tolerance != document_.end()) {
            scene_.delta_e = tolerance->value("delta_e", scene_.delta_e);
            scene_.relative = tolerance->value("relative", scene_.relative);
        }
        if (document_.contains("lights"))
            for (std::size_t i = 0; i < document_["lights"].size(); ++i)
                scene_.lights.push_back({document_["lights"][i].value("name", ""),
                                         range_of(document_["lights"][i]["diameter_deg"])});
    }

    /// The faults in the stack and the surface of a material that breaks rules itself.
    SceneMaterial inside_of(const json& object, const std::string& pointer) const {
        SceneMaterial result;
        result.pointer = pointer;
        const auto name = object.find("name");
        const bool has_name = name != object.end() && name->is_string();
        result.name = has_name ? name->get<std::string>() : "without a name";
        for (const char* const key : {"stack", "surface"}) {
            const auto inner = object.find(key);
            if (inner == object.end() || !(inner->is_string() || inner->is_object())) continue;
            const std::string place = pointer + "/" + key;
            try {
                const StackSource source = inner_stack(*inner, place, folder_);
                for (const std::string& line :
                     key == std::string_view("stack")
                         ? stack_problems(source.document, source.file, source.folder)
                         : surface_problems(source.document, source.file, source.folder))
                    result.faults.push_back(fault_of_line(place, line));
            } catch (const std::exception& error) {
                result.faults.push_back(fault_of(result, error));
            }
        }
        return result;
    }

    SceneMaterial material(const json& object, const std::string& pointer) {
        SceneMaterial result;
        result.name = object["name"].get<std::string>();
        result.pointer = pointer;
        result.shading = object.contains("shading")
                             ? shading_of(object["shading"].get<std::string>())
                             : Shading::scratches;  // or facets, as the surface is
        refuse_foreign(result, object);
        result.has_angles = object.contains("angles_deg");
        if (result.has_angles) result.angles_deg = range(result, object, "angles_deg");
        result.is_rough = object.contains("roughness");
        if (result.is_rough) result.alpha = range(result, object, "roughness");
        result.transmission = object.value("transmission", false);
        result.thickness_spread_nm = object.value("thickness_spread_nm", 0.0);
        if (object.contains("vary"))
            for (const auto& [path, value] : object["vary"].items())
                result.vary.push_back({path, ascending(result, range_of(value),
                                                       pointer + "/vary" + pointer_step(path))});
        if (object.contains("surface")) {
            read_surface_of(result, object);
            return result;
        }
        try {
            result.source = inner_stack(object["stack"], pointer + "/stack", folder_);
            // the stack at both ends of the varied ranges
            if (read_at(result, &ValueRange::last)) read_at(result, &ValueRange::first);
        } catch (const std::exception& error) {
            result.faults.push_back(fault_of(result, error));
        }
        for (const std::string& note : result.document.notes) scene_.notes.push_back(note);
        return result;
    }

    /// Keys of stacks that a surface has, and the other way round.
    static void refuse_foreign(SceneMaterial& material, const json& object) {
        const bool has_surface = object.contains("surface");
        constexpr std::array kOfStacks{"stack", "vary", "roughness", "transmission",
                                       "thickness_spread_nm"};
        constexpr std::array kOfSurfaces{"extent_um", "footprint_um"};
        const auto refuse = [&](const std::string& key, const std::string& reason) {
            if (object.contains(key))
                material.faults.push_back({material.pointer + "/" + key, reason});
        };
        if (has_surface)
            for (const char* const key : kOfStacks)
                refuse(key, "cannot be combined with \"surface\"");
        else
            for (const char* const key : kOfSurfaces)
                refuse(key, "requires a \"surface\" with scratches");
        if (!has_surface && material.shading == Shading::scratches)
            refuse("shading", "scratches requires a \"surface\" with scratches");
    }

    void read_surface_of(SceneMaterial& material, const json& object) {
        const std::string pointer = material.pointer + "/surface";
        try {
            const StackSource source = inner_stack(object["surface"], pointer, folder_);
            if (kind_of(source.document) != DocumentKind::surface)
                throw InputError("", pointer, "must be a surface (a stack goes into \"stack\")");
            for (const std::string& line :
                 surface_problems(source.document, source.file, source.folder))
                material.faults.push_back(fault_of_line(pointer, line));
            if (!material.faults.empty()) return;
            const SurfaceDocument read = read_surface(source.document, source.file, source.folder);
            for (const std::string& note : read.notes)
                scene_.notes.push_back(material.name + ": " + note);
            const bool is_scratched = std::holds_alternative<ScratchedSurface>(read.surface);
            if (object.contains("shading") &&
                material.shading != (is_scratched ? Shading::scratches : Shading::facets))
                throw InputError("", material.pointer + "/shading",
                                 std::string("must be ") + (is_scratched ? "scratches" : "facets") +
                                     " for this surface");
            if (is_scratched)
                set_scratches(material, object, std::get<ScratchedSurface>(read.surface), source);
            else
                set_facets(material, object, std::get<LayeredSurface>(read.surface), source);
        } catch (const std::exception& error) {
            material.faults.push_back(fault_of(material, error));
        }
    }

    static void set_scratches(SceneMaterial& material, const json& object,
                              const ScratchedSurface& surface, const StackSource& source) {
        SceneScratches scratches{surface};
        if (object.contains("extent_um"))
            scratches.extent_um = object["extent_um"].get<std::array<double, 2>>();
        scratches.footprint_um = object.value("footprint_um", scratches.footprint_um);
        material.scratches = std::move(scratches);
        if (!source.document.contains("base")) return;
        material.source =
            inner_stack(source.document["base"], material.pointer + "/surface/base", source.folder);
        material.document = read_source(material.source);
    }

    /// One rough layer over nothing that is seen is a stack with a roughness.
    static void set_facets(SceneMaterial& material, const json& object,
                           const LayeredSurface& surface, const StackSource& source) {
        const std::string pointer = material.pointer + "/surface";
        for (const char* const key : {"extent_um", "footprint_um"})
            if (object.contains(key))
                throw InputError("", material.pointer + "/" + key,
                                 "requires a \"surface\" with scratches");
        if (surface.layers.size() != 1 || surface.is_coated() || source.document.contains("base"))
            throw InputError("", pointer,
                             "must have scratches, or one layer without a base or a coating: irido "
                             "lut layered makes a table of others");
        material.shading = Shading::facets;
        material.is_rough = true;
        material.alpha = {surface.layers[0].alpha, surface.layers[0].alpha};
        material.source = inner_stack(source.document["layers"][0]["stack"],
                                      pointer + "/layers/0/stack", source.folder);
        material.document = read_source(material.source);
    }

    /// Reads the stack with one end of what varies; false if it has faults there.
    bool read_at(SceneMaterial& material, double ValueRange::*end) const {
        StackSource& source = material.source;
        const std::size_t faults = material.faults.size();
        for (const VariedRange& vary : material.vary) {
            try {
                set_value(source.document, vary.path, vary.range.*end);
            } catch (const InputError& error) {
                material.faults.push_back(
                    {material.pointer + "/vary" + pointer_step(vary.path),
                     "must name a number of the stack (" + std::string(error.what()) + ")"});
            }
        }
        if (material.faults.size() > faults) return false;
        try {
            material.document = read_stack(source.document, source.file, source.folder);
        } catch (const InputError&) {
            for (const std::string& line :
                 stack_problems(source.document, source.file, source.folder))
                material.faults.push_back(fault_of_line(material.pointer + "/stack", line));
        }
        return material.faults.size() == faults;
    }

    /// A line of stack_problems() or surface_problems(), "FILE: POINTER: message".
    static SceneFault fault_of_line(const std::string& pointer, const std::string& line) {
        const std::string prefix = pointer + ": ";
        if (!line.starts_with(prefix)) return {pointer, line};
        const std::string rest = line.substr(prefix.size());
        const std::size_t end = rest.starts_with('/') ? rest.find(": ") : std::string::npos;
        if (end == std::string::npos) return {pointer, rest};
        return {pointer + rest.substr(0, end), rest.substr(end + 2)};
    }

    static ValueRange range(SceneMaterial& material, const json& object, const std::string& key) {
        return ascending(material, range_of(object[key]), material.pointer + "/" + key);
    }

    static ValueRange ascending(SceneMaterial& material, ValueRange range,
                                const std::string& pointer) {
        if (range.first > range.last) material.faults.push_back({pointer, out_of_order(range)});
        return range;
    }

    const json& document_;
    std::string file_, folder_;
    Scene scene_;
};

}  // namespace

std::string_view name_of(Shading shading) {
    return std::ranges::find(kShadings, shading, &std::pair<Shading, std::string_view>::first)
        ->second;
}

const char* scene_schema_text() {
    return
#include "scene_schema.inc"
        ;
}

Scene readable_scene(const json& document, const std::string& file, const std::string& folder,
                     std::vector<std::string>& problems) {
    const std::vector<Problem> broken = broken_rules(document);
    SceneReader reader(document, file, folder);
    if (broken.empty()) return reader.read();
    for (const Problem& problem : broken)
        problems.emplace_back(InputError(file, problem.pointer, problem.message).what());
    return reader.read_rest(broken, problems);
}

Scene read_scene(const json& document, const std::string& file, const std::string& folder) {
    return SceneReader(document, file, folder).read();
}

Scene read_scene(const std::string& path) {
    if (path.find('|') != std::string::npos)
        throw InputError("\"" + path + "\"", "", "is a stack; SCENE must be a file");
    return read_scene(parse_json(read_text(path), shown_path(path)), shown_path(path),
                      std::filesystem::path(path).parent_path().string());
}

SceneFault fault_of(const SceneMaterial& material, const std::exception& error) {
    const auto* input = dynamic_cast<const InputError*>(&error);
    if (!input) return {material.pointer, error.what()};
    if (input->file.empty() && input->where.starts_with(material.pointer))
        return {input->where, input->message};
    const std::string stack = material.pointer + (material.scratches ? "/surface/base" : "/stack");
    const bool is_pointer = input->where.empty() || input->where.starts_with('/');
    if (input->file == stack && is_pointer) return {stack + input->where, input->message};
    return {stack, input->what()};
}

std::string fault_text(const Scene& scene, const std::string& material, const SceneFault& fault) {
    return InputError(scene.file, fault.pointer, "material " + material + ": " + fault.reason)
        .what();
}

}  // namespace irido::schemas
