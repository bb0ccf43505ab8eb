#include "schemas/readers/materials/material_format.hpp"

#include <algorithm>
#include <array>

#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/materials/openfilters_material.hpp"
#include "schemas/readers/materials/refractiveindex_csv.hpp"
#include "schemas/readers/materials/refractiveindex_info.hpp"
#include "schemas/readers/materials/sopra.hpp"
#include "schemas/readers/materials/woollam.hpp"

namespace irido::schemas {

namespace {

bool is_refractiveindex_info(std::string_view text) {
    return text.starts_with("DATA:") || text.find("\nDATA:") != std::string_view::npos ||
           text.find("\rDATA:") != std::string_view::npos;
}

/// Whether the content is not text: a Matlab file, UTF-16, or arbitrary bytes.
bool is_binary(std::string_view text) {
    return text.starts_with("MATLAB") || text.substr(0, 4096).find('\0') != std::string_view::npos;
}

MaterialFile refuse_binary(std::string_view text, const std::string& name) {
    if (text.starts_with("MATLAB"))
        throw InputError(name, "", "must be text (got a binary MATLAB file)");
    const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    throw InputError(
        name, "", is_utf16 ? "must be UTF-8 text (got UTF-16)" : "must be text (got binary data)");
}

constexpr std::array kFormats{
    MaterialFormat{"binary", is_binary, refuse_binary},
    MaterialFormat{"refractiveindex.info", is_refractiveindex_info, read_refractiveindex_info},
    MaterialFormat{"refractiveindex.info CSV", is_refractiveindex_csv, read_refractiveindex_csv},
    MaterialFormat{"SOPRA .MAT", is_sopra_mat, read_sopra_mat},
    MaterialFormat{"SOPRA .nk", is_sopra_nk, read_sopra_nk},
    MaterialFormat{"Woollam .mat", is_woollam_mat, read_woollam_mat},
    MaterialFormat{"OpenFilters .mat", is_openfilters_material, read_openfilters_material},
};

}  // namespace

std::span<const MaterialFormat> material_formats() {
    return kFormats;
}

}  // namespace irido::schemas
