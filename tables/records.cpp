#include "tables/records.hpp"

#include <array>
#include <charconv>

#include "tables/formats/csv.hpp"
#include "tables/formats/json.hpp"
#include "tables/formats/npy.hpp"

namespace irido {

std::size_t Records::rows() const {
    if (columns.empty()) return 0;
    return std::visit([](const auto& values) { return values.size(); }, columns.front().values);
}

void Records::append(Records more) {
    if (columns.empty()) {
        *this = std::move(more);
        return;
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
        std::visit(
            [&](auto& values) {
                const auto& added =
                    std::get<std::remove_cvref_t<decltype(values)>>(more.columns[c].values);
                values.insert(values.end(), added.begin(), added.end());
            },
            columns[c].values);
}

const RecordFormat* find_record_format(std::string_view name) {
    static constexpr std::array formats{
        RecordFormat{"csv", "one line a record, names in the first", write_csv},
        RecordFormat{"json", "array of objects with the CSV's names", write_json},
        RecordFormat{"npy", "NumPy structured array with the CSV's names", write_npy},
    };
    for (const RecordFormat& format : formats)
        if (format.name == name) return &format;
    return nullptr;
}

void append_number(std::string& out, double value) {
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    out.append(buffer.data(), result.ptr);
}

}  // namespace irido
