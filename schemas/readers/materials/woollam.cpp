#include "schemas/readers/materials/woollam.hpp"

#include <algorithm>

#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/materials/column_file.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

bool is_word(std::string_view text) {
    return !text.empty() && !parse_number(text) &&
           text.find_first_of(" \t,;:|*\"(") == std::string_view::npos;
}

}  // namespace

bool is_woollam_mat(std::string_view text) {
    const std::vector<TextLine> lines = lines_of(text.substr(0, 4096));
    if (lines.size() < 3 || !is_word(trimmed(lines[1].text)) || !is_word(trimmed(lines[2].text)))
        return false;
    const auto unit = spectral_column(trimmed(lines[1].text));
    return unit && unit->unit;
}

MaterialFile read_woollam_mat(std::string_view text, const std::string& name) {
    const std::vector<TextLine> lines = lines_of(text);
    const std::string unit(trimmed(lines[1].text)), kind(trimmed(lines[2].text));
    const std::string words = plain_words(kind);
    if (words != "nk" && words != "e1e2")
        throw InputError(name, place_of(lines[2], lines[2].text),
                         "must be NK or E1E2 (got " + in_quotes(kind) + ", parameters of a model)");
    const bool is_nk = words == "nk";
    const ColumnNames names{[](const std::vector<std::string>&) { return false; },
                            "the unit's, " + std::string(is_nk ? "n and k" : "eps1 and eps2"), 3,
                            3};
    const ColumnText table = read_columns(std::span(lines).subspan(3), name, names);
    return material_of_columns(table, {unit, is_nk ? "n" : "eps1", is_nk ? "k" : "eps2"}, name);
}

}  // namespace irido::schemas
