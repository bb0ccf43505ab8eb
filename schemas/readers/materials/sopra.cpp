#include "schemas/readers/materials/sopra.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

constexpr std::array kUnitsByCode{SpectralUnit::ev, SpectralUnit::um, SpectralUnit::per_cm,
                                  SpectralUnit::nm};

/// The numbers at the beginning of a line, separated by blanks, semicolons or commas.
std::vector<double> leading_numbers(std::string_view line) {
    constexpr std::string_view kBetween = " \t;,\r";
    std::vector<double> numbers;
    while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(kBetween), line.size()));
        const std::string_view word = line.substr(0, line.find_first_of(kBetween));
        const auto number = parse_number(word);
        if (!number) return numbers;
        numbers.push_back(*number);
        line.remove_prefix(word.size());
    }
}

std::vector<double> first_line(const std::vector<TextLine>& lines) {
    for (const TextLine& line : lines)
        if (!trimmed(line.text).empty()) return leading_numbers(line.text);
    return {};
}

bool is_whole(double value, double lowest, double highest) {
    return value >= lowest && value <= highest && value == std::floor(value);
}

/// The numbers of all lines up to the first that does not begin with a number.
std::vector<double> numbers_of(const std::vector<TextLine>& lines) {
    std::vector<double> numbers;
    for (const TextLine& line : lines) {
        if (trimmed(line.text).empty()) continue;
        const std::vector<double> some = leading_numbers(line.text);
        if (some.empty()) break;
        numbers.insert(numbers.end(), some.begin(), some.end());
    }
    return numbers;
}

MaterialFile material_of_rows(std::vector<IndexRow> rows, const std::string& name,
                              std::vector<std::string> notes) {
    put_in_order(rows, "", notes);
    make_k_positive(rows, name, notes);
    return material_of(name, column(rows, 1), column(rows, 2), std::move(notes));
}

/// The fields of a line, each of which ends in *.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t end = line.find('*'); end != std::string_view::npos; end = line.find('*')) {
        fields.push_back(trimmed(line.substr(0, end)));
        line.remove_prefix(end + 1);
    }
    return fields;
}

}  // namespace

bool is_sopra_nk(std::string_view text) {
    const std::vector<double> first = first_line(lines_of(text.substr(0, 4096)));
    return first.size() == 4 && is_whole(first[0], 1, 4) && is_whole(first[3], 1, 1e6) &&
           first[1] > 0 && first[2] > 0 && first[1] != first[2];
}

MaterialFile read_sopra_nk(std::string_view text, const std::string& name) {
    const std::vector<double> numbers = numbers_of(lines_of(text));
    const SpectralUnit unit = kUnitsByCode[static_cast<std::size_t>(numbers[0]) - 1];
    const double first = numbers[1], last = numbers[2], intervals = numbers[3];
    const auto points = static_cast<std::size_t>(intervals) + 1;
    if (numbers.size() != 4 + 2 * points) {
        const std::string got = to_text(static_cast<double>(numbers.size() - 4) / 2);
        throw InputError(name, "",
                         "must have " + std::to_string(points) + " pairs n k for " +
                             to_text(intervals) + " intervals (got " + got + ")");
    }
    std::vector<IndexRow> rows;
    for (std::size_t i = 0; i < points; ++i) {
        const double value = first + (last - first) * static_cast<double>(i) / intervals;
        rows.push_back({to_nm(value, unit), numbers[4 + 2 * i], numbers[5 + 2 * i]});
    }
    if (rows.front()[0] > rows.back()[0]) std::ranges::reverse(rows);
    return material_of_rows(std::move(rows), name, {});
}

bool is_sopra_mat(std::string_view text) {
    const std::vector<TextLine> lines = lines_of(text.substr(0, 4096));
    return !lines.empty() && trimmed(lines[0].text).starts_with("VERSION*");
}

MaterialFile read_sopra_mat(std::string_view text, const std::string& name) {
    std::vector<IndexRow> rows;
    std::optional<double> points;
    for (const TextLine& line : lines_of(text)) {
        const auto fields = fields_of(line.text);
        if (fields.size() < 2) continue;
        if (fields[0] == "POINTS") points = parse_number(fields[1]);
        if (!fields[0].starts_with("DATA")) continue;
        IndexRow row{};
        for (std::size_t v = 0; v < row.size(); ++v) {
            const std::string_view field = v + 2 < fields.size() ? fields[v + 2] : fields[0];
            const auto number = parse_number(field);
            if (fields[0] != "DATA1" || fields.size() != 5 || !number || (v == 0 && *number <= 0))
                throw InputError(name, place_of(line, fields[0]),
                                 "must be DATA1*number*nm*n*k* (got " + in_quotes(line.text) + ")");
            row[v] = *number;
        }
        rows.push_back(row);
    }
    if (rows.empty()) throw InputError(name, "", "has no lines DATA1*number*nm*n*k*");
    if (points != static_cast<double>(rows.size()))
        throw InputError(name, "",
                         "must have as many lines DATA1 as POINTS says, " +
                             (points ? to_text(*points) : "nothing") + " (got " +
                             std::to_string(rows.size()) + ")");
    return material_of_rows(std::move(rows), name, {});
}

}  // namespace irido::schemas
