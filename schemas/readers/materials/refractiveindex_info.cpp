#include "schemas/readers/materials/refractiveindex_info.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/material/air.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

/// Valid numbers of coefficients of formulas 1 to 9: each pole or power belongs to the coefficient
/// before it.
const std::array<std::vector<std::size_t>, 9> kCounts{{
    {1, 3, 5, 7, 9, 11, 13, 15, 17},
    {1, 3, 5, 7, 9, 11, 13, 15, 17},
    {1, 3, 5, 7, 9, 11, 13, 15, 17},
    {1, 5, 9, 11, 13, 15, 17},
    {1, 3, 5, 7, 9, 11},
    {1, 3, 5, 7, 9, 11},
    {1, 2, 3, 4, 5, 6},
    {1, 3, 4},
    {1, 3, 6},
}};

/// The content of one item of DATA.
struct Item {
    std::optional<Dispersion> n;
    std::optional<Table> k;
};

/// Context for messages, and the notes so far.
struct Reader {
    const std::string& file;
    std::vector<std::string> notes;
    std::string where;
    Reference reference;

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(file, where, message);
    }
};

double um_to_nm(double um) {
    return to_nm(um, SpectralUnit::um);
}

/// The numbers of one line, which must contain nothing else.
std::vector<double> numbers_of(std::string_view line, const Reader& reader) {
    std::vector<double> numbers;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const std::string_view token = line.substr(0, line.find_first_of(" \t"));
        const auto number = parse_number(token);
        if (!number) reader.fail("must be a number (got " + in_quotes(token) + ")");
        numbers.push_back(*number);
        line.remove_prefix(token.size());
    }
    return numbers;
}

/// A text or a list.
YAML::Node value_of(const YAML::Node& item, const char* key, const Reader& reader) {
    const YAML::Node value = item[key];
    if (!value || !(value.IsScalar() || value.IsSequence()))
        reader.fail(std::string("must have the text '") + key + "'");
    return value;
}

std::string text_of(const YAML::Node& item, const char* key, const Reader& reader) {
    const YAML::Node value = item[key];
    if (!value || !value.IsScalar()) reader.fail(std::string("must have the text '") + key + "'");
    return value.Scalar();
}

/// The numbers in a text or in a list.
std::vector<double> numbers_of(const YAML::Node& value, const Reader& reader) {
    if (!value.IsSequence()) return numbers_of(std::string_view(value.Scalar()), reader);
    std::vector<double> numbers;
    for (const YAML::Node& entry : value) {
        if (!entry.IsScalar()) reader.fail("must be a list of numbers only");
        for (const double number : numbers_of(std::string_view(entry.Scalar()), reader))
            numbers.push_back(number);
    }
    return numbers;
}

/// Before 2018 the key was called range.
WavelengthRange range_of(const YAML::Node& item, const Reader& reader) {
    const char* const key =
        item["wavelength_range"] || !item["range"] ? "wavelength_range" : "range";
    const auto ends = numbers_of(value_of(item, key, reader), reader);
    if (ends.size() != 2 || !(ends[0] > 0) || !(ends[0] <= ends[1]))
        reader.fail(std::string(key) + " must be two increasing wavelengths in um");
    return {um_to_nm(ends[0]), um_to_nm(ends[1])};
}

/// "1, 3 or 4".
std::string in_words(const std::vector<std::size_t>& counts) {
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i)
        text += (i == 0 ? "" : i + 1 < counts.size() ? ", " : " or ") + std::to_string(counts[i]);
    return text;
}

Item formula_item(const YAML::Node& item, std::string_view number, const Reader& reader) {
    if (number.size() != 1 || number[0] < '1' || number[0] > '9')
        reader.fail("formula must be 1 to 9 (got " + in_quotes(number) + ")");
    const int index = number[0] - '0';
    auto coefficients = numbers_of(value_of(item, "coefficients", reader), reader);
    const auto& counts = kCounts[static_cast<std::size_t>(index - 1)];
    if (std::ranges::find(counts, coefficients.size()) == counts.end())
        reader.fail("formula " + std::to_string(index) + " must have " + in_words(counts) +
                    " coefficients (got " + std::to_string(coefficients.size()) + ")");
    return {Formula{index, std::move(coefficients), range_of(item, reader), reader.reference},
            std::nullopt};
}

