#include "schemas/readers/column_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {

namespace {

constexpr std::array kSeparators{';', '\t', ',', ' '};

using Cells = std::vector<std::string_view>;

std::string_view unquoted(std::string_view cell) {
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
        return trimmed(cell.substr(1, cell.size() - 2));
    return cell;
}

/// The trimmed cells of a line; separators inside quotes do not count, and consecutive blanks are
/// one separator.
Cells cells_of(std::string_view line, char separator) {
    Cells cells;
    const auto ends = [&](char c) { return c == separator || (separator == ' ' && c == '\t'); };
    for (std::size_t start = 0; start <= line.size();) {
        bool quoted = false;
        std::size_t end = start;
        for (; end < line.size() && (quoted || !ends(line[end])); ++end)
            if (line[end] == '"') quoted = !quoted;
        const std::string_view cell = line.substr(start, end - start);
        const std::string_view content = trimmed(cell);
        if (separator != ' ' || !content.empty())
            cells.push_back(unquoted(content.empty() ? cell.substr(0, 0) : content));
        start = end + 1;
    }
    while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
    return cells;
}

/// A number, possibly with a decimal comma.
std::optional<double> number_of(std::string_view cell) {
    const std::size_t comma = cell.find(',');
    if (comma == std::string_view::npos) return parse_number(cell);
    if (cell.find_first_of(".,", comma + 1) != std::string_view::npos ||
        cell.find('.') != std::string_view::npos)
        return std::nullopt;
    std::string text(cell);
    text[comma] = '.';
    return parse_number(text);
}

bool are_numbers(const Cells& cells) {
    return cells.size() > 1 &&
           std::ranges::all_of(cells, [](auto cell) { return number_of(cell).has_value(); });
}

/// A line without its comment, or the text of a comment.
struct Line {
    TextLine whole;
    std::string_view text;
    bool is_comment = false;
};

Line without_comment(const TextLine& line) {
    std::string_view text = trimmed(line.text);
    const bool is_comment = text.starts_with("//") || text.find_first_of("#;!%") == 0;
    if (!is_comment) return {line, line.text.substr(0, line.text.find('#')), false};
    const std::size_t first = text.find_first_not_of("#;!%/ \t");
    return {line, first == std::string_view::npos ? text.substr(0, 0) : text.substr(first), true};
}

/// The separator that splits the line into numbers, if there is one.
std::optional<char> separator_of(std::string_view line) {
    for (const char separator : kSeparators)
        if (are_numbers(cells_of(line, separator))) return separator;
    return std::nullopt;
}

/// The separator of a line that is not a row: the first one that occurs.
char likely_separator(std::string_view line) {
    for (const char separator : {';', '\t', ','})
        if (line.find(separator) != std::string_view::npos) return separator;
    return ' ';
}

}  // namespace

std::vector<std::string> column_names(std::string_view line, char separator) {
    std::vector<std::string> names;
    for (const std::string_view cell : cells_of(line, separator)) {
        const bool continues = separator == ' ' && !names.empty() && !cell.empty() &&
                               (cell[0] == '(' || cell[0] == '[' || cell[0] == '/');
        if (continues)
            names.back() += " " + std::string(cell);
        else
            names.emplace_back(cell);
    }
    return names;
}

namespace {

class TextReader {
public:
    TextReader(std::span<const TextLine> lines, const std::string& name, const ColumnNames& names)
        : name_(name), names_(names) {
        for (const TextLine& line : lines) {
            lines_.push_back(without_comment(line));
            if (trimmed(lines_.back().text).empty()) lines_.pop_back();
        }
    }

