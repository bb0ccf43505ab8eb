#include "schemas/readers/materials/refractiveindex_csv.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

bool starts_block(const TextLine& line) {
    const std::string words = plain_words(line.text);
    return words == "wl n" || words == "wl k" || words == "wl n k";
}

bool are_block_columns(const std::vector<std::string>& header) {
    return plain_words(header[0]) == "wl" &&
           std::ranges::all_of(header.begin() + 1, header.end(), [](const std::string& name) {
               return plain_words(name) == "n" || plain_words(name) == "k";
           });
}

/// The sorted rows of a block, in nm.
std::vector<IndexRow> rows_of(const ColumnText& block, const std::string& name,
                              std::vector<std::string>& notes) {
    constexpr double kLongest_um = 100;  // nm below a header that claims um
    std::vector<IndexRow> rows;
    for (const ColumnRow& row : block.rows) {
        const double um = row.values[0];
        if (!(um > 0))
            throw InputError(name, place_of(row.line, row.cells[0]),
                             "the wavelength must be positive (got " + to_text(um) + ")");
        rows.push_back({to_nm(um, SpectralUnit::um), row.values[1],
                        row.values.size() > 2 ? row.values[2] : 0});
    }
    put_in_order(rows, "", notes);
    if (rows.front()[0] >= 1000 * kLongest_um)
        throw InputError(name, "",
                         "wl is in um, but " + to_text(rows.front()[0] / 1000) +
                             " and more looks like nm (then use a header nm,n,k)");
    return rows;
}

Table without_noise(Table k, std::vector<std::string>& notes) {
    std::size_t negative = 0;
    for (double& value : k.value)
        if (value < 0) {
            value = 0;
            ++negative;
        }
    if (negative > 0) notes.push_back("k < 0 set to 0 in " + plural(negative, "row"));
    return k;
}

}  // namespace

bool is_refractiveindex_csv(std::string_view text) {
    for (const TextLine& line : lines_of(text.substr(0, 4096)))
        if (!trimmed(line.text).empty()) return starts_block(line);
    return false;
}

MaterialFile read_refractiveindex_csv(std::string_view text, const std::string& name) {
    const std::vector<TextLine> lines = lines_of(text);
    const ColumnNames names{are_block_columns, "wl, n and k"};
    std::vector<std::string> notes;
    std::optional<Table> n, k;
    for (auto start = std::ranges::find_if(lines, starts_block); start != lines.end();) {
        const auto end = std::find_if(start + 1, lines.end(), starts_block);
        const ColumnText block = read_columns({start, end}, name, names);
        const std::vector<IndexRow> rows = rows_of(block, name, notes);
        for (std::size_t c = 1; c < block.header.size(); ++c) {
            const bool is_n = plain_words(block.header[c]) == "n";
            std::optional<Table>& table = is_n ? n : k;
            if (table)
                throw InputError(name, place_of(*start, start->text),
                                 block.header[c] + " is given twice");
            table = is_n ? column(rows, c) : without_noise(column(rows, c), notes);
        }
        start = end;
    }
    if (!n) throw InputError(name, "", "must give n (got k only)");
    if (!k) notes.emplace_back("no k in the file: k = 0");
    return material_of(name, *std::move(n), std::move(k), std::move(notes));
}

}  // namespace irido::schemas
