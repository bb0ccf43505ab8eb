#include "schemas/readers/stacks/zemax.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stacks/stack_writing.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

constexpr std::size_t kLongestZemaxName = 32;

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        words.push_back(text.substr(0, text.find_first_of(" \t")));
        text.remove_prefix(words.back().size());
    }
    return words;
}

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return result;
}

struct ZemaxRow {
    double um, n, k;
};

struct ZemaxMaterial {
    std::string name;
    std::vector<ZemaxRow> rows;

    /// Linear between the rows, the end values beyond.
    double n_at(double nm) const {
        const double um = nm / 1000;
        const auto above = std::ranges::upper_bound(rows, um, {}, &ZemaxRow::um);
        if (above == rows.begin()) return rows.front().n;
        if (above == rows.end()) return rows.back().n;
        const ZemaxRow& below = *(above - 1);
        return below.n + (um - below.um) / (above->um - below.um) * (above->n - below.n);
    }
};

struct ZemaxLayer {
    TextLine line;
    std::vector<std::string_view> words;
};

struct ZemaxCoating {
    std::string name;
    std::vector<ZemaxLayer> layers;
};

/// Materials and coatings of a file.
class ZemaxFile {
public:
    ZemaxFile(std::string_view text, const std::string& file) : file_(file) {
        for (const TextLine& line : lines_of(text)) {
            const std::vector<std::string_view> words = words_of(line.text);
            if (words.empty() || words[0].starts_with('!')) continue;
            if (!take_keyword(line, words)) take_row(line, words);
        }
        for (const auto& [name, material] : materials)
            if (material.rows.empty())
                throw InputError(file_, "", "MATE " + material.name + " has no rows");
    }

    std::map<std::string, ZemaxMaterial> materials;  ///< by name in capitals
    std::vector<ZemaxCoating> coatings;
    std::vector<std::string> left_out;

    [[noreturn]] void fail(const TextLine& line, std::string_view part,
                           const std::string& message) const {
        throw InputError(file_, place_of(line, part), message);
    }

    double number(const TextLine& line, std::string_view word) const {
        const auto value = parse_number(word);
        if (!value) fail(line, word, "must be a number (got " + in_quotes(word) + ")");
        return *value;
    }

private:
    enum class Section { none, material, coating, skipped };

    bool take_keyword(const TextLine& line, const std::vector<std::string_view>& words) {
        constexpr std::array<std::string_view, 5> kSkipped{"TABLE", "IDEAL", "IDEAL2", "ENCRYPTED",
                                                           "TAPR"};
        const std::string word = upper(words[0]);
        const bool is_skipped = std::ranges::find(kSkipped, word) != kSkipped.end();
        if (word != "MATE" && word != "COAT" && !is_skipped) return false;
        if (words.size() < 2) fail(line, words[0], word + " must be followed by a name");
        if (is_skipped) {
            section_ = Section::skipped;
            left_out.push_back(word + " " + std::string(words[1]));
        } else if (word == "MATE") {
            section_ = Section::material;
            const auto [place, is_new] =
                materials.try_emplace(upper(words[1]), ZemaxMaterial{std::string(words[1]), {}});
            if (!is_new) fail(line, words[1], "duplicate MATE " + place->second.name);
            material_ = &place->second;
        } else {
            section_ = Section::coating;
            coatings.push_back({std::string(words[1]), {}});
        }
        return true;
    }

    void take_row(const TextLine& line, const std::vector<std::string_view>& words) {
        if (section_ == Section::skipped) return;
        if (section_ == Section::coating) {
            coatings.back().layers.push_back({line, words});
            return;
        }
        if (section_ == Section::none)
            fail(line, words[0],
                 "must be MATE, COAT, TAPR, TABLE, IDEAL or ENCRYPTED (got " + in_quotes(words[0]) +
                     ")");
        if (words.size() < 2 || words.size() > 3)
            fail(line, words[0], "a row of MATE must be wavelength, n and -k");
        const ZemaxRow row{number(line, words[0]), number(line, words[1]),
                           words.size() > 2 ? -number(line, words[2]) : 0};
        if (!(row.um > 0)) fail(line, words[0], "the wavelength must be above 0");
        if (!material_->rows.empty() && row.um <= material_->rows.back().um)
            fail(line, words[0],
                 "wavelengths must ascend (got " + std::string(words[0]) + " after " +
                     to_text(material_->rows.back().um) + ")");
        material_->rows.push_back(row);
    }

    const std::string& file_;
    Section section_ = Section::none;
    ZemaxMaterial* material_ = nullptr;
};

const ZemaxCoating& chosen_coating(const ZemaxFile& zemax, const std::string& file,
                                   const StackReadOptions& options) {
    std::string names;
    for (const ZemaxCoating& coating : zemax.coatings) {
        if (upper(coating.name) == upper(options.coating)) return coating;
        names += (names.empty() ? "" : ", ") + coating.name;
    }
    if (zemax.coatings.empty()) throw InputError(file, "", "has no COAT");
    if (!options.coating.empty())
        throw InputError(file, "", "has no COAT " + options.coating + ", only " + names);
    if (zemax.coatings.size() > 1)
        throw InputError(file, "", "has several coatings; choose one of " + names);
    return zemax.coatings.front();
}

json material_json(const ZemaxMaterial& material) {
    json result{{"name", material.name}};
    if (material.rows.size() == 1) {
        result["n"] = material.rows.front().n;
        if (material.rows.front().k != 0) result["k"] = material.rows.front().k;
        return result;
    }
    json rows = json::array();
    for (const ZemaxRow& row : material.rows)
        rows.push_back({to_nm(row.um, SpectralUnit::um), row.n, row.k == 0 ? 0 : row.k});  // no -0
    result["table"] = std::move(rows);
    result["extrapolate"] = "clamp";
    return result;
}