    ColumnText read() {
        ColumnText table;
        const auto first = std::ranges::find_if(lines_, [](const Line& line) {
            return !line.is_comment && separator_of(line.text).has_value();
        });
        for (auto line = lines_.begin(); line != first; ++line) {
            table.has_semicolon_comments |= line->is_comment && trimmed(line->whole.text)[0] == ';';
            if (!line->is_comment) require_no_row(*line);
        }
        if (first == lines_.end()) fail_without_rows();
        separator_ = *separator_of(first->text);
        const std::span<const Line> above{lines_.begin(), first};
        for (auto line = first; line != lines_.end(); ++line)
            if (!line->is_comment) table.rows.push_back(row(*line));
        require_count(table.rows, above);
        require_one_point(table.rows);
        table.header = header(above, table.rows[0].values.size());
        return table;
    }

private:
    [[noreturn]] void fail(const TextLine& line, std::string_view part,
                           const std::string& message) const {
        throw InputError(name_, place_of(line, part), message);
    }

    [[noreturn]] void fail_without_rows() const {
        throw InputError(name_, "",
                         "has no rows of numbers; known columns: " + names_.known + names_.others);
    }

    /// A line that begins with a number was probably meant as a row.
    void require_no_row(const Line& line) const {
        const Cells cells = cells_of(line.text, likely_separator(line.text));
        if (!number_of(cells[0])) return;
        for (const std::string_view cell : cells)
            if (!number_of(cell))
                fail(line.whole, cell, "must be a number (got " + in_quotes(cell) + ")");
        fail(line.whole, cells[0], "must have " + count_rule() + " columns (got 1)");
    }

    std::string count_rule() const {
        return names_.fewest == names_.most
                   ? std::to_string(names_.fewest)
                   : std::to_string(names_.fewest) + " to " + std::to_string(names_.most);
    }

    ColumnRow row(const Line& line) const {
        ColumnRow row{line.whole, {}, cells_of(line.text, separator_)};
        for (const std::string_view cell : row.cells) {
            const auto value = number_of(cell);
            if (!value) fail(line.whole, cell, "must be a number (got " + in_quotes(cell) + ")");
            row.values.push_back(*value);
        }
        return row;
    }

    /// Number of columns that all rows have, or else a heading names, or else most rows have.
    std::size_t likely_count(const std::vector<ColumnRow>& rows,
                             std::span<const Line> above) const {
        std::map<std::size_t, std::size_t> rows_of;
        for (const ColumnRow& row : rows) ++rows_of[row.values.size()];
        if (rows_of.size() == 1) return rows_of.begin()->first;
        for (std::size_t count = names_.fewest; count <= names_.most; ++count)
            for (const Line& line : above)
                if (!header_in(line, count).empty()) return count;
        std::size_t likely = rows.front().values.size();
        for (const auto& [count, times] : rows_of)
            if (times > rows_of[likely]) likely = count;
        return likely;
    }

    /// Requires equally many columns in all rows; blames those that differ from the others.
    void require_count(const std::vector<ColumnRow>& rows, std::span<const Line> above) const {
        const std::size_t count = likely_count(rows, above);
        const bool is_possible = count >= names_.fewest && count <= names_.most;
        for (const ColumnRow& row : rows)
            if (row.values.size() != count || !is_possible)
                fail(row.line, row.cells[0],
                     "must have " + (is_possible ? std::to_string(count) : count_rule()) +
                         " columns (got " + std::to_string(row.values.size()) + ")");
    }

    /// "1,234;1.5" has either a thousands separator or two kinds of decimal point.
    void require_one_point(const std::vector<ColumnRow>& rows) const {
        bool comma = false, point = false;
        for (const ColumnRow& row : rows)
            for (const std::string_view cell : row.cells) {
                comma |= cell.find(',') != std::string_view::npos;
                point |= cell.find('.') != std::string_view::npos;
                if (comma && point)
                    fail(row.line, cell,
                         "numbers must have decimal points or decimal commas, not both (got " +
                             in_quotes(cell) + ")");
            }
    }

    bool are_names(const std::vector<std::string>& names, std::size_t count) const {
        return names.size() == count && names_.are(names);
    }

