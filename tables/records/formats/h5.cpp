// h5: HDF5 with one dataset per column, made from packed rows when the part is complete.

#include "tables/records/h5_file.hpp"
#include "tables/records/packed_rows.hpp"

namespace irido::tables {

namespace {

std::string head(const RecordLayout& layout, std::uint64_t, HeadKind) {
    check_h5_names(layout);  // before the work rather than after it
    return "";
}

std::string rows(const RecordLayout& layout, const Records& records) {
    return packed_rows(layout, records, TextCode::utf8);
}

}  // namespace

extern const RecordFormat record_format_h5{
    .name = "h5",
    .summary = "HDF5 with one dataset for each of the CSV's names",
    .is_binary = true,
    .separator = "",
    .head = head,
    .rows = rows,
    .tail = "",
    .finish = write_h5,
    .join = join_h5};

}  // namespace irido::tables
