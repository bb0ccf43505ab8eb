#include "tables/formats/json.hpp"

#include <nlohmann/json.hpp>

namespace irido {

namespace {

std::string quoted_json(const std::string& text) {
    return nlohmann::json(text).dump();
}

struct AppendValue {
    std::string& out;
    std::size_t row;

    void operator()(const Column::Numbers& v) const { append_number(out, v[row]); }
    void operator()(const Column::Texts& v) const { out += quoted_json(v[row]); }
    void operator()(const Column::Flags& v) const { out += v[row] ? "true" : "false"; }
};

}  // namespace

std::string write_json(const Records& records) {
    std::vector<std::string> keys;
    for (const Column& column : records.columns) keys.push_back(quoted_json(column.name) + ":");
    std::string out = "[";
    const std::size_t rows = records.rows();
    for (std::size_t row = 0; row < rows; ++row) {
        out += row == 0 ? "\n{" : ",\n{";
        for (std::size_t c = 0; c < keys.size(); ++c) {
            if (c > 0) out += ',';
            out += keys[c];
            std::visit(AppendValue{out, row}, records.columns[c].values);
        }
        out += '}';
    }
    return out + "\n]\n";
}

}  // namespace irido
