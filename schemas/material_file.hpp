#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// A material read from a file.
struct MaterialFile {
    Material material;               ///< named as the reader was told
    std::vector<std::string> notes;  ///< what was done to the data, one line each
    std::string source;              ///< the publication that the file names, on one line
};

/// Whether a path ends as those of material files do: in .csv, .yml or .yaml.
bool is_material_file(const std::string& path);

/// Material files, each read once. Safe from many threads.
class MaterialFiles {
public:
    /// What is in the file at this path, for which is_material_file holds. Throws InputError.
    const MaterialFile& read(const std::string& path);

private:
    std::mutex lock_;
    std::map<std::string, MaterialFile> known_;
};

}  // namespace irido
