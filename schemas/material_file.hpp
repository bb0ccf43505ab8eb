#pragma once

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

}  // namespace irido