/// The thickness of a layer's line, nm.
double thickness_of(const ZemaxFile& zemax, const ZemaxLayer& layer, const ZemaxMaterial* material,
                    const StackReadOptions& options) {
    const double typed = zemax.number(layer.line, layer.words[1]);
    const bool is_absolute =
        layer.words.size() > 2 && zemax.number(layer.line, layer.words[2]) != 0;
    if (!(typed >= 0)) zemax.fail(layer.line, layer.words[1], "the thickness must be 0 or more");
    if (is_absolute) return to_nm(typed, SpectralUnit::um);
    if (!(options.primary_nm > 0))
        zemax.fail(layer.line, layer.words[1],
                   "the thickness is in waves: --primary NM gives the primary wavelength");
    if (!material)
        zemax.fail(layer.line, layer.words[0],
                   "the thickness is in waves of a material that has no MATE");
    return typed * options.primary_nm / material->n_at(options.primary_nm);
}

json layer_json(const ZemaxFile& zemax, const ZemaxLayer& layer, const StackReadOptions& options,
                json& materials) {
    const std::vector<std::string_view>& words = layer.words;
    if (words.size() < 2 || words.size() > 5)
        zemax.fail(layer.line, words[0],
                   "a layer must be material, thickness, is_absolute, loop and taper");
    const std::string typed(words[0]);
    const auto found = zemax.materials.find(upper(typed));
    const ZemaxMaterial* const material = found == zemax.materials.end() ? nullptr : &found->second;
    if (!material && !options.media.contains(typed))
        zemax.fail(layer.line, words[0],
                   "material " + typed +
                       " has no MATE; if it is a glass of the catalogue, give it with --material " +
                       typed + "=...");
    if (words.size() > 3 && zemax.number(layer.line, words[3]) != 0)
        zemax.fail(layer.line, words[3], "loops are not read: write their layers out");
    if (words.size() > 4) zemax.fail(layer.line, words[4], "tapers are not read");
    const std::string name = material ? material->name : typed;
    if (material) materials[name] = material_json(*material);
    return {{"material", name}, {"thickness_nm", thickness_of(zemax, layer, material, options)}};
}

std::string um_text(double nm) {
    return plain_number(shifted(nm, -3));
}

std::string signed_k(double k) {
    return k == 0 ? "0" : plain_number(-k);
}

}  // namespace

StackFile read_zemax(std::string_view text, const std::string& file,
                     const StackReadOptions& options) {
    const ZemaxFile zemax(text, file);
    const ZemaxCoating& coating = chosen_coating(zemax, file, options);
    StackFile result;
    json materials = json::object(), layers = json::array();
    for (const ZemaxLayer& layer : coating.layers)
        layers.push_back(layer_json(zemax, layer, options, materials));
    json substrate = "BK7";
    if (options.is_mirror) {
        if (layers.empty()) throw InputError(file, "", "COAT " + coating.name + " has no layers");
        substrate = layers.back()["material"];
        layers.erase(layers.size() - 1);
        result.notes.push_back(file + ": the incident medium is not in the file: air");
    } else {
        result.notes.push_back(file +
                               ": the media around the coating are not in the file: air and BK7 "
                               "(--set substrate=... gives another one)");
    }
    for (const std::string& name : zemax.left_out)
        result.notes.push_back(file + ": " + name + " is left out");
    result.document = {{"name", coating.name},
                       {"incident", "air"},
                       {"layers", std::move(layers)},
                       {"substrate", std::move(substrate)}};
    if (!materials.empty()) result.document["materials"] = std::move(materials);
    return result;
}

WrittenStack write_zemax(const Stack& stack, const StackWriteOptions& options) {
    Losses losses;
    std::vector<Layer> layers = layers_written_out(stack, losses);
    const Material& substrate = stack.materials[stack.substrate];
    const bool is_mirror = is_opaque(substrate);
    losses.add("the incident medium " + name_in_words(stack.materials[stack.incident]));
    if (is_mirror) {
        layers.push_back({stack.substrate, 1000});
        losses.add("the substrate " + name_in_words(substrate) +
                   ": it is the last layer, and the coating is for mirrors");
    } else {
        losses.add("the substrate " + name_in_words(substrate));
    }
    const std::vector<std::string> names = plain_names(stack, kLongestZemaxName);
    WrittenStack result;
    std::string coating =
        "COAT " + plain_name(options.name.empty() ? "IRIDO" : options.name, kLongestZemaxName) +
        "\n";
    std::vector<bool> is_used(stack.materials.size());
    for (const Layer& layer : layers) {
        is_used[layer.material] = true;
        if (!layer.coherent) losses.add("\"coherent\": false");
        coating += names[layer.material] + " " + um_text(layer.thickness_nm) + " 1\n";
    }
    for (std::size_t m = 0; m < names.size(); ++m) {
        if (!is_used[m]) continue;
        result.text += "MATE " + names[m] + "\n";
        for (const auto& [nm, n, k] : index_rows_within(stack.materials[m], options.range))
            result.text += um_text(nm) + " " + plain_number(n) + " " + signed_k(k) + "\n";
        result.text += "\n";
        note_name(stack.materials[m], names[m], losses);
    }
    result.text += coating;
    result.losses = losses.take();
    return result;
}

}  // namespace irido::schemas
