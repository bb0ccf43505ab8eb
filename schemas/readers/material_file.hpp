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
    Material material;               ///< named as requested by the caller
    std::vector<std::string> notes;  ///< corrections and conversions applied, one line each
    std::string source;              ///< publication that the file cites, on one line
};

/// Whether a path has an extension of material files, in either case: .csv, .txt, .tsv, .dat, .nk,
/// .mat, .yml or .yaml. The format is recognized by content, whatever the extension.
bool is_material_file(const std::string& path);

/// Reads a material in any format (readers/materials/). Throws InputError with file `name`.
MaterialFile read_material_file(std::string_view text, const std::string& name);

/// Material files, each read once. Thread-safe.
class MaterialFiles {
public:
    /// The content of the file at this path, for which is_material_file must be true. Throws
    /// InputError.
    const MaterialFile& read(const std::string& path);

private:
    std::mutex lock_;
    std::map<std::string, MaterialFile> known_;
};

}  // namespace irido::schemas
