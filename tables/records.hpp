#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace irido {

/// One named column of a table of records.
struct Column {
    using Numbers = std::vector<double>;
    using Texts = std::vector<std::string>;
    using Flags = std::vector<bool>;
    std::string name;
    std::variant<Numbers, Texts, Flags> values;
};

/// What a command answers: columns of equal length in the order in which they are printed.
struct Records {
    std::vector<Column> columns;

    std::size_t rows() const;
    /// Adds the rows of records with the same columns.
    void append(Records more);
};

/// A way to write records as bytes.
struct RecordFormat {
    std::string_view name;  ///< as --format and as a file's extension
    std::string_view summary;
    std::string (*write)(const Records&);
};

/// csv, json and npy; nullptr for any other name.
const RecordFormat* find_record_format(std::string_view name);

/// Shortest text that reads back to the same double, appended.
void append_number(std::string& out, double value);

}  // namespace irido
