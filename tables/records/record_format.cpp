#include "tables/records/record_format.hpp"

#include <algorithm>
#include <array>
#include <set>

#define IRIDO_DECLARE(name) extern const RecordFormat name;
namespace irido::tables {
#include "record_formats.inc"

namespace {

constexpr std::array kRecordFormats{IRIDO_ALL};
#undef IRIDO_DECLARE
#undef IRIDO_ALL

/// The layout of complete records: strings are as wide as the longest one.
struct FieldOf {
    std::string name;

    static std::size_t longest(const Column::Texts& texts) {
        std::size_t length = 1;
        for (const std::string& text : texts) length = std::max(length, text.size());
        return length;
    }
    RecordField operator()(const Column::Numbers&) const {
        return {name, RecordField::Type::number, 0};
    }
    RecordField operator()(const Column::Texts& texts) const {
        return {name, RecordField::Type::text, longest(texts)};
    }
    RecordField operator()(const Column::Flags&) const {
        return {name, RecordField::Type::flag, 0};
    }
    RecordField operator()(const Column::CodedNumbers& v) const { return (*this)(v.values); }
    RecordField operator()(const Column::CodedTexts& v) const { return (*this)(v.values); }
};

}  // namespace

std::span<const RecordFormat* const> record_formats() {
    return kRecordFormats;
}

const RecordFormat* find_record_format(std::string_view name) {
    const auto* found = std::ranges::find(kRecordFormats, name, &RecordFormat::name);
    return found == kRecordFormats.end() ? nullptr : *found;
}

RecordLayout layout_of(const Records& records) {
    RecordLayout layout;
    for (const Column& column : records.columns)
        layout.push_back(std::visit(FieldOf{column.name}, column.values));
    return layout;
}

RecordLayout with_distinct_names(RecordLayout layout) {
    std::set<std::string> names, taken;
    for (const RecordField& field : layout) names.insert(field.name);
    for (RecordField& field : layout) {
        const std::string name = field.name;
        for (std::size_t number = 2; taken.contains(field.name); ++number)
            if (const std::string next = name + "_" + std::to_string(number); !names.contains(next))
                field.name = next;
        taken.insert(field.name);
    }
    return layout;
}

std::string written(const RecordFormat& format, const Records& records) {
    const RecordLayout layout = layout_of(records);
    std::string bytes = format.head(layout, records.rows(), HeadKind::final);
    bytes += format.rows(layout, records);
    return bytes += format.tail;
}

}  // namespace irido::tables
