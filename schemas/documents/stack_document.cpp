#include "schemas/documents/stack_document.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/coherent/graded_layer.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "core/nearest.hpp"
#include "core/stack/index_table.hpp"
#include "core/stack/reversed.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/equal_materials.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/material_models.hpp"
#include "schemas/documents/material_words.hpp"
#include "schemas/documents/plain_stack.hpp"
#include "schemas/documents/rough_faces.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/material_database.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {
namespace {

using nlohmann::json;

constexpr std::size_t kMostLayers = 1'000'000;

/// Hashes JSON values by content, not by place.
struct JsonHash {
    std::size_t operator()(const json* value) const { return std::hash<json>{}(*value); }
};
struct JsonEqual {
    bool operator()(const json* a, const json* b) const { return *a == *b; }
};

// --- the reader -----------------------------------------------------------------------------

/// Builds a stack from a document. Collects all problems, and skips the parts that violate the
/// schema.
class StackReader {
public:
    StackReader(const json& document, const std::string& file, const std::string& folder,
                MaterialFiles& files)
        : document_(document), file_(file), folder_(folder), files_(files) {
        if (is_plain_stack(document)) return;
        static const Schema schema(json::parse(stack_schema_text()));
        for (const Problem& problem : check(schema, document)) {
            broken_.insert(problem.pointer);
            problems.emplace_back(file_, problem.pointer, problem.message);
        }
    }

    std::vector<InputError> problems;

    StackDocument read() {
        if (!document_.is_object()) return {};
        Stack& stack = result_.stack;
        read_named();
        if (document_.contains("incident")) {
            stack.incident = material(document_["incident"], "/incident");
            require_real(stack.incident);
        }
        if (document_.contains("layers")) stack.elements = elements(document_["layers"], "/layers");
        if (document_.contains("substrate")) {
            stack.substrate = material(document_["substrate"], "/substrate");
        }
        if (broken_.empty() && problems.empty() && has_rough_faces(document_)) roughen();
        if (layers_ > kMostLayers) {
            report("/layers", "must hold at most 1e6 layers (got " + std::to_string(layers_) + ")");
        }
        if (!is_broken("/name")) result_.name = document_.value("name", "");
        return std::move(result_);
    }

private:
    void report(const std::string& pointer, const std::string& message) {
        problems.emplace_back(file_, pointer, message);
    }

    /// True if the value at the pointer, or anything inside it, violates the schema.
    bool is_broken(const std::string& pointer) const {
        if (broken_.empty()) return false;
        if (broken_.contains(pointer)) return true;
        const auto inside = broken_.lower_bound(pointer + "/");
        return inside != broken_.end() && inside->starts_with(pointer + "/");
    }

    /// Reads the document's own materials, used or not.
    void read_named() {
        const auto found = document_.find("materials");
        if (found == document_.end() || !found->is_object()) return;
        std::map<std::string, Material> named;
        for (const auto& [name, value] : found->items()) {
            const std::string pointer = "/materials" + pointer_step(name);
            named.emplace(name, is_broken(pointer) ? Material{name, RefractiveIndex{}}
                                                   : build(value, pointer));
        }
        named_ = std::move(named);  // only now, as they cannot refer to each other
    }

    std::vector<Element> elements(const json& array, const std::string& pointer) {
        std::vector<Element> result;
        if (!array.is_array()) return result;
        result.reserve(array.size());
        for (std::size_t i = 0; i < array.size(); ++i) {
            const std::string place = pointer + "/" + std::to_string(i);
            if (!array[i].is_object()) continue;
            const auto layers = array[i].find("layers");
            if (layers != array[i].end()) {
                result.push_back({group(array[i], *layers, place)});
            } else if (array[i].contains("graded")) {
                result.push_back({graded_layer_of(array[i], place)});
            } else {
                result.push_back({layer(array[i], place)});
            }
        }
        return result;
    }

