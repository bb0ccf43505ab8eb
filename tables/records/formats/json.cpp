// json: an array with one object per record, one record per line; numbers in their shortest form,
// null where a number is missing.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tables/records/packed_rows.hpp"
#include "tables/records/record_format.hpp"

namespace irido::tables {

namespace {

std::string quoted_json(const std::string& text) {
    return nlohmann::json(text).dump();
}

void append_text(std::string& out, const std::string& text) {
    const bool is_plain = std::ranges::all_of(
        text, [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
    if (is_plain)
        out.append("\"").append(text).append("\"");
    else
        out += quoted_json(text);
}

std::string head(const RecordLayout&, std::uint64_t, HeadKind) {
    return "[";
}

std::string rows(const RecordLayout& layout, const Records& records) {
    check_columns(layout, records);
    std::vector<std::string> keys;
    for (const RecordField& field : with_distinct_names(layout))
        keys.push_back(quoted_json(field.name) + ":");
    const RowWriter writer(records, append_text, "null");
    const std::size_t count = records.rows();
    std::size_t row_bytes = 4;
    for (const std::string& key : keys) row_bytes += key.size() + kUsualValueBytes;
    std::string out;
    out.reserve(count * row_bytes);
    for (std::size_t row = 0; row < count; ++row) {
        out += row == 0 ? "\n{" : ",\n{";
        for (std::size_t c = 0; c < keys.size(); ++c) {
            if (c > 0) out += ',';
            out += keys[c];
            writer.append(out, c, row);
        }
        out += '}';
    }
    return out;
}

}  // namespace

extern const RecordFormat record_format_json{.name = "json",
                                             .summary = "array of objects with the CSV's names",
                                             .is_binary = false,
                                             .separator = ",",
                                             .head = head,
                                             .rows = rows,
                                             .tail = "\n]\n"};

}  // namespace irido::tables
