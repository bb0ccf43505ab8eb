#include "tables/shaders/scene/bake.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/lut/lut_file.hpp"
#include "tables/lut/lut_metadata.hpp"
#include "tables/shaders/scene/manifest.hpp"
#include "tables/version.hpp"

namespace irido::tables {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kLock = ".irido-lock";
/// Largest angles to try, in degrees, if a table cannot cover all.
constexpr std::array kServedAngles_deg{85.0, 80.0, 70.0, 60.0};

/// Locks a folder for one bake; released when the process ends.
class Lock {
public:
    explicit Lock(const std::string& folder)
        : descriptor_(open((folder + "/" + kLock).c_str(),
                           O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)) {
        if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
        const int error = errno;
        if (descriptor_ >= 0) close(descriptor_);
        throw OutputError(folder + (error == EWOULDBLOCK ? std::string(": locked by another bake")
                                                         : std::string(": cannot be written: ") +
                                                               std::strerror(error)));
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
    if (error) throw OutputError(folder + ": cannot be created: " + error.message());
}

/// Writes a file of the folder, replacing anything in its place, including symbolic links.
void write_own(const std::string& path, const std::string& bytes) {
    std::error_code error;
    if (fs::symlink_status(path, error).type() != fs::file_type::not_found && !is_regular(path) &&
        !fs::remove(path, error))
        throw OutputError(path + ": cannot be replaced: " + error.message());
    write_file(path, bytes);
}

std::size_t size_of_files(const std::vector<LutFile>& files) {
    std::size_t bytes = 0;
    for (const LutFile& file : files) bytes += file.bytes.size();
    return bytes;
}

/// Time of a file's last write or rename, in nanoseconds; the largest number if it is missing.
std::int64_t time_of(const std::string& path) {
    struct stat status {};
    if (lstat(path.c_str(), &status) != 0) return std::numeric_limits<std::int64_t>::max();
    const auto nanoseconds = [](const timespec& time) {
        return time.tv_sec * std::int64_t{1000000000} + time.tv_nsec;
    };
    return std::max(nanoseconds(status.st_mtim), nanoseconds(status.st_ctim));
}

/// Calls make(request). If a table cannot cover the largest angles, the range is shortened if the
/// scene allows it; otherwise the error names angles that would work.
Lut served_lut(const SceneTable& table, const std::function<Lut(const LutRequest&)>& make) {
    const auto made_up_to = [&](double angle_deg) {
        Lut lut = make(request_up_to(table, angle_deg));
        lut.facts["request"]["angles_deg"] = {0, angle_deg};
        return lut;
    };
    std::string reason;
    try {
        return table.served_angle_deg ? made_up_to(*table.served_angle_deg) : make(table.request);
    } catch (const ToleranceError& error) {
        reason = error.what();
    } catch (const DomainError& error) {  // a value is not accurate enough
        reason = error.what();
    }
    for (const double angle_deg : kServedAngles_deg) {
        if (!(angle_deg < table.largest_angle_deg)) continue;
        try {
            Lut lut = made_up_to(angle_deg);
            if (!table.may_end_early)
                throw LutError(reason + "; \"angles_deg\": [0, " + to_text(angle_deg) +
                               "] would do");
            return lut;
        } catch (const ToleranceError&) {
        } catch (const DomainError&) {
        }
    }
    throw ToleranceError(reason);
}

/// A grid's file and the companion that tells where its parts begin.
struct GridFiles {
    std::string bytes, companion;
    json entry;
};

GridFiles grid_files(const SceneTable& table) {
    GridFile file = grid_file(table.grid->scratches, table.grid->extent);
    file.header["id"] = table.id;
    std::string companion = file.header.dump(2) + "\n";
    json entry = grid_entry(file.header, table.file, companion.size() + file.bytes.size());
    return {std::move(file.bytes), std::move(companion), std::move(entry)};
}

/// Writes a grid with its companion, and returns its entry.
json made_grid(const SceneTable& table, const BakePlace& place) {
    GridFiles files = grid_files(table);
    const std::string path = place.folder + "/" + table.file;
    write_own(path + kCompanion, files.companion);
    write_own(path, files.bytes);
    return std::move(files.entry);
}

/// Makes one table, writes its file if it needs one, and returns its entry.
json made_entry(const SceneTable& table, const LutFormat& format, const BakeRequest& request,
                const std::function<void(double, const std::string&)>& progress) {
    if (table.grid) return made_grid(table, request.place);
    LutMaking making = table.making;
    making.threads = request.threads;
    making.progress = progress;
    Lut lut = served_lut(table, [&](const LutRequest& asked) {
        return make_lut(*table.kind, table.kind->plan(asked), making);
    });
    lut.facts["id"] = table.id;
    json entry = entry_of(lut, metadata_of(lut));
    if (is_one_sample(lut)) {
        entry["values"] = lut.values;
        return entry;
    }
    const std::vector<LutFile> files = format.write(lut, {});
    for (const LutFile& file : files)  // companions first
        write_own(request.place.folder + "/" + table.file + file.suffix, file.bytes);
    entry["file"] = table.file;
    entry["bytes"] = size_of_files(files);
    return entry;
}

/// Removes temporary files left by a killed bake; the folder must be locked.
void remove_unfinished(const BakePlace& place) {
    std::vector<fs::path> left;
    for (const auto& file : fs::directory_iterator(place.folder)) {
        const std::string name = file.path().filename().string();
        const std::size_t part = name.rfind(".part");
        if (part == std::string::npos ||
            name.find_first_not_of("0123456789", part + 5) != std::string::npos)
            continue;
        const std::string target = name.substr(0, part);
        if (target == place.manifest || is_table_file(target)) left.push_back(file.path());
    }
    for (const fs::path& file : left) fs::remove(file);
}

/// Files listed by other manifests in the folder.
std::set<std::string> files_of_others(const BakePlace& place) {
    std::set<std::string> files;
    for (const auto& file : fs::directory_iterator(place.folder)) {
        const std::string name = file.path().filename().string();
        if (!name.ends_with(".json") || name == place.manifest || is_table_file(name)) continue;
        if (const json manifest = read_manifest(file.path().string()); !manifest.is_null())
            std::ranges::copy(files_of(manifest), std::inserter(files, files.end()));
    }
    return files;
}

std::vector<std::string> pruned_files(const BakePlace& place,
                                      const std::vector<std::string>& stale) {
    const std::set<std::string> needed = files_of_others(place);
    std::vector<std::string> removed;
    std::error_code ignored;
    for (const std::string& file : stale) {
        if (needed.contains(file)) continue;
        for (const std::string& name : {file, file + kCompanion})
            if (fs::remove(place.folder + "/" + name, ignored)) removed.push_back(name);
    }
    return removed;
}

json settings_of(const schemas::Scene& scene, const ScenePlan& plan) {
    return {{"space", scene.space},
            {"illuminant", scene.illuminant},
            {"observer_deg", scene.observer_deg},
            {"adaptation", scene.adaptation},
            {"tolerance", {{"delta_e", scene.delta_e}, {"relative", scene.relative}}},
            {"format", scene.format},
            {"dtype", scene.type},
            {"white_xyz", plan.white_xyz},
            {"rgb_from_xyz", plan.rgb_from_xyz}};
}

json vary_of(const MaterialPlan& material) {
    json result = json::object();
    for (const schemas::VariedRange& vary : material.vary)
        result[vary.path] = {vary.range.first, vary.range.last};
    return result;
}

/// Why a manifest lacks a table, in words.
std::string why_unknown(const schemas::Scene& scene, const ScenePlan& plan, const SceneTable& table,
                        const json& manifest) {
    if (manifest.is_null()) return "nothing was baked before";
    if (manifest["numbers"] != kNumbersVersion)
        return "made by a version of irido with other numbers";
    std::string changed;
    const auto add = [&](const std::string& what) {
        changed += (changed.empty() ? "" : ", ") + what;
    };
    const json settings = settings_of(scene, plan);
    for (const auto& [key, value] : settings.items())
        if (manifest["settings"].value(key, json()) != value) add(key);
    if (!changed.empty()) return "changed: " + changed;
    const MaterialPlan& material =
        *std::ranges::find(plan.materials, table.materials.front(), &MaterialPlan::name);
    const auto old = manifest["materials"].find(material.name);
    if (old == manifest["materials"].end()) return "a material that is not in the manifest";
    if ((*old)["shading"] != name_of(material.shading)) add("shading");
    if ((*old)["vary"] != vary_of(material)) add("vary");
    if (const json angles = {material.angles_deg.first, material.angles_deg.last};
        !table.may_end_early && (*old)["angles_deg"] != angles)
        add("angles_deg");
    return "changed: " + (changed.empty() ? "the stack or its request" : changed);
}

json material_entry(const ScenePlan& plan, const MaterialPlan& material,
                    const TableEntries& entries) {
    const schemas::ValueRange angles_deg = served_angles(plan, material, entries);
    json result = {{"shading", name_of(material.shading)},
                   {"angles_deg", {angles_deg.first, angles_deg.last}},
                   {"vary", vary_of(material)},
                   {"tables", json::object()},
                   {"constants", material.constants},
                   {"snippets", material.snippets},
                   {"skipped", json::array()},
                   {"losses", json::array()}};
    for (const MaterialPlan::Use& use : material.tables)
        result["tables"][use.role] = plan.tables[use.table].id;
    for (const Omission& omission : omissions_of(plan, material, entries)) {
        json line = {{"what", omission.what}, {"reason", omission.reason}};
        if (omission.delta_e) line["delta_e"] = *omission.delta_e;
        result[omission.kind == Omission::Kind::loss ? "losses" : "skipped"].push_back(line);
    }
    return result;
}

/// Adds a loss if the error of a mip level exceeds the tolerance.
void add_levels(std::vector<Omission>& all, const MaterialPlan& material, const std::string& role,
                const json& entry, double tolerance) {
    if (!entry["error"].is_object() || !entry["error"].contains("levels")) return;
    const auto levels = entry["error"]["levels"].get<std::vector<double>>();
    const auto worst = std::ranges::max_element(levels);
    if (!(*worst > tolerance)) return;
    const bool is_color = entry["error"]["measure"] == "delta_e_2000";
    Omission loss{material.name, role + " mip levels",
                  "exceed the tolerance, level " + std::to_string(worst - levels.begin()) + " most",
                  Omission::Kind::loss};
    if (is_color)
        loss.delta_e = *worst;
    else
        loss.reason +=
            " (" + to_text(*worst) + ", " + entry["error"]["measure"].get<std::string>() + ")";
    all.push_back(std::move(loss));
}

}  // namespace

std::vector<Omission> omissions_of(const ScenePlan& plan, const MaterialPlan& material,
                                   const TableEntries& entries) {
    std::vector<Omission> all;
    std::ranges::copy_if(plan.omissions, std::back_inserter(all), [&](const Omission& omission) {
        return omission.material == material.name;
    });
    for (const MaterialPlan::Use& use : material.tables) {
        const SceneTable& table = plan.tables[use.table];
        const auto entry = entries.find(table.id);
        if (entry == entries.end()) continue;
        add_levels(all, material, use.role, entry->second, *table.making.sizing.tolerance);
        for (const json& note : entry->second["notes"]) {
            const std::string text = note.get<std::string>();
            const std::size_t colon = text.find(": ");
            if (colon != std::string::npos)
                all.push_back({material.name, use.role + " " + text.substr(0, colon),
                               text.substr(colon + 2)});
        }
        if (entry->second.contains("values"))
            all.push_back({material.name, use.role + " table",
                           "constant within the tolerance: stored in the manifest"});
    }
    if (const double last = served_angles(plan, material, entries).last;
        last < material.angles_deg.last)
        all.push_back({material.name, "angles",
                       "above " + to_text(last) +
                           " degrees: no table of a reasonable size meets the tolerance there",
                       Omission::Kind::loss});
    return all;
}

schemas::ValueRange served_angles(const ScenePlan& plan, const MaterialPlan& material,
                                  const TableEntries& entries) {
    schemas::ValueRange angles = material.angles_deg;
    for (const MaterialPlan::Use& use : material.tables) {
        const auto entry = entries.find(plan.tables[use.table].id);
        if (entry == entries.end()) continue;
        if (const json served = served_angles_of(entry->second); !served.is_null())
            angles.last = std::min(angles.last, served[1].get<double>());
    }
    return angles;
}

MaterialFaults faults_of(const ScenePlan& plan) {
    MaterialFaults faults;
    for (const MaterialPlan& material : plan.materials)
        if (!material.faults.empty()) faults[material.name] = material.faults;
    return faults;
}

void add_faults(MaterialFaults& faults, const schemas::Scene& scene, const SceneTable& table,
                const std::exception& error) {
    for (const schemas::SceneMaterial& material : scene.materials) {
        if (std::ranges::find(table.materials, material.name) == table.materials.end()) continue;
        std::vector<schemas::SceneFault>& all = faults[material.name];
        const schemas::SceneFault fault = schemas::fault_of(material, error);
        if (std::ranges::find(all, fault) == all.end()) all.push_back(fault);
    }
}

Baked baked_scene(const BakePlace& place, const schemas::Scene& scene) {
    Baked baked;
    const std::string path = place.folder + "/" + place.manifest;
    baked.manifest = read_manifest(path);
    if (baked.manifest.is_null()) return baked;
    const json& manifest = baked.manifest;
    const std::string source = source_of(scene);
    if (manifest["scene"] != scene.name || manifest.value("source", source) != source)
        throw OutputError(path + ": belongs to another scene, " + manifest.value("source", "") +
                          " " + manifest["scene"].dump() +
                          ": bake into another folder or with --manifest NAME, or remove it");
    if (manifest.value("checksum", "") != checksum_of(manifest)) {
        baked.note = path + ": was modified: all tables are read again";
        return baked;
    }
    baked.files = files_of(manifest);
    if (manifest["numbers"] == kNumbersVersion)
        for (const auto& [id, entry] : manifest["tables"].items()) baked.tables[id] = entry;
    return baked;
}

std::vector<std::string> stale_files(const BakePlace& place, const Baked& baked,
                                     const TableEntries& entries) {
    std::set<std::string> stale;
    for (const std::string& file : baked.files)
        if (is_table_file(file) && is_regular(place.folder + "/" + file)) stale.insert(file);
    for (const auto& [id, entry] : entries)
        if (entry.contains("file")) stale.erase(entry["file"].get<std::string>());
    return {stale.begin(), stale.end()};
}

Keeping keeping_of(const schemas::Scene& scene, const ScenePlan& plan, const SceneTable& table,
                   const Baked& baked, const BakePlace& place, bool verify) {
    const auto old = baked.tables.find(table.id);
    const bool is_known = old != baked.tables.end();
    if (is_known && !old->second.contains("file")) return {old->second, ""};
    const std::string path = place.folder + "/" + table.file;
    if (is_known && !verify && size_of_table(path) == old->second["bytes"]) {
        const std::int64_t manifest = time_of(place.folder + "/" + place.manifest);
        const bool has_companion = is_regular(path + kCompanion);
        if (time_of(path) <= manifest && (!has_companion || time_of(path + kCompanion) <= manifest))
            return {old->second, ""};
    }
    std::error_code ignored;
    if (!is_known && !fs::exists(fs::symlink_status(path, ignored)))
        return {nullptr, why_unknown(scene, plan, table, baked.manifest)};
    try {
        json entry = found_entry(place.folder, table.file, table.id);
        if (is_known && entry != old->second) return {nullptr, "its file has changed"};
        return {std::move(entry), ""};
    } catch (const std::exception& error) {  // LutError, InputError
        const std::string text = error.what(), start = path + ": ";
        return {nullptr, text.starts_with(start) ? text.substr(start.size()) : text};
    }
}

json planned_entry(const SceneTable& table) {
    if (table.grid) {
        json entry = grid_files(table).entry;
        entry["samples"] = table.grid->scratches.size();
        entry["seconds"] = 0;
        return entry;
    }
    const auto start = std::chrono::steady_clock::now();
    LutPlan plan;
    const Lut lut = served_lut(table, [&](const LutRequest& request) {
        plan = table.kind->plan(request);
        return sized_lut(*table.kind, plan, table.making);
    });
    const std::chrono::duration<double> sizing = std::chrono::steady_clock::now() - start;
    json axes = json::array();
    for (const LutAxis& axis : lut.axes) axes.push_back(axis_metadata(axis));
    json entry = {{"kind", lut.kind},
                  {"axes", axes},
                  {"channels", lut.channels},
                  {"dtype", name_of(lut.type)},
                  {"request", lut.facts.value("request", json::object())},
                  {"error", nullptr},
                  {"notes", lut.facts["notes"]}};
    if (const auto levels = estimated_level_errors(plan, lut, table.making.threads);
        !levels.empty()) {
        entry["mips"] = true;
        entry["error"] = {{"measure", plan.measure.name}, {"levels", levels}};
    }
    std::size_t samples = 0;
    for (std::size_t level = 0; level < lut.levels(); ++level)
        samples += lut.values_of_level(level) / lut.channels.size();
    if (is_one_sample(lut))
        entry["values"] = json::array();
    else
        entry["file"] = table.file;
    entry["samples"] = samples;
    entry["seconds"] = sizing.count() + estimated_seconds(plan, lut, table.making);
    return entry;
}

json manifest_of(const schemas::Scene& scene, const ScenePlan& plan, const TableEntries& entries,
                 const MaterialFaults& faults) {
    json manifest = {{"irido", this_build().version},
                     {"numbers", kNumbersVersion},
                     {"scene", scene.name},
                     {"source", source_of(scene)},
                     {"settings", settings_of(scene, plan)},
                     {"tables", json::object()},
                     {"materials", json::object()},
                     {"failed", json::object()}};
    for (const auto& [id, entry] : entries) manifest["tables"][id] = entry;
    for (const MaterialPlan& material : plan.materials)
        if (!faults.contains(material.name))
            manifest["materials"][material.name] = material_entry(plan, material, entries);
    for (const auto& [name, all] : faults)
        for (const schemas::SceneFault& fault : all)
            manifest["failed"][name].push_back(
                {{"pointer", fault.pointer}, {"reason", fault.reason}});
    return manifest;
}

BakeResult bake(const schemas::Scene& scene, const ScenePlan& plan, const BakeRequest& request) {
    const BakePlace& place = request.place;
    make_folder(place.folder);
    const Lock lock(place.folder);
    remove_unfinished(place);
    BakeResult result;
    result.faults = faults_of(plan);
    const LutFormat& format = format_of(scene);
    const Baked before = baked_scene(place, scene);
    if (!before.note.empty()) result.notes.push_back(before.note);
    TableEntries entries;
    for (std::size_t t = 0; t < plan.tables.size(); ++t) {
        const SceneTable& table = plan.tables[t];
        const auto progress = [&](double part, const std::string& what) {
            if (request.progress)
                request.progress(
                    (static_cast<double>(t) + part) / static_cast<double>(plan.tables.size()),
                    table.materials.front() + ": " + std::string(table.kind_name()) +
                        (what.empty() ? "" : ", ") + what);
        };
        progress(0, "");
        try {
            Keeping keeping;
            if (!request.force)
                keeping = keeping_of(scene, plan, table, before, place, request.verify);
            const bool is_new = keeping.entry.is_null();
            if (is_new) keeping.entry = made_entry(table, format, request, progress);
            (is_new ? result.made : result.kept)
                .push_back(keeping.entry.contains("file") ? table.file : table.file + " (numbers)");
            entries[table.id] = std::move(keeping.entry);
        } catch (const OutputError&) {
            throw;
        } catch (const std::exception& error) {  // of any type: affects only these materials
            add_faults(result.faults, scene, table, error);
        }
    }
    std::vector<std::string> stale = stale_files(place, before, entries);
    if (request.prune && result.faults.empty())
        result.pruned = pruned_files(place, std::exchange(stale, {}));
    json manifest = manifest_of(scene, plan, entries, result.faults);
    // the commit that made the last table; a bake that makes none preserves it
    const std::string commit = result.made.empty() && before.manifest.is_object()
                                   ? before.manifest.value("commit", "")
                                   : this_build().commit;
    if (!commit.empty()) manifest["commit"] = commit;
    manifest["stale"] = stale;
    manifest["checksum"] = checksum_of(manifest);
    // reasons of faults may contain folder names
    const std::string text = manifest.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    const std::string path = place.folder + "/" + place.manifest;
    // rewritten after new files, too: files not newer than the manifest need not be read next time
    if (!result.made.empty() || !is_regular(path) || schemas::read_own_file(path) != text) {
        write_own(path, text);
        result.manifest_written = true;
    }
    return result;
}

}  // namespace irido::tables
