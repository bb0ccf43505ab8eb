#include "schemas/scene_document.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/json_document.hpp"
#include "schemas/schema_check.hpp"
#include "schemas/text_file.hpp"

namespace irido {

namespace {

using nlohmann::json;

constexpr std::array<std::pair<Shading, std::string_view>, 5> kShadings{
    {{Shading::color, "color"},
     {Shading::fourier, "fourier"},
     {Shading::bragg, "bragg"},
     {Shading::rough_layers, "rough-layers"},
     {Shading::albedo, "albedo"}}};

Shading shading_of(std::string_view name) {
    return std::ranges::find(kShadings, name, &std::pair<Shading, std::string_view>::second)->first;
}

ValueRange range_of(const json& value) {
    if (value.is_number()) return {value.get<double>(), value.get<double>()};
    return {value[0].get<double>(), value[1].get<double>()};
}

class Reader {
public:
    Reader(const json& document, std::string file, std::string folder)
        : document_(document), file_(std::move(file)), folder_(std::move(folder)) {}

    Scene read() {
        static const Schema schema(json::parse(scene_schema_text()));
        for (const Problem& problem : check(schema, document_))
            throw InputError(file_, problem.pointer, problem.message);
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
        std::set<std::string> names;
        for (std::size_t i = 0; i < document_["materials"].size(); ++i) {
            const std::string pointer = "/materials/" + std::to_string(i);
            scene_.materials.push_back(material(document_["materials"][i], pointer));
            if (!names.insert(scene_.materials.back().name).second)
                throw InputError(file_, pointer + "/name",
                                 "must be unique (got \"" + scene_.materials.back().name + "\")");
        }
        return std::move(scene_);
    }

private:
    SceneMaterial material(const json& object, const std::string& pointer) {
        SceneMaterial result;
        result.name = object["name"].get<std::string>();
        result.shading = shading_of(object["shading"].get<std::string>());
        result.source = source(object["stack"], pointer + "/stack");
        if (object.contains("vary"))
            for (const auto& [path, value] : object["vary"].items())
                result.vary.push_back(
                    {path, ascending(range_of(value), pointer + "/vary" + pointer_step(path))});
        // the stack at both ends of what varies
        result.document = read(result, &ValueRange::last, object["stack"].is_object(), pointer);
        result.document = read(result, &ValueRange::first, object["stack"].is_object(), pointer);
        for (const std::string& note : result.document.notes) scene_.notes.push_back(note);
        if (object.contains("angles_deg"))
            result.angles_deg = ascending(range_of(object["angles_deg"]), pointer + "/angles_deg");
        result.is_rough = object.contains("roughness");
        if (result.is_rough)
            result.alpha = ascending(range_of(object["roughness"]), pointer + "/roughness");
        result.transmission = object.value("transmission", false);
        result.thickness_spread_nm = object.value("thickness_spread_nm", 0.0);
        return result;
    }

    StackSource source(const json& stack, const std::string& pointer) const {
        if (stack.is_object()) return {stack, file_ + ": " + pointer, folder_};
        const std::string text = stack.get<std::string>();
        if (text.empty() || text == "-")
            throw InputError(file_, pointer,
                             "must be a stack, a file or an expression (got \"" + text + "\")");
        const bool is_expression = text.find('|') != std::string::npos;
        try {
            StackSource loaded = load_stack(
                {is_expression ? text : (std::filesystem::path(folder_) / text).string(), {}});
            if (is_expression) loaded.folder = folder_;  // of the material files that it names
            loaded.file = file_ + ": " + pointer + ": " + loaded.file;
            return loaded;
        } catch (const InputError& error) {
            throw InputError(file_, pointer, error.what());
        }
    }

    /// The stack with one end of what varies. An error inside of an inline stack gets a pointer
    /// into the scene.
    StackDocument read(SceneMaterial& material, double ValueRange::*end, bool is_inline,
                       const std::string& pointer) const {
        for (const VariedRange& vary : material.vary) {
            try {
                set_value(material.source.document, vary.path, vary.range.*end);
            } catch (const InputError& error) {
                throw InputError(
                    file_, pointer + "/vary" + pointer_step(vary.path),
                    "names no number of the stack (" + std::string(error.what()) + ")");
            }
        }
        try {
            return read_stack(material.source.document, material.source.file,
                              material.source.folder);
        } catch (const InputError& error) {
            const bool is_pointer = error.where.empty() || error.where.starts_with('/');
            if (!is_inline || !is_pointer || error.file != material.source.file) throw;
            throw InputError(file_, pointer + "/stack" + error.where, error.message);
        }
    }

    ValueRange ascending(ValueRange range, const std::string& pointer) const {
        if (range.first <= range.last) return range;
        throw InputError(
            file_, pointer,
            "must ascend (got [" + to_text(range.first) + ", " + to_text(range.last) + "])");
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

std::vector<std::string> scene_problems(const json& document, const std::string& file,
                                        const std::string& folder) {
    static const Schema schema(json::parse(scene_schema_text()));
    std::vector<std::string> lines;
    for (const Problem& problem : check(schema, document))
        lines.emplace_back(InputError(file, problem.pointer, problem.message).what());
    if (!lines.empty()) return lines;
    try {
        Reader(document, file, folder).read();
    } catch (const InputError& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

Scene read_scene(const std::string& path) {
    const json document = parse_json(read_text(path), shown_path(path));
    return Reader(document, shown_path(path), std::filesystem::path(path).parent_path().string())
        .read();
}

}  // namespace irido
