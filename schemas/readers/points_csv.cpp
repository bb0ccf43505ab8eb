#include "schemas/readers/points_csv.hpp"

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <set>

#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::schemas {

namespace {

/// Whether a text that we do not accept as a number was meant as one: nan, inf, 1e999.
bool is_unusable_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const char* const end = text.data() + text.size();
    return std::from_chars(text.data(), end, value).ptr == end && !text.empty();
}

/// The rows of a CSV text, one after the other.
class Rows {
public:
    struct Cell {
        std::string_view text;  ///< valid until the next row is read
        std::size_t at = 0;     ///< offset in the file's text
    };

    Rows(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    /// The cells of the next row that is not blank; false if there is none.
    bool next(std::vector<Cell>& cells) {
        cells.clear();
        unquoted_.clear();
        while (at_ < text_.size()) {
            start_ = at_;
            do cells.push_back(cell());
            while (take(','));
            take('\n');
            if (cells.size() > 1 || !cells[0].text.empty() || is_quote(cells[0].at)) return true;
            cells.clear();
        }
        return false;
    }

    /// Where the last row read begins.
    std::size_t start() const { return start_; }

    [[noreturn]] void fail(std::size_t at, const std::string& message) const {
        throw InputError(name_, line_and_column(text_, at), message);
    }

private:
    bool is_quote(std::size_t at) const { return at < text_.size() && text_[at] == '"'; }

    bool take(char mark) {
        if (at_ == text_.size() || text_[at_] != mark) return false;
        ++at_;
        return true;
    }

    /// Takes the text up to the next comma or line end, trimmed.
    std::string_view take_plain() {
        const std::size_t from = at_;
        while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') ++at_;
        return trimmed(text_.substr(from, at_ - from));
    }

    Cell cell() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        Cell result{{}, at_};
        if (take('"')) {
            result.text = quoted_text(result.at);
            const std::size_t after = at_;
            if (!take_plain().empty())
                fail(after, "a closing quote must be followed by a comma or the end of the line");
            return result;
        }
        result.text = take_plain();
        if (const std::size_t quote = result.text.find('"'); quote != std::string_view::npos)
            fail(result.at + quote,
                 "a cell that contains quotes must be quoted, with its quotes doubled (got " +
                     in_quotes(result.text) + ")");
        return result;
    }

    /// The text inside quotes, after the opening one has been taken.
    std::string_view quoted_text(std::size_t opening) {
        std::string* whole = nullptr;  // if it has more than one part
        for (;;) {
            const std::size_t end = text_.find('"', at_);
            if (end == std::string_view::npos) fail(opening, "the quote is never closed");
            const std::string_view part = text_.substr(at_, end - at_);
            at_ = end + 1;
            const bool is_doubled = take('"');
            if (whole == nullptr && !is_doubled) return part;
            if (whole == nullptr) whole = &unquoted_.emplace_back();
            *whole += part;
            if (!is_doubled) return *whole;
            *whole += '"';
        }
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0, start_ = 0;
    std::deque<std::string> unquoted_;  ///< texts of cells that are spelt differently in the file
};

using PlacedCells = std::vector<Rows::Cell>;

std::vector<PointsColumn> read_header(Rows& rows) {
    PlacedCells cells;
    if (!rows.next(cells)) rows.fail(0, "must have a header that names the columns");
    std::vector<PointsColumn> columns;
    std::set<std::string_view> paths;
    for (const auto& [text, at] : cells) {
        if (text.empty()) rows.fail(at, "the name of a column must not be empty");
        if (parse_number(text))
            rows.fail(at, "the first row must name the columns (got " + in_quotes(text) + ")");
        if (!paths.insert(text).second) rows.fail(at, "duplicate column " + in_quotes(text));
        columns.emplace_back().path = text;
    }
    return columns;
}

/// Reads all rows and fills purely numeric columns. The result says which columns are not.
std::vector<bool> read_numbers(Rows rows, std::vector<PointsColumn>& columns) {
    std::vector<bool> has_texts(columns.size());
    PlacedCells cells;
    std::size_t count = 0;
    for (; rows.next(cells); ++count) {
        if (cells.size() != columns.size())
            rows.fail(rows.start(), "must have as many cells as the header, " +
                                        std::to_string(columns.size()) + " (got " +
                                        std::to_string(cells.size()) + ")");
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto& [text, at] = cells[c];
            const auto number = parse_number(text);
            if (number && !has_texts[c]) columns[c].numbers.push_back(*number);
            if (number) continue;
            if (text.empty()) rows.fail(at, "a cell must not be empty");
            if (is_unusable_number(text))
                rows.fail(at, "must be a finite number in double precision (got " +
                                  in_quotes(text) + ")");
            has_texts[c] = true;
        }
    }
    if (count == 0) rows.fail(0, "has no rows below its header");
    return has_texts;
}

/// Reads all rows again, for the non-numeric columns.
void read_texts(Rows rows, const std::vector<bool>& has_texts, std::vector<PointsColumn>& columns) {
    std::vector<std::map<std::string, std::uint32_t, std::less<>>> known(columns.size());
    PlacedCells cells;
    while (rows.next(cells))
        for (std::size_t c = 0; c < cells.size(); ++c) {
            if (!has_texts[c]) continue;
            auto& [path, numbers, texts, codes] = columns[c];
            auto found = known[c].find(cells[c].text);
            if (found == known[c].end()) {
                const auto code = static_cast<std::uint32_t>(texts.size());
                found = known[c].emplace(texts.emplace_back(cells[c].text), code).first;
            }
            codes.push_back(found->second);
        }
}

}  // namespace

std::string PointsColumn::problem_as_numbers() const {
    const auto wrong =
        std::ranges::find_if(texts, [](const std::string& text) { return !parse_number(text); });
    if (wrong == texts.end()) return "";
    const auto code = static_cast<std::uint32_t>(wrong - texts.begin());
    const auto row = std::ranges::find(codes, code) - codes.begin();
    return "row " + std::to_string(row + 1) + ": must be a number (got " + in_quotes(*wrong) + ")";
}

std::vector<PointsColumn> read_points_csv(std::string_view text, const std::string& name) {
    text = without_byte_order_mark(text);
    Rows rows(text, name);
    std::vector<PointsColumn> columns = read_header(rows);
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    const std::size_t room = std::min(lines, text.size() / (2 * columns.size()));
    for (PointsColumn& column : columns) column.numbers.reserve(room);
    const std::vector<bool> has_texts = read_numbers(rows, columns);
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (has_texts[c]) columns[c].numbers = {};
    if (std::ranges::count(has_texts, true) > 0) read_texts(rows, has_texts, columns);
    return columns;
}

}  // namespace irido::schemas
