#include "schemas/readers/material_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "schemas/readers/materials/column_file.hpp"
#include "schemas/readers/materials/material_format.hpp"
#include "schemas/readers/materials/refractiveindex_info.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::schemas {

namespace {

constexpr std::array<std::string_view, 8> kEndings{".csv", ".txt", ".tsv", ".dat",
                                                   ".nk",  ".mat", ".yml", ".yaml"};

std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

}  // namespace

bool is_material_file(const std::string& path) {
    return std::ranges::find(kEndings, ending_of(path)) != kEndings.end();
}

MaterialFile read_material_file(std::string_view text, const std::string& name) {
    for (const MaterialFormat& format : material_formats())
        if (format.is(text)) return format.read(text, name);
    const std::string ending = ending_of(name);
    if (ending == ".yml" || ending == ".yaml") return read_refractiveindex_info(text, name);
    return read_column_file(text, name);
}

const MaterialFile& MaterialFiles::read(const std::string& path) {
    const std::scoped_lock guard(lock_);
    const auto known = known_.find(path);
    if (known != known_.end()) return known->second;
    const std::string text = read_text(path, TextSource::regular_file);
    return known_.emplace(path, read_material_file(text, path)).first->second;
}

}  // namespace irido::schemas
