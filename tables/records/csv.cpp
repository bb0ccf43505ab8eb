#include "tables/records/csv.hpp"

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

std::string csv_head(const std::vector<std::string>& names) {
    std::string out;
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (c > 0) out += ',';
        append_text(out, names[c]);
    }
    return out + '\n';
}

std::string csv_rows(const Records& records) {
    std::string out;
    const RowWriter writer(records, append_text);
    const std::size_t rows = records.rows();
    out.reserve(rows * records.columns.size() * kUsualBytes);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < records.columns.size(); ++c) {
            if (c > 0) out += ',';
            writer.append(out, c, row);
        }
        out += '\n';
    }
    return out;
}

std::string write_csv(const Records& records) {
    std::vector<std::string> names;
    for (const Column& column : records.columns) names.push_back(column.name);
    return csv_head(names) + csv_rows(records);
}

}  // namespace irido