    Group group(const json& object, const json& layers, const std::string& pointer) {
        Group result;
        if (!is_broken(pointer)) {
            result.repeat = static_cast<std::uint64_t>(object["repeat"].get<double>());
        }
        result.elements = elements(layers, pointer + "/layers");
        return result;
    }

    Layer layer(const json& object, const std::string& pointer) {
        ++layers_;
        Layer result;
        if (const auto found = object.find("material"); found != object.end()) {
            result.material = material(*found, pointer + "/material");
        }
        if (is_broken(pointer)) return result;
        result.thickness_nm =
            object.contains("qwot")
                ? quarter_waves(object["qwot"].get<double>(), result.material, pointer + "/qwot")
                : object["thickness_nm"].get<double>();
        result.thickness_sigma_nm = number_or(object, "thickness_sigma_nm", 0);
        result.coherent = object.value("coherent", true);
        if (!result.coherent && is_uniaxial(result_.stack.materials[result.material]))
            report(pointer, "a uniaxial layer must be coherent");
        return result;
    }

    /// A graded layer as a group of its parts that occurs once.
    Group graded_layer_of(const json& object, const std::string& pointer) {
        ++layers_;
        Group result;
        if (is_broken(pointer)) return result;
        if (!object.value("coherent", true)) report(pointer, "a graded layer must be coherent");
        const json& graded = object["graded"];
        const std::string place = pointer + "/graded";
        const double thickness_nm = object["thickness_nm"].get<double>();
        try {
            const GradedLayer parts = graded_layer(isotropic(graded["from"], place + "/from"),
                                                   isotropic(graded["to"], place + "/to"),
                                                   graded_profile(graded.value("profile", "n")),
                                                   thickness_nm, incident_index(), place);
            constexpr double kPoor = 1e-5;
            if (!(parts.error <= kPoor))
                report(place, "changes too much over " + to_text(thickness_nm) +
                                  " nm for parts of an error below " + to_text(kPoor));
            else if (parts.error > kGradedError)
                result_.notes.push_back(file_ + ": " + place + ": the error of r and t is up to " +
                                        to_text(parts.error) + " at 380 nm");
            Layer part;
            part.thickness_nm = thickness_nm / static_cast<double>(parts.parts.size());
            for (const Material& material : parts.parts) {
                part.material = add(material, place);
                ++part.part;
                result.elements.push_back({part});
            }
        } catch (const DomainError& error) {
            report(place, error.what());
        }
        return result;
    }

    /// Approximate incident index, for measuring the error of graded layers.
    double incident_index() const {
        Material incident = result_.stack.materials[result_.stack.incident];
        incident.outside = Outside::clamp;
        return std::max(1e-3, index_at(incident, kGradedWavelength_nm).real());
    }

    /// Inserts the layers of rough faces.
    void roughen() {
        Stack& stack = result_.stack;
        const FaceReader faces{
            [&](const json& layer, const std::string& pointer, bool top) {
                const char* const end = top ? "from" : "to";
                return material(layer["graded"][end], pointer + "/graded/" + end);
            },
            [&](std::size_t above, std::size_t below, bool centred, const std::string& pointer) {
                const Material &upper = stack.materials[above], &lower = stack.materials[below];
                if (is_uniaxial(upper) || is_uniaxial(lower)) {
                    report(pointer, "a face of a uniaxial medium cannot be rough");
                    return above;
                }
                return add({centred ? "roughness, centred" : "roughness, added",
                            Mixture{MixingRule::bruggeman, 0.5, {upper, lower}}, Outside::refuse},
                           pointer);
            },
            [&](const std::string& pointer, const std::string& message) {
                report(pointer, message);
            }};
        stack.elements =
            with_rough_faces(document_, stack.elements, stack.incident, stack.substrate, faces);
    }