/// The rows of a table, given as lines of text or as a list.
std::vector<std::vector<double>> numbers_by_row(const YAML::Node& data, const Reader& reader) {
    std::vector<std::vector<double>> rows;
    if (data.IsSequence()) {
        for (const YAML::Node& row : data) rows.push_back(numbers_of(row, reader));
        return rows;
    }
    std::string_view block = data.Scalar();
    while (!block.empty()) {
        const std::string_view line = block.substr(0, block.find('\n'));
        block.remove_prefix(std::min(line.size() + 1, block.size()));
        rows.push_back(numbers_of(line, reader));
    }
    return rows;
}

std::vector<IndexRow> rows_of(const YAML::Node& data, std::size_t columns, const Reader& reader) {
    std::vector<IndexRow> rows;
    std::size_t number = 0;
    for (const std::vector<double>& numbers : numbers_by_row(data, reader)) {
        ++number;
        if (numbers.empty()) continue;
        if (numbers.size() != columns)
            reader.fail("row " + std::to_string(number) + " must have " +
                        plural(columns, "column") + " (got " + std::to_string(numbers.size()) +
                        ")");
        if (!(numbers[0] > 0))
            reader.fail("row " + std::to_string(number) +
                        ": the wavelength must be positive (got " + to_text(numbers[0]) + ")");
        rows.push_back({um_to_nm(numbers[0]), numbers[1], columns == 3 ? numbers[2] : 0});
    }
    if (rows.empty()) reader.fail("the table has no rows");
    return rows;
}

/// k of a passive medium: negative values are noise.
Table absorption(Table table, Reader& reader) {
    std::size_t negative = 0;
    for (double& k : table.value)
        if (k < 0) {
            k = 0;
            ++negative;
        }
    if (negative > 0)
        reader.notes.push_back(reader.where + ": k < 0 set to 0 in " + plural(negative, "row"));
    return table;
}

Item table_item(const YAML::Node& item, std::string_view quantity, Reader& reader) {
    if (quantity == "n2")
        reader.fail("tabulated n2 is a nonlinear index in m^2/W, not a refractive index");
    if (quantity != "n" && quantity != "k" && quantity != "nk")
        reader.fail("unknown type " + in_quotes("tabulated " + std::string(quantity)));
    auto rows = rows_of(value_of(item, "data", reader), quantity.size() + 1, reader);
    put_in_order(rows, reader.where + ": ", reader.notes);
    const auto n = [&] { return in_vacuum(column(rows, 1), reader.reference, true); };
    const auto k = [&](std::size_t value) {
        return in_vacuum(absorption(column(rows, value), reader), reader.reference, false);
    };
    if (quantity == "n") return {n(), std::nullopt};
    if (quantity == "k") return {std::nullopt, k(1)};
    return {n(), k(2)};
}

Item item_of(const YAML::Node& item, Reader& reader) {
    if (!item.IsMap()) reader.fail("must be a map with a type");
    const std::string type = text_of(item, "type", reader);
    const std::size_t blank = std::min(type.find(' '), type.size());
    const std::string_view kind = std::string_view(type).substr(0, blank);
    const std::string_view rest = trimmed(std::string_view(type).substr(blank));
    if (kind == "formula") return formula_item(item, rest, reader);
    if (kind == "tabulated") return table_item(item, rest, reader);
    reader.fail("unknown type " + in_quotes(type));
}