    /// The names in a line above the first row, split at the rows' separator or at one of its own.
    std::vector<std::string> header_in(const Line& line, std::size_t count) const {
        for (const char separator : {separator_, likely_separator(line.text), ' '})
            if (auto names = column_names(line.text, separator); are_names(names, count))
                return names;
        return {};
    }

    std::vector<std::string> header(std::span<const Line> above, std::size_t count) const {
        std::vector<std::string> found;
        std::size_t place = 0;
        const Line* unknown = nullptr;
        for (std::size_t i = 0; i < above.size(); ++i) {
            if (auto names = header_in(above[i], count); !names.empty()) {
                found = std::move(names);
                place = i;
            } else if (!above[i].is_comment && unknown == nullptr) {
                unknown = &above[i];
            }
        }
        if (!found.empty()) return with_units(std::move(found), above.subspan(place + 1));
        if (unknown == nullptr) return {};
        fail(unknown->whole, trimmed(unknown->text),
             "must name known columns, " + std::to_string(count) + " of: " + names_.known +
                 " (got " + in_quotes(trimmed(unknown->text)) + "; other lines must begin with #)");
    }

    /// Appends a line of units directly below the names to these.
    std::vector<std::string> with_units(std::vector<std::string> names,
                                        std::span<const Line> below) const {
        if (below.empty() || below[0].is_comment) return names;
        const std::vector<std::string> units = column_names(below[0].text, separator_);
        std::vector<std::string> both = names;
        for (std::size_t c = 0; c < std::min(units.size(), names.size()); ++c)
            both[c] += " " + units[c];
        return units.size() <= names.size() && names_.are(both) ? both : names;
    }

    const std::string& name_;
    const ColumnNames& names_;
    std::vector<Line> lines_;  ///< those that are not blank
    char separator_ = ',';
};

}  // namespace

double shifted(double value, int power) {
    std::array<char, 40> text{};
    char* end =
        std::to_chars(text.data(), text.data() + 32, value, std::chars_format::scientific).ptr;
    char* const exponent = std::find(text.data(), end, 'e') + 1;
    int before = 0;
    std::from_chars(exponent + (*exponent == '+' ? 1 : 0), end, before);
    end = std::to_chars(exponent, text.data() + text.size(), before + power).ptr;
    return parse_number({text.data(), end}).value_or(value);
}

namespace {

using Spelling = std::pair<std::string_view, std::string_view>;

/// Spellings in column names that are not ASCII, or that stand for more than a letter.
constexpr std::array kSpellings{
    Spelling{"\u00B5", "u"},        Spelling{"\u03BC", "u"},   Spelling{"\u00C5", "angstrom"},
    Spelling{"\u212B", "angstrom"}, Spelling{"\u00E5", "a"},   Spelling{"\u00F6", "o"},
    Spelling{"\u03BB", "lambda"},   Spelling{"\u03B5", "eps"}, Spelling{"\u03BA", "kappa"},
    Spelling{"\u207B\u00B9", "-1"}, Spelling{"\u2081", "1"},   Spelling{"\u2082", "2"},
    Spelling{"\u2212", "-"},        Spelling{"^", ""},         Spelling{"1/cm", "cm-1"},
    Spelling{"epsilon", "eps"}};

struct UnitName {
    std::string_view name;
    SpectralUnit unit;
};

constexpr std::array kUnits{
    UnitName{"nm", SpectralUnit::nm},
    UnitName{"nanometers", SpectralUnit::nm},
    UnitName{"nanometres", SpectralUnit::nm},
    UnitName{"um", SpectralUnit::um},
    UnitName{"micron", SpectralUnit::um},
    UnitName{"microns", SpectralUnit::um},
    UnitName{"micrometers", SpectralUnit::um},
    UnitName{"micrometres", SpectralUnit::um},
    UnitName{"angstrom", SpectralUnit::angstrom},
    UnitName{"angstroms", SpectralUnit::angstrom},
    UnitName{"a", SpectralUnit::angstrom},
    UnitName{"ev", SpectralUnit::ev},
    UnitName{"cm-1", SpectralUnit::per_cm},
};

constexpr std::array<std::string_view, 5> kWavelengthWords{"wavelength", "wavelengths", "wl",
                                                           "lambda", "vacuum"};
constexpr std::array<std::string_view, 5> kEnergyWords{"energy", "e", "photon", "hv", "energies"};
constexpr std::array<std::string_view, 2> kWavenumberWords{"wavenumber", "wavenumbers"};

template <class Words>
bool holds(const Words& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

/// Words that fit a unit.
bool goes_with(std::string_view word, SpectralUnit unit) {
    if (unit == SpectralUnit::ev) return holds(kEnergyWords, word);
    if (unit == SpectralUnit::per_cm) return holds(kWavenumberWords, word);
    return holds(kWavelengthWords, word);
}

}  // namespace

std::vector<TextLine> lines_of(std::string_view text) {
    text = without_byte_order_mark(text);
    std::vector<TextLine> lines;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
        lines.push_back({lines.size() + 1, text.substr(start, end - start)});
        start = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    }
    return lines;
}

