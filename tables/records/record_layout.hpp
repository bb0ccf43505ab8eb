#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace irido::tables {

/// Name and type of a column of records.
struct RecordField {
    enum class Type { number, text, flag };

    std::string name;
    Type type = Type::number;
    std::size_t width = 0;  ///< of a string: its longest length in bytes of UTF-8, at least 1

    bool operator==(const RecordField&) const = default;
};

/// The columns of a stream of records, in their order.
using RecordLayout = std::vector<RecordField>;

}  // namespace irido::tables
