#include "tables/lut/lut_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "schemas/readers/text_file.hpp"
#include "tables/files/atomic_file.hpp"
#include "tables/lut/lut_values.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

namespace {

constexpr const char* kCompanion = ".json";

bool exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

std::string format_names() {
    std::string names;
    for (const LutFormat* format : lut_formats())
        names += (names.empty() ? "." : ", .") + std::string(format->name);
    return names;
}

}  // namespace

const LutFormat& lut_format_of(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    const LutFormat* format =
        extension.empty() ? nullptr : find_lut_format(std::string_view(extension).substr(1));
    if (!format)
        throw LutError(file + ": the extension of a table's file must be one of " + format_names());
    return *format;
}

Lut read_lut(const std::string& file) {
    const LutFormat& format = lut_format_of(file);
    const std::string bytes = schemas::read_own_file(file);
    const std::string companion =
        exists(file + kCompanion) ? schemas::read_own_file(file + kCompanion) : "";
    try {
        return format.read(bytes, companion);
    } catch (const LutError& error) {
        throw LutError(file + ": " + error.what());
    }
}

void write_lut(const Lut& lut, const std::string& file, const LutFormat& format,
               const LutLayout& layout) {
    std::vector<LutFile> files = format.write(lut, layout);
    std::stable_partition(files.begin(), files.end(),
                          [](const LutFile& f) { return !f.suffix.empty(); });
    if (file.starts_with("/dev/"))  // a device has no companion
        std::erase_if(files, [](const LutFile& f) { return !f.suffix.empty(); });
    std::vector<std::string> paths, added;
    for (const LutFile& part : files) paths.push_back(file + part.suffix);
    check_outputs(paths);
    try {
        for (const LutFile& part : files) {
            const std::string path = file + part.suffix;
            const bool is_new = !exists(path);
            write_file(path, part.bytes);
            if (is_new) added.push_back(path);
        }
    } catch (...) {  // no companion without its file
        std::error_code ignored;
        for (const std::string& path : added) std::filesystem::remove(path, ignored);
        throw;
    }
}

std::vector<std::string> lut_problems(const Lut& lut) {
    std::vector<std::string> problems;
    const auto is_bad = [](double value) { return !std::isfinite(value); };
    const auto bad = std::ranges::find_if(lut.values, is_bad);
    if (bad != lut.values.end()) {
        std::string text = std::to_string(std::ranges::count_if(lut.values, is_bad)) +
                           " of the values must be finite, the first is " +
                           place_of(lut, static_cast<std::size_t>(bad - lut.values.begin())) +
                           " (got ";
        append_number(text, *bad);
        problems.push_back(text + ")");
    }
    const auto claimed = lut.facts.find("checksum");
    if (claimed == lut.facts.end()) {
        problems.emplace_back("the checksum is missing");
    } else if (const std::string actual = checksum_of(lut); *claimed != actual) {
        problems.push_back("the checksum does not match the values: " + claimed->dump() + ", not " +
                           actual);
    } else if (const nlohmann::json metadata = metadata_of(lut);
               lut.facts.value("metadata_checksum", "") != metadata["metadata_checksum"]) {
        problems.emplace_back("the metadata was modified: metadata_checksum does not match");
    }
    return problems;
}

}  // namespace irido::tables