std::string place_of(const TextLine& line, std::string_view part) {
    return std::to_string(line.number) + ":" + std::to_string(part.data() - line.text.data() + 1);
}

ColumnText read_columns(std::span<const TextLine> lines, const std::string& name,
                        const ColumnNames& names) {
    return TextReader(lines, name, names).read();
}

std::string plain_words(std::string_view column) {
    std::string text(column);
    for (const auto& [from, to] : kSpellings)
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        if (std::string_view("_()[]/,:=\t").find(c) != std::string_view::npos) c = ' ';
    }
    std::istringstream words(text);
    std::string plain;
    for (std::string word; words >> word;)
        if (word != "-") plain += (plain.empty() ? "" : " ") + word;
    return plain;
}

std::optional<SpectralColumn> spectral_column(std::string_view column) {
    std::istringstream words(plain_words(column));
    SpectralColumn found;
    std::vector<std::string> others;
    for (std::string word; words >> word;) {
        const auto named = std::ranges::find(kUnits, word, &UnitName::name);
        if (named == kUnits.end())
            others.push_back(word);
        else if (std::exchange(found.unit, named->unit))
            return std::nullopt;
    }
    const bool is_letter = column == "A" || column == "a";
    const SpectralUnit unit = found.unit.value_or(SpectralUnit::nm);
    const bool fits =
        std::ranges::all_of(others, [&](const auto& word) { return goes_with(word, unit); });
    if (!fits || is_letter || (others.empty() && !found.unit)) return std::nullopt;
    return found;
}

double to_nm(double value, SpectralUnit unit) {
    switch (unit) {
        case SpectralUnit::um:
            return shifted(value, 3);
        case SpectralUnit::angstrom:
            return shifted(value, -1);
        case SpectralUnit::ev:
            return kPhotonEnergy_eVnm / value;
        case SpectralUnit::per_cm:
            return 1e7 / value;
        case SpectralUnit::nm:
            break;
    }
    return value;
}

void require_nm(const ColumnText& table, std::size_t column, const std::string& name,
                std::string_view values) {
    constexpr double kShortest_nm = 50;
    double first = table.rows[0].values[column], last = first;
    for (const ColumnRow& row : table.rows) {
        first = std::min(first, row.values[column]);
        last = std::max(last, row.values[column]);
    }
    if (last >= kShortest_nm || first <= 0) return;
    throw InputError(name, "",
                     "wavelengths must be in nm unless a header says otherwise; " + to_text(first) +
                         " to " + to_text(last) +
                         " looks like um or eV (then add a header such as um," +
                         std::string(values) + ")");
}

}  // namespace irido::schemas
