#include "schemas/readers/materials/openfilters_material.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"

namespace irido::schemas {

namespace {

/// The value of a line "Keyword: value"; empty for any other line.
std::optional<std::string_view> value_after(std::string_view keyword, std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with(keyword)) return std::nullopt;
    line.remove_prefix(keyword.size());
    if (!line.starts_with(':')) return std::nullopt;
    return trimmed(line.substr(1));
}

bool is_end(std::string_view line) {
    line = trimmed(line);
    return line.size() == 3 && (line[0] | 0x20) == 'e' && (line[1] | 0x20) == 'n' &&
           (line[2] | 0x20) == 'd';
}

/// The contents of "Properties:".
struct OpenFiltersMaterial {
    std::string kind, model;
    TextLine properties;         ///< its line
    std::string_view value;      ///< on that line
    std::vector<TextLine> rows;  ///< between it and End
};

OpenFiltersMaterial parse_material(const std::vector<TextLine>& lines, const std::string& name) {
    OpenFiltersMaterial material;
    bool is_inside = false, has_properties = false;
    for (const TextLine& line : lines) {
        if (is_inside) {
            is_inside = !is_end(line.text);
            if (is_inside && !trimmed(line.text).empty()) material.rows.push_back(line);
        } else if (const auto kind = value_after("Kind", line.text)) {
            material.kind = *kind;
        } else if (const auto model = value_after("Model", line.text)) {
            material.model = *model;
        } else if (const auto value = value_after("Properties", line.text)) {
            material.properties = line;
            material.value = *value;
            has_properties = true;
            is_inside = value->empty();
        }
    }
    if (!has_properties) throw InputError(name, "", "must have Properties");
    if (is_inside)
        throw InputError(name, place_of(material.properties, material.properties.text),
                         "the block Properties has no End");
    return material;
}

[[noreturn]] void fail_at(const std::string& name, const TextLine& line, std::string_view part,
                          const std::string& message) {
    throw InputError(name, place_of(line, part), message);
}

/// n + ik of "2.4-0.01j", with irido's sign of k.
std::pair<double, double> index_of(const std::string& name, const TextLine& line,
                                   std::string_view text) {
    if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
    const nlohmann::json index = parse_index(text);
    if (index.is_null())
        fail_at(name, line, text,
                "must be an index such as 2.4-0.01j (got " + in_quotes(text) + ")");
    if (index.is_number()) return {index.get<double>(), 0};
    const double k = -index["k"].get<double>();
    return {index["n"].get<double>(), k == 0 ? 0 : k};
}

MaterialFile table_of(const OpenFiltersMaterial& read, const std::string& name) {
    std::vector<IndexRow> rows;
    std::vector<std::string> notes;
    for (const TextLine& line : read.rows) {
        const std::string_view text = trimmed(line.text);
        const std::string_view word = text.substr(0, text.find_first_of(" \t"));
        const auto wavelength = parse_number(word);
        if (!wavelength || !(*wavelength > 0))
            fail_at(name, line, word, "must be a wavelength above 0 (got " + in_quotes(word) + ")");
        const auto [n, k] = index_of(name, line, trimmed(text.substr(word.size())));
        rows.push_back({*wavelength, n, k});
    }
    if (rows.empty()) throw InputError(name, "", "the table has no rows");
    constexpr double kLargestUm = 50;
    const bool is_um =
        std::ranges::all_of(rows, [](const IndexRow& row) { return row[0] < kLargestUm; });
    if (is_um) {
        for (IndexRow& row : rows) row[0] = to_nm(row[0], SpectralUnit::um);
        notes.emplace_back("wavelengths below 50 are taken as um");
    }
    put_in_order(rows, "the table: ", notes);
    if (rows.size() > 2)
        notes.emplace_back("linear between the rows, where OpenFilters has monotone cubics");
    const bool is_real = std::ranges::all_of(rows, [](const IndexRow& row) { return row[2] == 0; });
    return material_of(name, column(rows, 1),
                       is_real ? std::nullopt : std::optional(column(rows, 2)), std::move(notes));
}

/// k = A exp(12400 B (1/(10000 L) - 1/C)), L in um, C in angstroms, as a table.
std::optional<Table> urbach_tail(std::span<const double> numbers, std::vector<std::string>& notes) {
    if (numbers.size() < 3 || numbers[0] == 0) return std::nullopt;
    constexpr double kFirst_nm = 200, kLast_nm = 20000, kMost_k = 100, kStep = 1.001;
    Table k;
    for (double nm = kFirst_nm; nm <= kLast_nm; nm *= kStep) {
        const double value =
            numbers[0] * std::exp(12400 * numbers[1] * (1 / (10 * nm) - 1 / numbers[2]));
        if (!(std::abs(value) <= kMost_k)) continue;
        k.wavelength_nm.push_back(nm);
        k.value.push_back(value);
    }
    notes.emplace_back("its Urbach tail is a table of k from 200 nm to 20 um");
    if (k.value.empty()) return std::nullopt;
    return k;
}

MaterialFile formula_of(const OpenFiltersMaterial& read, const std::string& name) {
    std::vector<double> numbers;
    std::string text(read.value);
    for (const TextLine& line : read.rows) text += " " + std::string(line.text);
    std::string_view rest = trimmed(text);
    while (!rest.empty()) {
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
        const auto number = parse_number(word);
        if (!number)
            fail_at(name, read.properties, read.properties.text,
                    "must be a number (got " + in_quotes(word) + ")");
        numbers.push_back(*number);
        rest = trimmed(rest.substr(word.size()));
    }
    const bool is_cauchy = read.model == "Cauchy";
    const std::size_t of_n = is_cauchy ? 3 : 6;
    if (numbers.size() != of_n && numbers.size() != of_n + 3)
        fail_at(name, read.properties, read.properties.text,
                read.model + " must have " + std::to_string(of_n) + " or " +
                    std::to_string(of_n + 3) + " numbers (got " + std::to_string(numbers.size()) +
                    ")");
    std::vector<std::string> notes;
    Formula formula{is_cauchy ? 5 : 2, {}, kAllWavelengths};
    if (is_cauchy) {
        formula.coefficients = {numbers[0], numbers[1], -2, numbers[2], -4};
    } else {
        formula.coefficients = {0};
        formula.coefficients.insert(formula.coefficients.end(), numbers.begin(),
                                    numbers.begin() + 6);
    }
    auto k = urbach_tail(std::span(numbers).subspan(of_n), notes);
    return material_of(name, std::move(formula), std::move(k), std::move(notes));
}

}  // namespace

