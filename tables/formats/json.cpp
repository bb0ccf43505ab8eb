#include "tables/formats/json.hpp"

#include <nlohmann/json.hpp>

namespace irido {

namespace {

std::string quoted_json(const std::string& text) {
    return nlohmann::json(text).dump();
}

void append_text(std::string& out, const std::string& text) {
    out += quoted_json(text);
}

}  // namespace

std::string write_json(const Records& records) {
    std::vector<std::string> keys;
    for (const Column& column : records.columns) keys.push_back(quoted_json(column.name) + ":");
    const RowWriter writer(records, append_text);
    std::string out = "[";
    const std::size_t rows = records.rows();
    for (std::size_t row = 0; row < rows; ++row) {
        out += row == 0 ? "\n{" : ",\n{";
        for (std::size_t c = 0; c < keys.size(); ++c) {
            if (c > 0) out += ',';
            out += keys[c];
            writer.append(out, c, row);
        }
        out += '}';
    }
    return out + "\n]\n";
}

}  // namespace irido
