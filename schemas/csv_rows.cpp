#include "schemas/csv_rows.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/number.hpp"

namespace irido {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// One line of the text, without its end and its comment.
struct Line {
    const std::string& file;
    std::size_t number;
    std::string_view text;

    std::string place_of(std::string_view part) const {
        return std::to_string(number) + ":" + std::to_string(part.data() - text.data() + 1);
    }

    [[noreturn]] void fail(std::string_view part, const std::string& message) const {
        throw InputError(file, place_of(part), message);
    }
};

std::vector<std::string_view> fields_of(std::string_view text) {
    std::vector<std::string_view> fields;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        const std::string_view field = text.substr(start, end - start);
        const std::string_view content = trimmed(field);
        fields.push_back(content.empty() ? field.substr(0, 0) : content);
        start = end + 1;
    }
    return fields;
}

bool is_header(const std::vector<std::string_view>& fields) {
    return std::none_of(fields.begin(), fields.end(), [](std::string_view field) {
        return field.empty() || parse_number(field).has_value();
    });
}

std::vector<double> numbers_of(const Line& line, const std::vector<std::string_view>& fields) {
    std::vector<double> values;
    values.reserve(fields.size());
    for (const std::string_view field : fields) {
        const auto value = parse_number(field);
        if (!value) line.fail(field, "must be a number (got " + in_quotes(field) + ")");
        values.push_back(*value);
    }
    return values;
}

std::string count_rule(std::size_t fewest, std::size_t most) {
    return fewest == most ? std::to_string(fewest)
                          : std::to_string(fewest) + " to " + std::to_string(most);
}

void check_wavelength(const Line& line, std::string_view field, double nm, double previous_nm) {
    if (!(nm >= kAllWavelengths.first_nm && nm <= kAllWavelengths.last_nm))
        line.fail(field, "wavelength_nm must be in [" + to_text(kAllWavelengths.first_nm) + ", " +
                             to_text(kAllWavelengths.last_nm) + "] (got " + to_text(nm) + ")");
    if (!(nm > previous_nm))
        line.fail(field, "wavelengths must increase strictly (got " + to_text(nm) + " after " +
                             to_text(previous_nm) + ")");
}

}  // namespace

std::vector<CsvRow> read_csv_rows(std::string_view text, const std::string& name,
                                  std::size_t fewest, std::size_t most) {
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    std::vector<CsvRow> rows;
    bool header_seen = false;
    std::size_t number = 0;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        const std::string_view whole = text.substr(start, end - start);
        start = end + 1;
        const Line line{name, ++number, whole.substr(0, whole.find('#'))};
        if (trimmed(line.text).empty()) continue;
        const auto fields = fields_of(line.text);
        if (rows.empty() && !header_seen && is_header(fields)) {
            header_seen = true;
            continue;
        }
        CsvRow row{line.place_of(fields.back()), numbers_of(line, fields)};
        const std::size_t count = row.values.size();
        if (count < fewest || count > most || (!rows.empty() && count != rows[0].values.size()))
            line.fail(line.text, "must have " +
                                     (rows.empty() ? count_rule(fewest, most)
                                                   : std::to_string(rows[0].values.size())) +
                                     " columns (got " + std::to_string(count) + ")");
        check_wavelength(line, fields[0], row.values[0], rows.empty() ? 0 : rows.back().values[0]);
        rows.push_back(std::move(row));
    }
    if (rows.empty()) throw InputError(name, "", "has no rows");
    return rows;
}

Table table_of(const std::vector<CsvRow>& rows, std::size_t index) {
    Table table;
    table.wavelength_nm.reserve(rows.size());
    table.value.reserve(rows.size());
    for (const CsvRow& row : rows) {
        table.wavelength_nm.push_back(row.values[0]);
        table.value.push_back(row.values[index]);
    }
    return table;
}

}  // namespace irido
