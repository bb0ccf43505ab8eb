#include "tables/shaders/scene/manifest.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"
#include "tables/files/hash.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/lut_metadata.hpp"
#include "tables/scratch/grid_file.hpp"

namespace irido::tables {

using nlohmann::json;
namespace fs = std::filesystem;

bool is_regular(const std::string& path) {
    std::error_code ignored;
    return fs::is_regular_file(fs::symlink_status(path, ignored));
}

std::size_t size_of_table(const std::string& path) {
    std::error_code ignored;
    if (!is_regular(path)) return 0;
    const std::string companion = path + kCompanion;
    if (!fs::exists(fs::symlink_status(companion, ignored))) return fs::file_size(path);
    return is_regular(companion) ? fs::file_size(path) + fs::file_size(companion) : 0;
}

bool is_table_file(const std::string& name) {
    static const std::regex pattern = [] {
        std::string formats;
        for (const LutFormat* const format : lut_formats())
            formats.append(formats.empty() ? "" : "|").append(format->name);
        return std::regex("[a-z]+(-[a-z]+)*-[0-9a-f]{16}\\.(" + formats + ")(\\.json)?");
    }();
    return std::regex_match(name, pattern);
}

bool is_one_sample(const Lut& lut) {
    return std::ranges::all_of(lut.axes, [](const LutAxis& axis) { return axis.count() == 1; });
}

json entry_of(const Lut& lut, const json& metadata) {
    json entry = {{"kind", lut.kind}};
    for (const char* key : {"axes", "channels", "dtype", "mips", "error", "notes", "color_space",
                            "request", "checksum"})
        if (metadata.contains(key)) entry[key] = metadata[key];
    return entry;
}

json grid_entry(const json& header, const std::string& file, std::size_t bytes) {
    const double cell = header["cell_um"];
    const auto axis = [&](const char* name, std::size_t of_origin, const json& count) {
        const double first = header["origin_um"][of_origin].get<double>() + cell / 2;
        return json{{"name", name},   {"unit", "um"},
                    {"first", first}, {"last", first + cell * (count.get<double>() - 1)},
                    {"count", count}, {"mapping", "linear"}};
    };
    return {{"kind", kGridKind},
            {"axes", {axis("y_um", 1, header["rows"]), axis("x_um", 0, header["columns"])}},
            {"channels", header["records"]["channels"]},
            {"dtype", "f32"},
            {"scratches", header["records"]["count"]},
            {"error", nullptr},
            {"notes", json::array()},
            {"checksum", header["checksum"]},
            {"file", file},
            {"bytes", bytes}};
}

namespace {

json found_grid(const std::string& path, const std::string& file, const std::string& id,
                std::size_t bytes) {
    const json header = schemas::parse_json(schemas::read_own_file(path + kCompanion), file);
    const auto problems = grid_problems(schemas::read_own_file(path), header);
    if (!problems.empty()) throw LutError("its file is damaged: " + problems.front());
    if (header.value("id", "") != id) throw LutError("its file holds another grid");
    return grid_entry(header, file, bytes);
}

}  // namespace

json found_entry(const std::string& folder, const std::string& file, const std::string& id) {
    const std::string path = folder + "/" + file;
    const std::size_t bytes = size_of_table(path);
    if (bytes == 0) throw LutError("its file is missing or not a regular file");
    if (file.starts_with(kGridKind + std::string("-"))) return found_grid(path, file, id, bytes);
    const Lut lut = read_lut(path);
    const std::string own_id = lut.facts.value("id", "");
    if (own_id.empty()) throw LutError("its file holds a table without an id (" + lut.kind + ")");
    if (own_id != id)
        throw LutError("its file holds another table (" + lut.kind + " " + own_id + ")");
    if (const auto problems = lut_problems(lut); !problems.empty())
        throw LutError("its file is damaged: " + problems.front());
    json entry = entry_of(lut, metadata_of(lut));
    entry["file"] = file;
    entry["bytes"] = bytes;
    return entry;
}

json served_angles_of(const json& entry) {
    if (!entry.contains("request")) return nullptr;
    return entry["request"].value("angles_deg", json());
}

std::string source_of(const schemas::Scene& scene) {
    return schemas::well_formed(fs::path(scene.file).filename().string());
}

std::string checksum_of(json manifest) {
    manifest.erase("checksum");
    return "sha256:" + sha256_of(manifest.dump(-1, ' ', false, json::error_handler_t::replace));
}

json read_manifest(const std::string& path) {
    if (!is_regular(path)) return nullptr;
    static const schemas::Schema schema(json::parse(manifest_schema_text()));
    try {
        json manifest = json::parse(schemas::read_own_file(path));
        const std::vector<schemas::Problem> problems = schemas::check(schema, manifest);
        const bool is_old = manifest.is_object() && !manifest.contains("checksum");
        if (problems.size() <= (is_old ? 1 : 0)) return manifest;
    } catch (const schemas::InputError&) {
    } catch (const json::exception&) {
    }
    return nullptr;
}

std::vector<std::string> files_of(const json& manifest) {
    std::vector<std::string> files;
    for (const json& table : manifest["tables"])
        if (table.contains("file")) files.push_back(table["file"].get<std::string>());
    for (const json& file : manifest.value("stale", json::array()))
        files.push_back(file.get<std::string>());
    return files;
}

const char* manifest_schema_text() {
    return
#include "manifest_schema.inc"
        ;
}

namespace {

/// The problem of a table's entry and file, in words; "" if there is none.
std::string fault_of_entry(const json& entry, const std::string& id, const std::string& folder) {
    if (!entry.contains("file")) return "";
    try {
        const json found = found_entry(folder, entry["file"].get<std::string>(), id);
        for (const auto& [key, value] : found.items())
            if (entry.value(key, json()) != value)
                return "its file and the manifest differ in \"" + key + "\"";
    } catch (const std::exception& error) {  // LutError, InputError
        return error.what();
    }
    return "";
}

}  // namespace

std::vector<std::string> manifest_problems(const json& document, const std::string& file,
                                           const std::string& folder) {
    static const schemas::Schema schema(json::parse(manifest_schema_text()));
    std::vector<std::string> lines;
    const auto add = [&](const std::string& pointer, const std::string& message) {
        lines.emplace_back(schemas::InputError(file, pointer, message).what());
    };
    for (const schemas::Problem& problem : schemas::check(schema, document))
        add(problem.pointer, problem.message);
    if (!lines.empty()) return lines;
    if (document["checksum"] != checksum_of(document))
        add("/checksum", "does not match the manifest, which was edited (irido bake rewrites it)");
    for (const auto& [name, material] : document["materials"].items())
        for (const auto& [role, id] : material["tables"].items())
            if (!id.is_string() || !document["tables"].contains(id.get<std::string>()))
                add("/materials/" + name + "/tables/" + role,
                    "must be the id of a table (got " + schemas::short_text(id) + ")");
    if (folder.empty()) return lines;
    for (const auto& [id, entry] : document["tables"].items())
        if (const std::string fault = fault_of_entry(entry, id, folder); !fault.empty())
            add("/tables" + schemas::pointer_step(id), fault);
    return lines;
}

}  // namespace irido::tables