    /// Thickness of `count` quarter waves of a material, at normal incidence.
    double quarter_waves(double count, std::size_t material, const std::string& pointer) {
        if (!document_.contains("reference_nm")) {
            report(pointer, "requires the stack's reference_nm (or --reference NM)");
            return 0;
        }
        if (is_broken("/reference_nm")) return 0;
        const double reference_nm = document_["reference_nm"].get<double>();
        try {
            const double n = index_at(result_.stack.materials[material], reference_nm).real();
            const double thickness_nm = count * (reference_nm / (4 * n));
            if (thickness_nm <= kLargestThickness_nm) return thickness_nm;
            report(pointer, "must be a thickness in [0, 1e9] nm (got " + to_text(count) +
                                " quarter waves of index " + to_text(n) + ")");
        } catch (const DomainError& error) {
            report(pointer, error.what());
        }
        return 0;
    }

    /// Index of a material in the stack's list, to which it is added if new.
    std::size_t material(const json& value, const std::string& pointer) {
        if (is_broken(pointer)) return 0;
        const auto [known, is_new] = by_text_.try_emplace(&value, 0);
        if (is_new) known->second = add(build(value, pointer), pointer);
        return known->second;
    }

    std::size_t add(Material built, const std::string& pointer) {
        std::vector<Material>& all = result_.stack.materials;
        const std::uint64_t hash = hash_of(built);
        const auto [first, last] = by_hash_.equal_range(hash);
        const auto same = std::find_if(
            first, last, [&](const auto& entry) { return same_physics(all[entry.second], built); });
        if (same != last) return same->second;
        by_hash_.emplace(hash, all.size());
        all.push_back(std::move(built));
        result_.material_pointers.push_back(pointer);
        return all.size() - 1;
    }

    Material build(const json& value, const std::string& pointer) {
        if (value.is_number()) return constant(value.get<double>(), 0, pointer);
        if (value.is_string()) return named(value.get<std::string>(), pointer);
        Material result = from_object(value, pointer);
        if (value.contains("extrapolate")) result.outside = Outside::clamp;
        return result;
    }

    /// A material of the document, of a file or of the library.
    Material named(const std::string& name, const std::string& pointer) {
        if (const auto own = named_.find(name); own != named_.end()) return own->second;
        if (name.starts_with(kDatabaseMark)) return from_database(name, pointer);
        return is_material_file(name) ? from_file(name, pointer) : built_in(name, pointer);
    }

    Material from_object(const json& object, const std::string& pointer) {
        constexpr std::array kModels{"n",         "file",          "table",   "cauchy",
                                     "sellmeier", "lorentz_drude", "mixture", "ordinary"};
        const bool has_model = std::any_of(kModels.begin(), kModels.end(), [&](const char* model) {
            return object.contains(model);
        });
        if (!has_model) return named(object["name"].get<std::string>(), pointer + "/name");
        Material result = from_model(object, pointer);
        if (object.contains("name")) result.name = object["name"].get<std::string>();
        return result;
    }

    Material from_model(const json& object, const std::string& pointer) {
        if (object.contains("n")) {
            return constant(object["n"].get<double>(), number_or(object, "k", 0), pointer);
        }
        if (object.contains("file")) {
            return from_file(object["file"].get<std::string>(), pointer + "/file");
        }
        if (object.contains("table")) {
            require_increasing(object["table"], pointer + "/table");
            MaterialFile read = read_table(object["table"], pointer);
            for (const std::string& note : read.notes)
                result_.notes.push_back(file_ + ": " + pointer + ": " + note);
            note_gain(std::get<RefractiveIndex>(read.material.model), pointer);
            return std::move(read.material);
        }
        if (object.contains("cauchy")) {
            return {pointer, RefractiveIndex{read_cauchy(object["cauchy"])}};
        }
        if (object.contains("sellmeier")) {
            return {pointer, RefractiveIndex{read_sellmeier(object["sellmeier"])}};
        }
        if (object.contains("ordinary")) return {pointer, uniaxial(object, pointer)};
        if (object.contains("mixture"))
            return {pointer, mixture(object["mixture"], pointer + "/mixture")};
        return {pointer, read_lorentz_drude(object["lorentz_drude"])};
    }

