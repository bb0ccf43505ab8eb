#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace irido::schemas {

/// A material of a glTF asset with the extension KHR_materials_iridescence.
struct GltfIridescence {
    std::string name;  ///< or "material N", counted from 0
    /// Reflectance of the base at normal incidence, linear Rec.709, [0, 1]: baseColorFactor for a
    /// metal, KHR_materials_ior and KHR_materials_specular for a dielectric, mixed by
    /// metallicFactor.
    std::array<double, 3> base_f0{};
    double factor = 0;  ///< [0, 1]
    double film_n = 1.3;
    /// Ends of the thickness; equal where there is no texture.
    double thinnest_nm = 400, thickest_nm = 400;
    std::vector<std::string> textures;  ///< of which only the factors are used
};

/// Iridescent materials of a .gltf or .glb file, in file order. Only the document's materials are
/// read, no buffers or images. Throws InputError with the JSON pointer of a value that the
/// specification does not allow, for a truncated binary file, and for a version other than 2.
std::vector<GltfIridescence> read_gltf(std::string_view bytes, const std::string& file);

}  // namespace irido::schemas
