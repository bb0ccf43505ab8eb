#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/material/material.hpp"

namespace irido::schemas {

/// A material read from a file.
struct MaterialFile {
    Material material;               ///< named as the reader was told
    std::vector<std::string> notes;  ///< what was done to the data, one line each
    std::string source;              ///< the publication that the file names, on one line
};

/// Whether a path ends as those of material files do: in .csv, .txt, .tsv, .dat, .nk, .mat, .yml or
/// .yaml, in capitals or not. The format is told by the content, whatever the ending.
bool is_material_file(const std::string& path);

/// The material in a text of any format (readers/materials/). Throws InputError with file `name`.
MaterialFile read_material_file(std::string_view text, const std::string& name);

/// Material files, each read once. Safe from many threads.
class MaterialFiles {
public:
    /// What is in the file at this path, for which is_material_file holds. Throws InputError.
    const MaterialFile& read(const std::string& path);

private:
    std::mutex lock_;
    std::map<std::string, MaterialFile> known_;
};

}  // namespace irido::schemas