    Uniaxial uniaxial(const json& object, const std::string& pointer) {
        Uniaxial medium;
        for (const std::string key : {"ordinary", "extraordinary"})
            medium.parts.push_back(isotropic(object[key], pointer + "/" + key));
        return medium;
    }

    /// A material that is not uniaxial.
    Material isotropic(const json& value, const std::string& pointer) {
        Material result = build(value, pointer);
        if (!is_uniaxial(result)) return result;
        report(pointer, "must be isotropic");
        return {result.name, RefractiveIndex{}};
    }

    Mixture mixture(const json& object, const std::string& pointer) {
        return {mixing_rule(object.value("model", "bruggeman")),
                object["fraction"].get<double>(),
                {isotropic(object["inclusion"], pointer + "/inclusion"),
                 isotropic(object["host"], pointer + "/host")}};
    }

    Material constant(double n, double k, const std::string& pointer) {
        if (k < 0) result_.notes.push_back(file_ + ": " + pointer + ": k < 0 amplifies");
        Material result{index_text(n, k), {}};
        auto& index = std::get<RefractiveIndex>(result.model);
        index.n = Constant{n};
        index.k = Constant{k};
        return result;
    }

    Material built_in(const std::string& name, const std::string& pointer) {
        if (auto found = find_material(name)) return std::move(found->material);
        std::vector<std::string> known = library_names_and_aliases();
        for (const auto& [own, material] : named_) known.push_back(own);
        report(pointer, "unknown material " + short_text(name) + did_you_mean(name, known));
        return {name, RefractiveIndex{}};
    }

    Material from_file(const std::string& path, const std::string& pointer) {
        const std::filesystem::path place = std::filesystem::path(folder_) / path;
        if (!is_material_file(place.string())) {
            report(pointer, "must end in .csv, .txt, .tsv, .dat, .nk, .mat, .yml or .yaml (got \"" +
                                path + "\")");
            return {path, RefractiveIndex{}};
        }
        try {
            const MaterialFile& read = files_.read(place.string());
            for (const std::string& note : read.notes) {
                result_.notes.push_back(place.string() + ": " + note);
            }
            note_gain(std::get<RefractiveIndex>(read.material.model), pointer);
            return read.material;
        } catch (const InputError& error) {
            report(pointer, error.what());
            return {path, RefractiveIndex{}};
        }
    }

    Material from_database(const std::string& name, const std::string& pointer) {
        try {
            const MaterialFile& read = files_.read(database_file(name));
            for (const std::string& note : read.notes) result_.notes.push_back(name + ": " + note);
            Material material = read.material;
            material.name = name;
            return material;
        } catch (const InputError& error) {
            report(pointer, error.what());
            return {name, RefractiveIndex{}};
        }
    }

    /// Notes a k below 0, which is often a table of n - ik.
    void note_gain(const RefractiveIndex& index, const std::string& pointer) {
        const auto* k = std::get_if<Table>(&index.k);
        if (k != nullptr && *std::min_element(k->value.begin(), k->value.end()) < 0)
            result_.notes.push_back(file_ + ": " + pointer + ": k < 0 amplifies");
    }

    void require_increasing(const json& rows, const std::string& pointer) {
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const double before = rows[i - 1][0].get<double>();
            const double here = rows[i][0].get<double>();
            if (here > before) continue;
            report(pointer + "/" + std::to_string(i) + "/0",
                   "must be above that of the row before, " + to_text(before) + " (got " +
                       to_text(here) + ")");
        }
    }

