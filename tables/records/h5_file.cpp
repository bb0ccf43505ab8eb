#include "tables/records/h5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "tables/files/atomic_file.hpp"
#include "tables/files/plain_file.hpp"
#include "tables/records/packed_rows.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kBufferBytes = 4U << 20U;

using Offsets = std::vector<std::uint64_t>;  ///< of the columns' data in a file

/// Stops the library from printing errors and from closing files at exit.
void silence() {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Keeps the innermost message of the library's error, or the system's reason.
herr_t keep_reason(unsigned, const H5E_error2_t* error, void* reason) {
    std::string& text = *static_cast<std::string*>(reason);
    const std::string said = error->desc ? error->desc : "";
    static const std::string mark = "error message = '";
    const std::size_t at = said.find(mark);
    if (at != std::string::npos)
        text = said.substr(at + mark.size(), said.find('\'', at + mark.size()) - at - mark.size());
    else if (text.empty())
        text = said;
    return 0;
}

[[noreturn]] void fail(const std::string& file, const std::string& what) {
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_reason, &reason);
    throw OutputError(file + what + (reason.empty() ? "" : ": " + reason));
}

/// An object of the library.
class Handle {
public:
    using Close = herr_t (*)(hid_t);

    Handle(hid_t id, Close close, const std::string& file, const char* what = ": cannot be written")
        : id_(id), close_(close) {
        if (id < 0) fail(file, what);
    }
    ~Handle() { close_(id_); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    operator hid_t() const { return id_; }

private:
    hid_t id_;
    Close close_;
};

void require(bool is_good, const std::string& file) {
    if (!is_good) fail(file, ": cannot be written");
}

/// The type of a column, newly created.
hid_t type_of(const RecordField& field) {
    if (field.type == RecordField::Type::number) return H5Tcopy(H5T_IEEE_F64LE);
    if (field.type == RecordField::Type::flag) {
        const hid_t type = H5Tenum_create(H5T_STD_I8LE);
        for (const std::int8_t value : {std::int8_t{0}, std::int8_t{1}})
            H5Tenum_insert(type, value ? "TRUE" : "FALSE", &value);
        return type;
    }
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, field.width);
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

/// A file with the datasets; their data are to be written at the returned offsets.
Offsets create(const std::string& file, const RecordLayout& layout, std::uint64_t rows) {
    silence();
    const Handle ordered(H5Pcreate(H5P_FILE_CREATE), H5Pclose, file);
    const Handle plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file);
    require(
        H5Pset_link_creation_order(ordered, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0 &&
            H5Pset_obj_track_times(ordered, false) >= 0 &&
            H5Pset_obj_track_times(plain, false) >= 0 &&
            H5Pset_layout(plain, H5D_CONTIGUOUS) >= 0 &&
            H5Pset_alloc_time(plain, H5D_ALLOC_TIME_EARLY) >= 0 &&
            H5Pset_fill_time(plain, H5D_FILL_TIME_NEVER) >= 0,
        file);
    const Handle h5(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, ordered, H5P_DEFAULT), H5Fclose, file);
    const hsize_t count = rows;
    const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, file);
    Offsets offsets;
    for (const RecordField& field : with_distinct_names(layout)) {
        const Handle type(type_of(field), H5Tclose, file);
        const Handle data(
            H5Dcreate2(h5, field.name.c_str(), type, space, H5P_DEFAULT, plain, H5P_DEFAULT),
            H5Dclose, file);
        offsets.push_back(H5Dget_offset(data));
        require(rows == 0 || offsets.back() != HADDR_UNDEF, file);
    }
    require(H5Fflush(h5, H5F_SCOPE_GLOBAL) >= 0, file);
    return offsets;
}

/// Offsets of the columns' data in a file made by create().
Offsets offsets_in(const std::string& file, const RecordLayout& layout, std::uint64_t rows) {
    silence();
    const char* const what = ": does not match its journal";
    const Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, file, what);
    Offsets offsets;
    for (const RecordField& field : with_distinct_names(layout)) {
        const Handle data(H5Dopen2(h5, field.name.c_str(), H5P_DEFAULT), H5Dclose, file, what);
        const Handle type(H5Dget_type(data), H5Tclose, file, what);
        const Handle wanted(type_of(field), H5Tclose, file, what);
        const Handle space(H5Dget_space(data), H5Sclose, file, what);
        offsets.push_back(H5Dget_offset(data));
        if (H5Tequal(type, wanted) <= 0 || H5Sget_simple_extent_ndims(space) != 1 ||
            H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(rows) ||
            (rows > 0 && offsets.back() == HADDR_UNDEF))
            fail(file, what);
    }
    return offsets;
}

}  // namespace

void check_h5_names(const RecordLayout& layout) {
    for (const RecordField& field : layout)
        if (field.name.empty() || field.name == "." ||
            field.name.find_first_of(std::string_view("/\0", 2)) != std::string::npos)
            throw OutputError("h5: a column cannot be named '" + field.name +
                              "'; use another --format");
}

void write_h5(const RecordLayout& layout, std::uint64_t rows, const std::string& part,
              const std::string& to) {
    const Offsets offsets = create(to, layout, rows);
    const PlainFile in(part, PlainFile::Use::read), out(to, PlainFile::Use::write);
    const std::size_t row_bytes = packed_bytes(layout, TextCode::utf8);
    const std::uint64_t block = std::max<std::uint64_t>(1, kBufferBytes / row_bytes);
    std::string packed, column;
    for (std::uint64_t first = 0; first < rows; first += block) {
        const std::size_t count = std::min(block, rows - first);
        packed.resize(count * row_bytes);
        in.read_at(first * row_bytes, packed);
        const char* from = packed.data();
        for (std::size_t c = 0; c < layout.size(); ++c) {
            const std::size_t bytes = packed_bytes(layout[c], TextCode::utf8);
            column.resize(count * bytes);
            for (std::size_t row = 0; row < count; ++row)
                std::memcpy(&column[row * bytes], from + row * row_bytes, bytes);
            out.write_at(offsets[c] + first * bytes, column);
            from += bytes;
        }
    }
}

void join_h5(const RecordLayout& layout, const std::vector<StreamPiece>& pieces,
             const std::string& to) {
    std::uint64_t rows = 0;
    for (const StreamPiece& piece : pieces) rows += piece.rows;
    const Offsets offsets = create(to, layout, rows);
    const PlainFile out(to, PlainFile::Use::write);
    std::uint64_t first = 0;
    std::string buffer;
    for (const StreamPiece& piece : pieces) {
        const Offsets from = offsets_in(piece.path, layout, piece.rows);
        const PlainFile in(piece.path, PlainFile::Use::read);
        for (std::size_t c = 0; c < layout.size(); ++c) {
            const std::uint64_t bytes = packed_bytes(layout[c], TextCode::utf8);
            const std::uint64_t end = piece.rows * bytes;
            for (std::uint64_t at = 0; at < end; at += buffer.size()) {
                buffer.resize(std::min<std::uint64_t>(kBufferBytes, end - at));
                in.read_at(from[c] + at, buffer);
                out.write_at(offsets[c] + first * bytes + at, buffer);
            }
        }
        first += piece.rows;
    }
}

}  // namespace irido::tables