bool is_openfilters_material(std::string_view text) {
    bool has_kind = false, has_model = false;
    for (const TextLine& line : lines_of(text.substr(0, 4096))) {
        has_kind = has_kind || value_after("Kind", line.text);
        has_model = has_model || value_after("Model", line.text);
    }
    return has_kind && has_model;
}

MaterialFile read_openfilters_material(std::string_view text, const std::string& name) {
    const std::vector<TextLine> lines = lines_of(text);
    const OpenFiltersMaterial read = parse_material(lines, name);
    if (read.kind != "regular")
        throw InputError(name, "", "Kind must be regular (got " + in_quotes(read.kind) + ")");
    if (read.model == "table") return table_of(read, name);
    if (read.model == "Cauchy" || read.model == "Sellmeier") return formula_of(read, name);
    if (read.model != "constant")
        throw InputError(name, "",
                         "Model must be constant, table, Cauchy or Sellmeier (got " +
                             in_quotes(read.model) + ")");
    const std::string_view value =
        read.value.empty() && !read.rows.empty() ? trimmed(read.rows.front().text) : read.value;
    const auto [n, k] = index_of(name, read.properties, value);
    return {Material{name, RefractiveIndex{Constant{n}, Constant{k}}}, {}, ""};
}

}  // namespace irido::schemas