    /// Checks an incident medium with constant k; others are checked at the requested wavelengths.
    void require_real(std::size_t incident) {
        if (is_broken("/incident") || result_.stack.materials.empty()) return;
        const Material& medium = result_.stack.materials[incident];
        if (is_uniaxial(medium)) return report("/incident", "must be isotropic");
        if (!is_constant(medium)) return;
        const double k = index_at(medium, kAllWavelengths.first_nm).imag();
        if (std::abs(k) >= kTransparentBelow_k)
            report("/incident", "must be transparent, |k| below 1e-3 (got " + to_text(k) + ")");
        else if (k != 0)
            result_.notes.push_back(file_ + ": /incident: " + incident_note(k));
    }

    const json& document_;
    const std::string& file_;
    const std::string& folder_;
    MaterialFiles& files_;
    std::set<std::string> broken_;
    StackDocument result_;
    std::size_t layers_ = 0;
    std::map<std::string, Material> named_;
    std::unordered_map<const json*, std::size_t, JsonHash, JsonEqual> by_text_;
    std::unordered_multimap<std::uint64_t, std::size_t> by_hash_;
};

}  // namespace

std::string incident_note(double k) {
    return "the incident medium is taken as transparent: its k of up to " + to_text(k) +
           " is ignored";
}

const char* stack_schema_text() {
    return
#include "stack_schema.inc"
        ;
}

StackDocument read_stack(const json& document, const std::string& file, const std::string& folder) {
    MaterialFiles files;
    return read_stack(document, file, folder, files);
}

StackDocument read_stack(const json& document, const std::string& file, const std::string& folder,
                         MaterialFiles& files) {
    StackReader reader(document, file, folder, files);
    if (!reader.problems.empty()) {
        if (const std::string other = other_kind(document, DocumentKind::stack); !other.empty())
            throw InputError(file, "", other);
        throw InputError(reader.problems.front());
    }
    StackDocument result = reader.read();
    if (!reader.problems.empty()) throw InputError(reader.problems.front());
    result.file = file;
    return result;
}

StackDocument read_stack(const StackRequest& request) {
    return read_source(load_stack(request));
}

namespace {

/// Reverses the stack; the substrate, where the light then comes from, must be transparent.
void reverse(StackDocument& document) {
    document.stack = reversed(std::move(document.stack));
    const Material& incident = document.stack.materials[document.stack.incident];
    if (is_uniaxial(incident))
        throw InputError(document.file, "/substrate", "must be isotropic for --reverse");
    if (!is_constant(incident)) return;  // reported later, at the requested wavelengths
    const double k = index_at(incident, kAllWavelengths.first_nm).imag();
    if (std::abs(k) >= kTransparentBelow_k)
        throw InputError(
            document.file, "/substrate",
            "must be transparent, |k| below 1e-3, for --reverse (got " + to_text(k) + ")");
    if (k != 0) document.notes.push_back(document.file + ": /substrate: " + incident_note(k));
}

}  // namespace

StackDocument read_source(const StackSource& source) {
    MaterialFiles files;
    return read_source(source, source.document, files);
}

StackDocument read_source(const StackSource& source, const json& document, MaterialFiles& files) {
    StackDocument result = read_stack(document, source.file, source.folder, files);
    if (source.reverse) reverse(result);
    return result;
}

std::vector<std::string> stack_problems(const json& document, const std::string& file,
                                        const std::string& folder) {
    std::vector<std::string> lines;
    MaterialFiles files;
    try {
        StackReader reader(document, file, folder, files);
        reader.read();
        for (const InputError& problem : reader.problems) lines.emplace_back(problem.what());
    } catch (const InputError& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

std::vector<std::string> validate_stack_file(const std::string& path) {
    const std::string text = read_text(path);
    json document;
    try {
        document = parse_json(text, shown_path(path));
    } catch (const InputError& error) {
        return {error.what()};
    }
    return stack_problems(document, shown_path(path),
                          std::filesystem::path(path).parent_path().string());
}

}  // namespace irido::schemas
