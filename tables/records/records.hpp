#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace irido::tables {

/// One named column of a table of records.
struct Column {
    using Numbers = std::vector<double>;  ///< NaN where a row has no value
    using Texts = std::vector<std::string>;
    using Flags = std::vector<bool>;
    /// A column with few distinct values: each value once, and an index into them per row.
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

/// The result of a command: columns of equal length, in output order.
struct Records {
    std::vector<Column> columns;

    std::size_t rows() const;
    /// Adds the rows of records with the same columns.
    void append(Records more);
};

/// Appends the shortest text that reads back to the same double.
void append_number(std::string& out, double value);

/// Typical bytes per value in text formats, separator included.
inline constexpr std::size_t kUsualValueBytes = 16;

/// Appends the values of columns row by row; NaN means no value. The text of each value of a coded
/// column is made only once.
class RowWriter {
public:
    using AppendText = void (*)(std::string& out, const std::string& text);

    /// `none` is the text of a missing number.
    RowWriter(const Records& records, AppendText append_text, std::string_view none);

    /// The value in one row of one column.
    void append(std::string& out, std::size_t column, std::size_t row) const;

private:
    struct Source {
        const Column* column;
        std::vector<std::string> coded;  ///< texts for a coded column's values
        const std::vector<std::uint32_t>* codes = nullptr;
    };

    void append_value(std::string& out, double value) const;

    AppendText append_text_;
    std::string_view none_;
    std::vector<Source> sources_;
};

}  // namespace irido::tables
