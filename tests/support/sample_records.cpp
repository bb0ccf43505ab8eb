#include "tests/support/sample_records.hpp"

#include <hdf5.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace irido::test {

namespace {

using Type = RecordField::Type;

const std::vector<std::string> kTexts{"plain",
                                      "",
                                      "a,b",
                                      "say \"so\"",
                                      "\xc3\xa9t\xc3\xa9",
                                      "\xe6\xb3\xa1",
                                      "\xf0\x9f\xab\xa7",
                                      "back\\slash",
                                      "\ttab"};

/// The values of a dataset as texts.
std::vector<std::string> values_of(hid_t data, hid_t type, std::size_t rows) {
    std::vector<std::string> values;
    if (H5Tget_class(type) == H5T_FLOAT) {
        std::vector<double> numbers(rows);
        H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
        for (const double number : numbers) append_number(values.emplace_back(), number);
        return values;
    }
    const std::size_t size = H5Tget_size(type);
    std::string bytes(rows * size, '?');
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    for (std::size_t row = 0; row < rows; ++row) {
        const std::string cell = bytes.substr(row * size, size);
        if (H5Tget_class(type) == H5T_STRING) {
            values.push_back(cell.substr(0, cell.find('\0')));
        } else {
            std::array<char, 8> name{};
            H5Tenum_nameof(type, cell.data(), name.data(), name.size());
            values.emplace_back(name.data());
        }
    }
    return values;
}

std::string type_name(hid_t type) {
    if (H5Tget_class(type) == H5T_FLOAT)
        return H5Tequal(type, H5T_IEEE_F64LE) > 0 ? "float64" : "another float";
    if (H5Tget_class(type) == H5T_ENUM)
        return "enum of " + std::to_string(H5Tget_nmembers(type)) + ", bytes " +
               std::to_string(H5Tget_size(type));
    const bool is_good = H5Tget_cset(type) == H5T_CSET_UTF8 &&
                         H5Tget_strpad(type) == H5T_STR_NULLPAD && H5Tis_variable_str(type) == 0;
    return is_good ? "UTF-8 in " + std::to_string(H5Tget_size(type)) : "another text";
}

}  // namespace

RecordLayout sample_layout() {
    return {{"angle, degrees", Type::number, 0},
            {"it's", Type::text, 12},
            {"is_good", Type::flag, 0},
            {"\xce\xbb_nm", Type::number, 0},
            {"kind", Type::text, 11},
            {"layers.0.n", Type::number, 0}};
}

Records sample_rows(std::uint64_t first, std::uint64_t count) {
    Column::Numbers angles, indices;
    Column::Texts texts;
    Column::Flags flags;
    Column::CodedNumbers lengths{{380, 0.1, 1e-300, -7.25}, {}};
    Column::CodedTexts kinds{kTexts, {}};
    for (std::uint64_t row = first; row < first + count; ++row) {
        angles.push_back(static_cast<double>(row % 181) / 2);
        texts.push_back(kTexts[(row / 3) % kTexts.size()]);
        flags.push_back(row % 3 == 0);
        lengths.codes.push_back(static_cast<std::uint32_t>(row % lengths.values.size()));
        kinds.codes.push_back(static_cast<std::uint32_t>(row * 7 % kTexts.size()));
        indices.push_back(std::sin(static_cast<double>(row)));
    }
    const RecordLayout layout = sample_layout();
    Records records;
    const auto add = [&](auto values) {
        records.columns.push_back({layout[records.columns.size()].name, std::move(values)});
    };
    add(angles), add(texts), add(flags), add(lengths), add(kinds), add(indices);
    return records;
}

H5Content read_h5(const std::string& path) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) throw std::runtime_error("no HDF5 file: " + path);
    H5Content content;
    H5G_info_t group{};
    H5Gget_info(file, &group);
    for (hsize_t i = 0; i < group.nlinks; ++i) {
        std::array<char, 64> name{};
        H5Lget_name_by_idx(file, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name.data(), name.size(),
                           H5P_DEFAULT);
        const hid_t data = H5Dopen2(file, name.data(), H5P_DEFAULT), type = H5Dget_type(data);
        const hid_t space = H5Dget_space(data), plist = H5Dget_create_plist(data);
        H5O_info_t info{};
        H5Oget_info(data, &info);
        if (info.ctime != 0 || info.mtime != 0) content.faults.emplace_back("a time");
        if (H5Pget_layout(plist) != H5D_CONTIGUOUS) content.faults.emplace_back("in chunks");
        if (H5Sget_simple_extent_ndims(space) != 1) content.faults.emplace_back("dimensions");
        const auto rows = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
        content.columns.push_back({name.data(), type_name(type), values_of(data, type, rows)});
        H5Pclose(plist), H5Sclose(space), H5Tclose(type), H5Dclose(data);
    }
    H5Fclose(file);
    return content;
}

}  // namespace irido::test
