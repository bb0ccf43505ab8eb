#include "tables/formats/csv.hpp"

namespace irido {

namespace {

/// Of one value with its comma.
constexpr std::size_t kUsualBytes = 16;

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

}  // namespace

std::string write_csv(const Records& records) {
    std::string out;
    for (std::size_t c = 0; c < records.columns.size(); ++c) {
        if (c > 0) out += ',';
        append_text(out, records.columns[c].name);
    }
    out += '\n';
    const RowWriter writer(records, append_text);
    const std::size_t rows = records.rows();
    out.reserve(out.size() + rows * records.columns.size() * kUsualBytes);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < records.columns.size(); ++c) {
            if (c > 0) out += ',';
            writer.append(out, c, row);
        }
        out += '\n';
    }
    return out;
}

}  // namespace irido
