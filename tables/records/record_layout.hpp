#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace irido::tables {

/// A column that is known before any of its rows.
struct RecordField {
    enum class Type { number, text, flag };

    std::string name;
    Type type = Type::number;
    std::size_t width = 0;  ///< of a text: the most bytes of UTF-8 that a row may have, at least 1

    bool operator==(const RecordField&) const = default;
};

/// The columns of a stream of records, in their order.
using RecordLayout = std::vector<RecordField>;

}  // namespace irido::tables
