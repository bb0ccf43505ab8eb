#include "schemas/documents/scratched_document.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "schemas/documents/inner_stack.hpp"

namespace irido::schemas {

namespace {

using ScratchJson = nlohmann::json;

Scratch scratch_from(const ScratchJson& object) {
    Scratch scratch;
    scratch.width_um = object["width_um"].get<double>();
    scratch.depth_um = object["depth_um"].get<double>();
    scratch.angle_deg = object["angle_deg"].get<double>();
    scratch.point = {object["point_um"][0].get<double>(), object["point_um"][1].get<double>()};
    if (object.contains("start_um")) scratch.start_um = object["start_um"].get<double>();
    if (object.contains("end_um")) scratch.end_um = object["end_um"].get<double>();
    return scratch;
}

DrawnRange range_from(const ScratchJson& range) {
    if (range.is_number()) return {range.get<double>(), range.get<double>()};
    return {range[0].get<double>(), range[1].get<double>()};
}

ScratchField field_from(const ScratchJson& object) {
    ScratchField field;
    field.count_per_mm2 = object["count_per_mm2"].get<double>();
    field.length_um = range_from(object["length_um"]);
    field.width_um = range_from(object["width_um"]);
    field.depth_um = range_from(object["depth_um"]);
    if (object.contains("angle_deg")) field.angle_deg = range_from(object["angle_deg"]);
    return field;
}

/// The scratch of a field that is most likely outside the model's validity.
Scratch extreme_of(const ScratchField& field, bool is_deep) {
    Scratch scratch;
    scratch.width_um = is_deep ? field.width_um.low : field.width_um.high;
    scratch.depth_um = is_deep ? field.depth_um.high : 0;
    return scratch;
}

}  // namespace

bool is_scratched(const nlohmann::json& document) {
    return document.is_object() && (document.contains("scratches") || document.contains("fields"));
}

ScratchedSurface read_scratched(const nlohmann::json& document, const std::string& file,
                                const std::string& folder, std::vector<InputError>& problems,
                                std::vector<std::string>& notes) {
    ScratchedSurface surface;
    if (document.contains("base")) {
        try {
            const StackDocument base = read_source(inner_stack(document["base"], "/base", folder));
            notes.insert(notes.end(), base.notes.begin(), base.notes.end());
            surface.base = base.stack;
        } catch (const InputError& error) {
            const bool is_inline = error.file == "/base" || error.file.empty();
            problems.emplace_back(file, error.file == "/base" ? "/base" + error.where : "/base",
                                  is_inline ? error.message : error.what());
        }
    }
    if (document.contains("alpha")) surface.alpha = document["alpha"].get<double>();
    surface.optics.coherence_radius_um = document.value("coherence_radius_um", 60.0);
    if (document.value("depth_phase", "slanted") == "vertical")
        surface.optics.depth_phase = DepthPhase::vertical;
    surface.seed = document.value("seed", std::uint64_t{1});
    const auto list = [&](const char* key) { return document.value(key, ScratchJson::array()); };
    const auto doubt = [&](const std::string& pointer, const Scratch& scratch) {
        for (const std::string& text : doubts_about(scratch, surface.optics))
            notes.push_back(pointer + ": " + text);
    };
    const ScratchJson scratches = list("scratches"), fields = list("fields");
    for (std::size_t i = 0; i < scratches.size(); ++i) {
        const std::string pointer = "/scratches/" + std::to_string(i);
        surface.scratches.push_back(scratch_from(scratches[i]));
        try {
            require_valid(surface.scratches.back());
        } catch (const DomainError& error) {
            problems.emplace_back(file, pointer, error.what());
        }
        doubt(pointer, surface.scratches.back());
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const std::string pointer = "/fields/" + std::to_string(i);
        surface.fields.push_back(field_from(fields[i]));
        try {
            require_valid(surface.fields.back());
        } catch (const DomainError& error) {
            problems.emplace_back(file, pointer, error.what());
        }
        for (const bool is_deep : {false, true})
            doubt(pointer, extreme_of(surface.fields.back(), is_deep));
    }
    return surface;
}

}  // namespace irido::schemas
