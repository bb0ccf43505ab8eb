#include "tables/records/records.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace irido::tables {

std::size_t Records::rows() const {
    if (columns.empty()) return 0;
    return std::visit([](const auto& values) { return values.size(); }, columns.front().values);
}

namespace {

template <class Value>
void append_values(std::vector<Value>& to, const std::vector<Value>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

template <class Value>
void append_values(Column::Coded<Value>& to, const Column::Coded<Value>& more) {
    const auto offset = static_cast<std::uint32_t>(to.values.size());
    append_values(to.values, more.values);
    for (const std::uint32_t code : more.codes) to.codes.push_back(offset + code);
}

}  // namespace

void Records::append(Records more) {
    if (columns.empty()) {
        *this = std::move(more);
        return;
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
        std::visit(
            [&](auto& values) {
                using Values = std::remove_cvref_t<decltype(values)>;
                append_values(values, std::get<Values>(more.columns[c].values));
            },
            columns[c].values);
}

void append_number(std::string& out, double value) {
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    out.append(buffer.data(), result.ptr);
}

RowWriter::RowWriter(const Records& records, AppendText append_text, std::string_view none)
    : append_text_(append_text), none_(none) {
    for (const Column& column : records.columns) {
        Source source{&column, {}, nullptr};
        if (const auto* numbers = std::get_if<Column::CodedNumbers>(&column.values)) {
            for (const double value : numbers->values)
                append_value(source.coded.emplace_back(), value);
            source.codes = &numbers->codes;
        } else if (const auto* texts = std::get_if<Column::CodedTexts>(&column.values)) {
            for (const std::string& value : texts->values)
                append_text(source.coded.emplace_back(), value);
            source.codes = &texts->codes;
        }
        sources_.push_back(std::move(source));
    }
}

void RowWriter::append_value(std::string& out, double value) const {
    if (std::isnan(value))
        out += none_;
    else
        append_number(out, value);
}

void RowWriter::append(std::string& out, std::size_t column, std::size_t row) const {
    const Source& source = sources_[column];
    if (source.codes) {
        out += source.coded[(*source.codes)[row]];
    } else if (const auto* numbers = std::get_if<Column::Numbers>(&source.column->values)) {
        append_value(out, (*numbers)[row]);
    } else if (const auto* texts = std::get_if<Column::Texts>(&source.column->values)) {
        append_text_(out, (*texts)[row]);
    } else {
        out += std::get<Column::Flags>(source.column->values)[row] ? "true" : "false";
    }
}

}  // namespace irido::tables
