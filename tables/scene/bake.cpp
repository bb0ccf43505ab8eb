#include "tables/scene/bake.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>

#include "schemas/input_error.hpp"
#include "schemas/schema_check.hpp"
#include "schemas/text_file.hpp"
#include "tables/atomic_file.hpp"
#include "tables/lut_file.hpp"
#include "tables/lut_metadata.hpp"

namespace irido {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kLock = ".irido-lock";

/// One bake at a time in a folder; released with the process.
class Lock {
public:
    explicit Lock(const std::string& folder)
        : descriptor_(open((folder + "/" + kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
        const int error = errno;
        if (descriptor_ >= 0) close(descriptor_);
        throw OutputError(folder +
                          (error == EWOULDBLOCK
                               ? std::string(": another bake is at work there")
                               : std::string(": cannot be written: ") + std::strerror(error)));
    }
    ~Lock() { close(descriptor_); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int descriptor_;
};

void make_folder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError(folder + ": cannot be made: " + error.message());
}

/// What the metadata of a table and its file come to in the manifest.
json entry_of(const Lut& lut, const json& metadata) {
    json entry = {{"kind", lut.kind}};
    for (const char* key : {"axes", "channels", "dtype", "mips", "error", "notes", "color_space",
                            "request", "checksum"})
        if (metadata.contains(key)) entry[key] = metadata[key];
    return entry;
}

bool is_one_sample(const Lut& lut) {
    return std::ranges::all_of(lut.axes, [](const LutAxis& axis) { return axis.count() == 1; });
}

std::size_t size_of_files(const std::vector<LutFile>& files) {
    std::size_t bytes = 0;
    for (const LutFile& file : files) bytes += file.bytes.size();
    return bytes;
}

/// Makes one table, writes its file if it needs one, and returns its entry.
json made_entry(const SceneTable& table, const LutFormat& format, const BakeRequest& request) {
    LutMaking making = table.making;
    making.threads = request.threads;
    const Lut lut = make_lut(*table.kind, table.kind->plan(table.request), making);
    json entry = entry_of(lut, metadata_of(lut));
    if (is_one_sample(lut)) {
        entry["values"] = lut.values;
        return entry;
    }
    const std::vector<LutFile> files = format.write(lut, {});
    for (const LutFile& file : files)  // companions first
        write_file(request.folder + "/" + table.file + file.suffix, file.bytes);
    entry["file"] = table.file;
    entry["bytes"] = size_of_files(files);
    return entry;
}

/// The entry of a file that an interrupted bake left, or null.
json found_entry(const SceneTable& table, const std::string& folder) {
    const std::string path = folder + "/" + table.file;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return nullptr;
    try {
        const Lut lut = read_lut(path);
        if (!lut_problems(lut).empty()) return nullptr;
        json entry = entry_of(lut, metadata_of(lut));
        entry["file"] = table.file;
        std::size_t bytes = fs::file_size(path);
        if (fs::exists(path + ".json", ignored)) bytes += fs::file_size(path + ".json");
        entry["bytes"] = bytes;
        return entry;
    } catch (const std::runtime_error&) {  // LutError, InputError
        return nullptr;
    }
}

bool is_table_file(const std::string& name) {
    static const std::regex pattern("[a-z]+-[0-9a-f]{16}\\.(ktx2|exr|npy|bin|csv)(\\.json)?");
    return std::regex_match(name, pattern);
}

/// Files of write_file() that a bake has left which was killed; nobody else writes here now.
void remove_unfinished(const std::string& folder) {
    std::vector<fs::path> left;
    for (const auto& file : fs::directory_iterator(folder)) {
        const std::string name = file.path().filename().string();
        const std::size_t part = name.rfind(".part");
        if (part == std::string::npos ||
            name.find_first_not_of("0123456789", part + 5) != std::string::npos)
            continue;
        const std::string target = name.substr(0, part);
        if (target == kManifest || is_table_file(target)) left.push_back(file.path());
    }
    for (const fs::path& file : left) fs::remove(file);
}

std::vector<std::string> pruned_files(const std::string& folder, const TableEntries& entries) {
    std::set<std::string> needed;
    for (const auto& [id, entry] : entries)
        if (entry.contains("file")) {
            needed.insert(entry["file"].get<std::string>());
            needed.insert(entry["file"].get<std::string>() + ".json");
        }
    std::vector<std::string> removed;
    for (const auto& file : fs::directory_iterator(folder)) {
        const std::string name = file.path().filename().string();
        if (is_table_file(name) && !needed.contains(name)) removed.push_back(name);
    }
    std::ranges::sort(removed);
    for (const std::string& name : removed) fs::remove(folder + "/" + name);
    return removed;
}

json material_entry(const ScenePlan& plan, const MaterialPlan& material,
                    const TableEntries& entries) {
    json result = {{"shading", name_of(material.shading)},
                   {"angles_deg", {material.angles_deg.first, material.angles_deg.last}},
                   {"vary", json::object()},
                   {"tables", json::object()},
                   {"constants", material.constants},
                   {"snippets", material.snippets},
                   {"skipped", json::array()}};
    for (const VariedRange& vary : material.vary)
        result["vary"][vary.path] = {vary.range.first, vary.range.last};
    for (const MaterialPlan::Use& use : material.tables)
        result["tables"][use.role] = plan.tables[use.table].id;
    for (const Omission& omission : omissions_of(plan, material, entries))
        result["skipped"].push_back({{"what", omission.what}, {"reason", omission.reason}});
    return result;
}

/// The manifest, if it is one.
json read_manifest(const std::string& folder) {
    try {
        json manifest = json::parse(read_own_file(folder + "/" + kManifest));
        if (manifest_problems(manifest, kManifest).empty()) return manifest;
    } catch (const InputError&) {
    } catch (const json::exception&) {
    }
    return nullptr;
}

}  // namespace

std::vector<Omission> omissions_of(const ScenePlan& plan, const MaterialPlan& material,
                                   const TableEntries& entries) {
    std::vector<Omission> all;
    std::ranges::copy_if(plan.omissions, std::back_inserter(all), [&](const Omission& omission) {
        return omission.material == material.name;
    });
    for (const MaterialPlan::Use& use : material.tables) {
        const auto entry = entries.find(plan.tables[use.table].id);
        if (entry == entries.end()) continue;
        for (const json& note : entry->second["notes"]) {
            const std::string text = note.get<std::string>();
            const std::size_t colon = text.find(": ");
            if (colon != std::string::npos)
                all.push_back({material.name, use.role + " " + text.substr(0, colon),
                               text.substr(colon + 2)});
        }
        if (entry->second.contains("values"))
            all.push_back({material.name, use.role + " table",
                           "nothing matters at this tolerance: numbers in the manifest"});
    }
    return all;
}

const char* manifest_schema_text() {
    return
#include "manifest_schema.inc"
        ;
}

std::vector<std::string> manifest_problems(const json& document, const std::string& file) {
    static const Schema schema(json::parse(manifest_schema_text()));
    std::vector<std::string> lines;
    for (const Problem& problem : check(schema, document))
        lines.emplace_back(InputError(file, problem.pointer, problem.message).what());
    return lines;
}

TableEntries baked_tables(const std::string& folder) {
    TableEntries entries;
    const json manifest = read_manifest(folder);
    if (manifest.is_null() || manifest["numbers"] != kNumbersVersion) return entries;
    for (const auto& [id, entry] : manifest["tables"].items()) entries[id] = entry;
    return entries;
}

bool is_kept(const SceneTable& table, const json& entry, const std::string& folder, bool verify) {
    if (!entry.contains("file")) return entry.contains("values");
    const std::string path = folder + "/" + entry["file"].get<std::string>();
    std::error_code error;
    std::size_t bytes = fs::file_size(path, error);
    if (error) return false;
    auto written = fs::last_write_time(path, error);
    const std::size_t companion = fs::file_size(path + ".json", error);
    if (!error) {
        bytes += companion;
        written = std::max(written, fs::last_write_time(path + ".json", error));
    }
    if (bytes != entry["bytes"].get<std::size_t>()) return false;
    const bool is_older = written <= fs::last_write_time(folder + "/" + kManifest, error) && !error;
    return (is_older && !verify) || found_entry(table, folder) == entry;
}

json planned_entry(const SceneTable& table) {
    const Lut lut = sized_lut(*table.kind, table.kind->plan(table.request), table.making);
    json axes = json::array();
    for (const LutAxis& axis : lut.axes) axes.push_back(axis_metadata(axis));
    json entry = {{"kind", lut.kind},
                  {"axes", axes},
                  {"channels", lut.channels},
                  {"dtype", name_of(lut.type)},
                  {"notes", lut.facts["notes"]}};
    std::size_t samples = 0;
    for (std::size_t level = 0; level < lut.levels(); ++level)
        samples += lut.values_of_level(level) / lut.channels.size();
    if (is_one_sample(lut))
        entry["values"] = json::array();
    else
        entry["file"] = table.file;
    entry["samples"] = samples;
    return entry;
}

json manifest_of(const Scene& scene, const ScenePlan& plan, const TableEntries& entries) {
    json manifest = {{"irido", IRIDO_VERSION},
                     {"numbers", kNumbersVersion},
                     {"scene", scene.name},
                     {"settings",
                      {{"space", scene.space},
                       {"illuminant", scene.illuminant},
                       {"observer_deg", scene.observer_deg},
                       {"adaptation", scene.adaptation},
                       {"tolerance", {{"delta_e", scene.delta_e}, {"relative", scene.relative}}},
                       {"format", scene.format},
                       {"dtype", scene.type},
                       {"white_xyz", plan.white_xyz},
                       {"rgb_from_xyz", plan.rgb_from_xyz}}},
                     {"tables", json::object()},
                     {"materials", json::object()}};
    for (const SceneTable& table : plan.tables) manifest["tables"][table.id] = entries.at(table.id);
    for (const MaterialPlan& material : plan.materials)
        manifest["materials"][material.name] = material_entry(plan, material, entries);
    return manifest;
}

BakeResult bake(const Scene& scene, const ScenePlan& plan, const BakeRequest& request) {
    make_folder(request.folder);
    const Lock lock(request.folder);
    remove_unfinished(request.folder);
    BakeResult result;
    for (const MaterialPlan& material : plan.materials)
        if (!material.fault.empty()) result.faults[material.name] = material.fault;
    const LutFormat& format = format_of(scene);
    const TableEntries before = baked_tables(request.folder);
    TableEntries entries;
    std::size_t done = 0;
    for (const SceneTable& table : plan.tables) {
        const auto old = before.find(table.id);
        json entry;
        if (!request.force)
            entry =
                old != before.end() && is_kept(table, old->second, request.folder, request.verify)
                    ? old->second
                    : found_entry(table, request.folder);
        const bool is_new = entry.is_null();
        try {
            if (is_new) entry = made_entry(table, format, request);
        } catch (const OutputError&) {
            throw;
        } catch (const std::runtime_error& error) {  // LutError, InputError, DomainError
            for (const std::string& name : table.materials) result.faults[name] = error.what();
            continue;
        }
        (is_new ? result.made : result.kept)
            .push_back(entry.contains("file") ? table.file : table.file + " (numbers)");
        entries[table.id] = std::move(entry);
        ++done;
        if (request.progress)
            request.progress(static_cast<double>(done) / static_cast<double>(plan.tables.size()));
    }
    if (!result.faults.empty()) return result;
    const std::string text = manifest_of(scene, plan, entries).dump(2) + "\n";
    const std::string path = request.folder + "/" + kManifest;
    std::error_code ignored;
    // after new files, too: what is not newer than the manifest need not be read next time
    if (!result.made.empty() || !fs::exists(path, ignored) || read_own_file(path) != text) {
        write_file(path, text);
        result.manifest_written = true;
    }
    if (request.prune) result.pruned = pruned_files(request.folder, entries);
    return result;
}

}  // namespace irido
