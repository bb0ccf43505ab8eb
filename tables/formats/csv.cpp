#include "tables/formats/csv.hpp"

namespace irido {

namespace {

void append_text(std::string& out, const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    out += '"';
}

struct AppendValue {
    std::string& out;
    std::size_t row;

    void operator()(const Column::Numbers& v) const { append_number(out, v[row]); }
    void operator()(const Column::Texts& v) const { append_text(out, v[row]); }
    void operator()(const Column::Flags& v) const { out += v[row] ? "true" : "false"; }
};

}  // namespace

std::string write_csv(const Records& records) {
    std::string out;
    for (std::size_t c = 0; c < records.columns.size(); ++c) {
        if (c > 0) out += ',';
        append_text(out, records.columns[c].name);
    }
    out += '\n';
    const std::size_t rows = records.rows();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < records.columns.size(); ++c) {
            if (c > 0) out += ',';
            std::visit(AppendValue{out, row}, records.columns[c].values);
        }
        out += '\n';
    }
    return out;
}

}  // namespace irido
