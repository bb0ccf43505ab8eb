#include "tables/records/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace irido {

namespace {

/// Of one value with its comma.
constexpr std::size_t kUsualBytes = 16;

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

}  // namespace

std::string json_rows(const Records& records) {
    std::vector<std::string> keys;
    for (const Column& column : records.columns) keys.push_back(quoted_json(column.name) + ":");
    const RowWriter writer(records, append_text);
    const std::size_t rows = records.rows();
    std::size_t row_bytes = 4;
    for (const std::string& key : keys) row_bytes += key.size() + kUsualBytes;
    std::string out;
    out.reserve(rows * row_bytes);
    for (std::size_t row = 0; row < rows; ++row) {
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

std::string write_json(const Records& records) {
    return "[" + json_rows(records) + "\n]\n";
}

}  // namespace irido
