// csv: comma-separated values after RFC 4180, but with LF line ends.
// - A header line, then one line per record.
// - A missing number is an empty field.
// - Strings with commas, quotes or line ends are quoted; numbers are in their shortest form.

#include "tables/records/packed_rows.hpp"
#include "tables/records/record_format.hpp"

namespace irido::tables {

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

std::string head(const RecordLayout& layout, std::uint64_t, HeadKind) {
    std::string out;
    for (std::size_t c = 0; c < layout.size(); ++c) {
        if (c > 0) out += ',';
        append_text(out, layout[c].name);
    }
    return out + '\n';
}

std::string rows(const RecordLayout& layout, const Records& records) {
    check_columns(layout, records);
    std::string out;
    const RowWriter writer(records, append_text, "");
    const std::size_t count = records.rows();
    out.reserve(count * records.columns.size() * kUsualValueBytes);
    for (std::size_t row = 0; row < count; ++row) {
        for (std::size_t c = 0; c < records.columns.size(); ++c) {
            if (c > 0) out += ',';
            writer.append(out, c, row);
        }
        out += '\n';
    }
    return out;
}

}  // namespace

extern const RecordFormat record_format_csv{.name = "csv",
                                            .summary = "one line per record, after a line of names",
                                            .is_binary = false,
                                            .separator = "",
                                            .head = head,
                                            .rows = rows,
                                            .tail = ""};

}  // namespace irido::tables