/// The largest deviation of `other` from `dispersion` at its rows; infinite if it extends beyond
/// the latter's range.
double distance(const Dispersion& dispersion, const Dispersion& other) {
    const Material material{"", RefractiveIndex{dispersion, Constant{0}}, Outside::refuse};
    const auto* table = std::get_if<Table>(&other);
    double largest = table == nullptr ? INFINITY : 0;
    for (std::size_t i = 0; table != nullptr && i < table->value.size(); ++i) {
        const double nm = table->wavelength_nm[i];
        const WavelengthRange known = range_of(material);
        if (nm < known.first_nm || nm > known.last_nm) return INFINITY;
        largest = std::max(largest, std::abs(index_at(material, nm).real() - table->value[i]));
    }
    return largest;
}

/// Joins two non-overlapping tables, with a note about the gap between them.
std::optional<Table> joined(const Dispersion& first, const Dispersion& second,
                            const std::string& what, Reader& reader) {
    const auto *a = std::get_if<Table>(&first), *b = std::get_if<Table>(&second);
    if (a == nullptr || b == nullptr) return std::nullopt;
    if (b->wavelength_nm.front() < a->wavelength_nm.front()) std::swap(a, b);
    if (!(a->wavelength_nm.back() < b->wavelength_nm.front())) return std::nullopt;
    const WavelengthRange between{a->wavelength_nm.back(), b->wavelength_nm.front()};
    reader.notes.push_back(reader.where + ": " + what +
                           " joined to the table before, interpolated from " +
                           schemas::in_words(between));
    Table both = *a;
    both.wavelength_nm.insert(both.wavelength_nm.end(), b->wavelength_nm.begin(),
                              b->wavelength_nm.end());
    both.value.insert(both.value.end(), b->value.begin(), b->value.end());
    return both;
}

/// Adds n or k of another item: non-overlapping ranges are joined, overlapping ones must agree.
template <class Known>
void take(std::optional<Known>& known, std::optional<Known> more, const std::string& what,
          Reader& reader) {
    constexpr double kEqual = 5e-3;  // a table and the formula fitted to it
    if (!more) return;
    if (!known) {
        known = std::move(more);
        return;
    }
    if (auto both = joined(*known, *more, what, reader)) {
        known = *std::move(both);
        return;
    }
    const double apart = distance(*known, *more);
    if (!(apart <= kEqual)) reader.fail(what + " is given twice with different values");
    reader.notes.push_back(reader.where + ": " + what + " given twice, at most " + to_text(apart) +
                           " apart: the first is used");
}

/// A map's statement about air, under any name that the key has had; empty if there is none.
std::optional<bool> flag_in(const YAML::Node& map, std::initializer_list<const char*> keys) {
    if (!map || !map.IsMap()) return std::nullopt;
    for (const char* const key : keys) {
        const YAML::Node value = map[key];
        if (value && value.IsScalar() && value.Scalar() == "true") return true;
        if (value && value.IsScalar() && value.Scalar() == "false") return false;
    }
    return std::nullopt;
}

