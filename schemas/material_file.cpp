#include "schemas/material_file.hpp"

#include <filesystem>
#include <string_view>

#include "schemas/material_csv.hpp"
#include "schemas/refractiveindex_info.hpp"
#include "schemas/text_file.hpp"

namespace irido {

bool is_material_file(const std::string& path) {
    const std::string kind = std::filesystem::path(path).extension().string();
    return kind == ".csv" || kind == ".yml" || kind == ".yaml";
}

const MaterialFile& MaterialFiles::read(const std::string& path) {
    const std::scoped_lock guard(lock_);
    const auto known = known_.find(path);
    if (known != known_.end()) return known->second;
    const std::string text = read_text(path, TextSource::regular_file);
    return known_
        .emplace(path, path.ends_with(".csv") ? read_material_csv(text, path)
                                              : read_refractiveindex_info(text, path))
        .first->second;
}

}  // namespace irido
