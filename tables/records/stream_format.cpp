#include "tables/records/stream_format.hpp"

#include <array>

#include "tables/records/csv.hpp"
#include "tables/records/h5_file.hpp"
#include "tables/records/json.hpp"
#include "tables/records/npy.hpp"
#include "tables/records/packed_rows.hpp"

namespace irido {

namespace {

std::string head_of_csv(const RecordLayout& layout, std::uint64_t) {
    std::vector<std::string> names;
    for (const RecordField& field : layout) names.push_back(field.name);
    return csv_head(names);
}

std::string rows_of_csv(const RecordLayout& layout, const Records& records) {
    check_columns(layout, records);
    return csv_rows(records);
}

std::string head_of_json(const RecordLayout&, std::uint64_t) {
    return "[";
}

std::string rows_of_json(const RecordLayout& layout, const Records& records) {
    check_columns(layout, records);
    return json_rows(records);
}

std::string head_of_npy(const RecordLayout& layout, std::uint64_t rows) {
    return npy_head(layout, rows, true);
}

std::string head_of_counted_npy(const RecordLayout& layout, std::uint64_t rows) {
    return npy_head(layout, rows, false);
}

std::string rows_of_npy(const RecordLayout& layout, const Records& records) {
    return packed_rows(layout, records, TextCode::utf32);
}

std::string head_of_h5(const RecordLayout& layout, std::uint64_t) {
    check_h5_names(layout);  // before the work rather than after it
    return "";
}

std::string rows_of_h5(const RecordLayout& layout, const Records& records) {
    return packed_rows(layout, records, TextCode::utf8);
}

}  // namespace

const StreamFormat* find_stream_format(std::string_view name) {
    static constexpr std::array formats{
        StreamFormat{"csv", "one line a record, names in the first", false, "", head_of_csv,
                     rows_of_csv, "", nullptr, nullptr},
        StreamFormat{"json", "array of objects with the CSV's names", false, ",", head_of_json,
                     rows_of_json, "\n]\n", nullptr, nullptr},
        StreamFormat{"npy", "NumPy structured array with the CSV's names", true, "", head_of_npy,
                     rows_of_npy, "", nullptr, nullptr},
        StreamFormat{"h5", "HDF5 with one dataset for each of the CSV's names", true, "",
                     head_of_h5, rows_of_h5, "", write_h5, join_h5},
    };
    for (const StreamFormat& format : formats)
        if (format.name == name) return &format;
    return nullptr;
}

const StreamFormat* find_counted_format(std::string_view name) {
    static constexpr StreamFormat npy{"npy",
                                      "NumPy structured array with the CSV's names",
                                      true,
                                      "",
                                      head_of_counted_npy,
                                      rows_of_npy,
                                      "",
                                      nullptr,
                                      nullptr};
    if (name == npy.name) return &npy;
    const StreamFormat* const format = find_stream_format(name);
    return format && !format->finish ? format : nullptr;
}

}  // namespace irido