/// "20.0 C" or kelvins; empty if there is none from -40 to 100 C.
std::optional<double> temperature_in(const YAML::Node& map) {
    if (!map || !map.IsMap() || !map["temperature"] || !map["temperature"].IsScalar())
        return std::nullopt;
    const std::string text = map["temperature"].Scalar();
    const std::string_view word = std::string_view(text).substr(0, text.find_first_of(" \t"));
    const auto value = parse_number(word);
    const bool is_celsius =
        text.find('C') != std::string::npos || text.find("\u2103") != std::string::npos;
    const double celsius = value.value_or(20) - (is_celsius ? 0 : 273.15);
    if (!value || !(celsius >= -40 && celsius <= 100)) return std::nullopt;
    return std::round(celsius * 2) / 2;  // 293 K counts as 20 C
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// Catalogues of optical glasses, all of which are measured in air.
bool is_glass_catalogue(const YAML::Node& document, const std::string& source) {
    const YAML::Node properties = document["PROPERTIES"];
    if (properties && properties.IsMap() && properties["glass_code"]) return true;
    const std::string words = lower(source);
    return words.find("zemax catalog") != std::string::npos ||
           words.find("optical glass catalog") != std::string::npos;
}

/// The file's statement about air, with a note if there is one.
Reference reference_of(const YAML::Node& document, const std::string& source,
                       std::vector<std::string>& notes) {
    std::optional<bool> absolute, vacuum;
    std::optional<double> celsius;
    for (const char* const key : {"SPECS", "CONDITIONS", "PROPERTIES", "INFO"}) {
        const YAML::Node map = document[key];
        if (!absolute) absolute = flag_in(map, {"n_is_absolute", "n_absolute"});
        if (!vacuum)
            vacuum = flag_in(map, {"wavelength_is_vacuum", "wavelength_vacuum", "\u03BB_is_vacuum",
                                   "\u03BB_vacuum"});
        if (!celsius) celsius = temperature_in(map);
    }
    const bool by_catalogue = !absolute && !vacuum && is_glass_catalogue(document, source);
    const Reference reference{!absolute.value_or(!by_catalogue), !vacuum.value_or(!by_catalogue),
                              celsius.value_or(20)};
    if (!reference.index_to_air && !reference.wavelength_in_air) return reference;
    notes.push_back(std::string(reference.index_to_air ? "n relative to air" : "") +
                    (reference.index_to_air && reference.wavelength_in_air ? " and " : "") +
                    (reference.wavelength_in_air ? "wavelengths in air" : "") + " (" +
                    to_text(reference.temperature_c) + " C" +
                    (by_catalogue ? ", as in glass catalogues" : "") + ") converted to vacuum");
    return reference;
}

/// `text` without HTML tags; a < that opens no tag stays.
std::string without_tags(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        const bool opens = text[0] == '<' && text.size() > 1 &&
                           (text[1] == '/' || (text[1] >= 'a' && text[1] <= 'z'));
        const std::size_t end = opens ? text.find('>') : std::string_view::npos;
        if (end == std::string_view::npos) {
            plain += text[0];
            text.remove_prefix(1);
        } else {
            text.remove_prefix(end + 1);
        }
    }
    return plain;
}

/// `text` on one line, words separated by single spaces.
std::string on_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
    return line;
}

MaterialFile material_in(const YAML::Node& document, const std::string& name) {
    Reader reader{name, {}, "DATA", {}};
    const YAML::Node data = document.IsMap() ? document["DATA"] : YAML::Node();
    if (!data || !data.IsSequence() || data.size() == 0)
        reader.fail("must be a list of formulas and tables");
    const YAML::Node references = document["REFERENCES"];
    std::string source = references && references.IsScalar()
                             ? on_one_line(without_tags(references.Scalar()))
                             : std::string();
    reader.reference = reference_of(document, source, reader.notes);
    Item found;
    std::size_t number = 0;
    for (const YAML::Node& node : data) {
        reader.where = "DATA/" + std::to_string(number++);
        Item item = item_of(node, reader);
        take(found.n, std::move(item.n), "n", reader);
        take(found.k, std::move(item.k), "k", reader);
    }
    reader.where = "DATA";
    if (!found.n) reader.fail("must give n (got k only)");
    if (!found.k) reader.notes.emplace_back("no k in the file: k = 0");
    return material_of(name, *std::move(found.n), std::move(found.k), std::move(reader.notes),
                       std::move(source));
}

}  // namespace

MaterialFile read_refractiveindex_info(std::string_view text, const std::string& name) {
    try {
        return material_in(YAML::Load(std::string(text)), name);
    } catch (const YAML::Exception& error) {
        const std::string where = error.mark.is_null() ? std::string()
                                                       : std::to_string(error.mark.line + 1) + ":" +
                                                             std::to_string(error.mark.column + 1);
        throw InputError(name, where, "is not YAML: " + error.msg);
    }
}

}  // namespace irido::schemas
