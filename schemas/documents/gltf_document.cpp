#include "schemas/documents/gltf_document.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

constexpr std::string_view kBinaryMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::size_t kHeadBytes = 20;  ///< headers of the file and of its first chunk
constexpr double kThickestFilm_nm = 1e9, kLargestIor = 1e4;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// The JSON chunk of a binary file, or the text itself.
std::string_view document_text(std::string_view bytes, const std::string& file) {
    if (!bytes.starts_with(kBinaryMagic)) return bytes;
    const auto broken = [&](const std::string& why) {
        return InputError(file, "", "not a binary glTF file: " + why);
    };
    if (bytes.size() < kHeadBytes) throw broken("truncated");
    const std::uint32_t version = little_endian(bytes, 4), length = little_endian(bytes, 12);
    if (version != 2) throw broken("its version is " + std::to_string(version) + ", not 2");
    if (little_endian(bytes, 16) != kJsonChunk) throw broken("its first chunk is not JSON");
    if (length > bytes.size() - kHeadBytes) throw broken("truncated");
    return bytes.substr(kHeadBytes, length);
}

/// A value of a document and its JSON pointer.
class GltfValue {
public:
    GltfValue(const nlohmann::json& value, std::string pointer, const std::string& file)
        : value_(&value), pointer_(std::move(pointer)), file_(&file) {}

    const nlohmann::json& json() const { return *value_; }
    std::size_t size() const { return value_->size(); }

    /// An object member, or an empty object if it is missing.
    GltfValue object(const std::string& key) const {
        static const nlohmann::json empty = nlohmann::json::object();
        const GltfValue found = member(key, empty);
        if (!found.value_->is_object()) throw found.error("must be an object");
        return found;
    }
    GltfValue array(const std::string& key) const {
        static const nlohmann::json empty = nlohmann::json::array();
        const GltfValue found = member(key, empty);
        if (!found.value_->is_array()) throw found.error("must be an array");
        return found;
    }
    GltfValue at(std::size_t index) const {
        return {(*value_)[index], pointer_ + "/" + std::to_string(index), *file_};
    }
    bool has(const std::string& key) const { return value_->contains(key); }

    double number(const std::string& key, double otherwise, double lowest, double highest) const {
        if (!has(key)) return otherwise;
        return member(key, *value_).number(lowest, highest);
    }
    double number(double lowest, double highest) const {
        if (!value_->is_number()) throw error("must be a number");
        const double number = value_->get<double>();
        if (!(number >= lowest && number <= highest))
            throw error("must be in [" + to_text(lowest) + ", " + to_text(highest) + "]");
        return number;
    }
    /// The first three numbers of an array of `count`.
    std::array<double, 3> color(const std::string& key, std::size_t count, double highest) const {
        if (!has(key)) return {1, 1, 1};
        const GltfValue found = array(key);
        if (found.size() != count)
            throw found.error("must be " + std::to_string(count) + " numbers");
        std::array<double, 3> color{};
        for (std::size_t c = 0; c < color.size(); ++c) color[c] = found.at(c).number(0, highest);
        return color;
    }
    std::string text(const std::string& key, const std::string& otherwise) const {
        if (!has(key)) return otherwise;
        const GltfValue found = member(key, *value_);
        if (!found.value_->is_string()) throw found.error("must be a string");
        return found.value_->get<std::string>();
    }
    InputError error(const std::string& rule) const {
        return {*file_, pointer_, rule + " (got " + short_text(*value_) + ")"};
    }

private:
    GltfValue member(const std::string& key, const nlohmann::json& otherwise) const {
        const auto found = value_->find(key);
        return {found == value_->end() ? otherwise : *found, pointer_ + pointer_step(key), *file_};
    }

    const nlohmann::json* value_;
    std::string pointer_;
    const std::string* file_;
};

std::array<double, 3> gltf_base_f0(const GltfValue& material) {
    const GltfValue metal = material.object("pbrMetallicRoughness");
    const GltfValue extensions = material.object("extensions");
    const GltfValue ior_extension = extensions.object("KHR_materials_ior");
    const GltfValue specular = extensions.object("KHR_materials_specular");
    const double ior = ior_extension.number("ior", 1.5, 0, kLargestIor);
    if (ior > 0 && ior < 1) ior_extension.number("ior", 1.5, 1, kLargestIor);
    const double at_normal = std::pow((ior - 1) / (ior + 1), 2);  // 1 for an index of 0
    const double strength = specular.number("specularFactor", 1, 0, 1);
    const std::array<double, 3> tint = specular.color("specularColorFactor", 3, 1e6);
    const double metallic = metal.number("metallicFactor", 1, 0, 1);
    std::array<double, 3> f0 = metal.color("baseColorFactor", 4, 1);
    for (std::size_t c = 0; c < f0.size(); ++c)
        f0[c] = metallic * f0[c] + (1 - metallic) * std::min(at_normal * tint[c], 1.0) * strength;
    return f0;
}

/// Textures whose contents are ignored.
std::vector<std::string> gltf_textures(const GltfValue& material, const GltfValue& film) {
    std::vector<std::string> names;
    const auto add = [&](const GltfValue& of, const std::string& name) {
        if (of.has(name)) names.push_back(name);
    };
    const GltfValue metal = material.object("pbrMetallicRoughness");
    const GltfValue specular = material.object("extensions").object("KHR_materials_specular");
    add(metal, "baseColorTexture");
    add(metal, "metallicRoughnessTexture");
    add(specular, "specularTexture");
    add(specular, "specularColorTexture");
    add(film, "iridescenceTexture");
    return names;
}

}  // namespace

std::vector<GltfIridescence> read_gltf(std::string_view bytes, const std::string& file) {
    const nlohmann::json document = parse_json(document_text(bytes, file), file);
    const GltfValue root(document, "", file);
    if (!document.is_object()) throw root.error("must be an object");
    const std::string version = root.object("asset").text("version", "");
    if (!version.starts_with("2."))
        throw InputError(file, "/asset/version", "must be 2.x (got \"" + version + "\")");
    std::vector<GltfIridescence> found;
    const GltfValue materials = root.array("materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const GltfValue material = materials.at(i);
        if (!material.json().is_object()) throw material.error("must be an object");
        const GltfValue extensions = material.object("extensions");
        if (!extensions.has("KHR_materials_iridescence")) continue;
        const GltfValue film = extensions.object("KHR_materials_iridescence");
        GltfIridescence result;
        result.name = material.text("name", "material " + std::to_string(i));
        result.base_f0 = gltf_base_f0(material);
        result.factor = film.number("iridescenceFactor", 0, 0, 1);
        result.film_n = film.number("iridescenceIor", 1.3, 1, kLargestIor);
        result.thickest_nm = film.number("iridescenceThicknessMaximum", 400, 0, kThickestFilm_nm);
        result.thinnest_nm = film.number("iridescenceThicknessMinimum", 100, 0, kThickestFilm_nm);
        if (!film.has("iridescenceThicknessTexture")) result.thinnest_nm = result.thickest_nm;
        result.textures = gltf_textures(material, film);
        found.push_back(std::move(result));
    }
    return found;
}

}  // namespace irido::schemas
