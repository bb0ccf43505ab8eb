#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace irido::tables {

/// One named column of a table of records.
struct Column {
    using Numbers = std::vector<double>;
    using Texts = std::vector<std::string>;
    using Flags = std::vector<bool>;
    /// A column of few different values: each once, and which of them stands in each row.
    template <class Value>
    struct Coded {
        std::vector<Value> values;
        std::vector<std::uint32_t> codes;

        std::size_t size() const { return codes.size(); }
        const Value& operator[](std::size_t row) const { return values[codes[row]]; }
    };
    using CodedNumbers = Coded<double>;
    using CodedTexts = Coded<std::string>;

    std::string name;
    std::variant<Numbers, Texts, Flags, CodedNumbers, CodedTexts> values;
};

/// What a command answers: columns of equal length in the order in which they are printed.
struct Records {
    std::vector<Column> columns;

    std::size_t rows() const;
    /// Adds the rows of records with the same columns.
    void append(Records more);
};

/// Shortest text that reads back to the same double, appended.
void append_number(std::string& out, double value);

/// Bytes that one value takes in a text, with its comma, more or less.
inline constexpr std::size_t kUsualValueBytes = 16;

/// Appends the values of some columns row by row: a column's values through `append(out, value)`,
/// those of coded columns once.
class RowWriter {
public:
    using AppendText = void (*)(std::string& out, const std::string& text);

    RowWriter(const Records& records, AppendText append_text);

    /// The value in one row of one column.
    void append(std::string& out, std::size_t column, std::size_t row) const;

private:
    struct Source {
        const Column* column;
        std::vector<std::string> coded;  ///< texts of a coded column's values
        const std::vector<std::uint32_t>* codes = nullptr;
    };

    AppendText append_text_;
    std::vector<Source> sources_;
};

}  // namespace irido::tables
