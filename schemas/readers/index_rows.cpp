#include "schemas/readers/index_rows.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

/// Such a small k, typical of glass catalogues, does not matter outside the range where it is
/// known.
constexpr double kHeldBelow = 1e-4;

WavelengthRange range_of(const Table& table) {
    return {table.wavelength_nm.front(), table.wavelength_nm.back()};
}

/// Extends the first and last value of k over the range of n, if small enough.
void hold_ends(Table& k, WavelengthRange of_n, std::vector<std::string>& notes) {
    const WavelengthRange known = range_of(k);
    const auto say = [&](double value, const std::string& side, double end) {
        const bool held = value < kHeldBelow;
        notes.push_back("k is known from " + in_words(known) + " only, n from " + in_words(of_n) +
                        ": k = " + to_text(value) +
                        (held ? " is extended " : " is not small, so the material is not known ") +
                        side + " " + to_text(end) + " nm");
        return held;
    };
    if (known.first_nm > of_n.first_nm && say(k.value.front(), "below", known.first_nm)) {
        k.wavelength_nm.insert(k.wavelength_nm.begin(), of_n.first_nm);
        k.value.insert(k.value.begin(), k.value.front());
    }
    if (known.last_nm < of_n.last_nm && say(k.value.back(), "above", known.last_nm)) {
        k.wavelength_nm.push_back(of_n.last_nm);
        k.value.push_back(k.value.back());
    }
}

}  // namespace

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string in_words(WavelengthRange range) {
    return to_text(range.first_nm) + " to " + to_text(range.last_nm) + " nm";
}

void put_in_order(std::vector<IndexRow>& rows, const std::string& where,
                  std::vector<std::string>& notes) {
    const auto by_wavelength = [](const IndexRow& a, const IndexRow& b) { return a[0] < b[0]; };
    if (!std::ranges::is_sorted(rows, by_wavelength)) {
        std::ranges::stable_sort(rows, by_wavelength);
        notes.push_back(where + "rows sorted by wavelength");
    }
    std::vector<IndexRow> kept;
    kept.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size();) {
        IndexRow sum = rows[i];
        double count = 1;
        for (++i; i < rows.size() && rows[i][0] == sum[0]; ++i, ++count)
            for (const std::size_t value : {1U, 2U}) sum[value] += rows[i][value];
        kept.push_back({sum[0], sum[1] / count, sum[2] / count});
    }
    if (kept.size() < rows.size())
        notes.push_back(where + "rows at equal wavelengths averaged, " +
                        plural(rows.size() - kept.size(), "row") + " fewer");
    rows = std::move(kept);
}

Table column(const std::vector<IndexRow>& rows, std::size_t value) {
    Table table;
    table.wavelength_nm.reserve(rows.size());
    table.value.reserve(rows.size());
    for (const IndexRow& row : rows) {
        table.wavelength_nm.push_back(row[0]);
        table.value.push_back(row[value]);
    }
    return table;
}

void make_k_positive(std::vector<IndexRow>& rows, const std::string& file,
                     std::vector<std::string>& notes) {
    const auto negative = std::ranges::find_if(rows, [](auto& row) { return row[2] < 0; });
    if (negative == rows.end()) return;
    const auto positive = std::ranges::find_if(rows, [](auto& row) { return row[2] > 0; });
    if (positive != rows.end())
        throw InputError(file, "",
                         "k must have one sign (got " + to_text((*positive)[2]) + " at " +
                             to_text((*positive)[0]) + " nm and " + to_text((*negative)[2]) +
                             " at " + to_text((*negative)[0]) + " nm)");
    for (IndexRow& row : rows) row[2] = 0 - row[2];
    notes.emplace_back("k is nowhere positive: read as n - ik, which absorbs");
}

MaterialFile material_of(const std::string& file, Dispersion n, std::optional<Table> k,
                         std::vector<std::string> notes, std::string source) {
    Material material{file, RefractiveIndex{std::move(n), Constant{0}}, Outside::refuse};
    const WavelengthRange of_n = irido::range_of(material);
    if (of_n.first_nm > of_n.last_nm)
        throw InputError(file, "", "must be known somewhere from 1 to 1e7 nm");
    if (k) {
        hold_ends(*k, of_n, notes);
        if (range_of(*k).first_nm > of_n.last_nm || range_of(*k).last_nm < of_n.first_nm)
            throw InputError(file, "",
                             "n is known from " + in_words(of_n) + " and k from " +
                                 in_words(range_of(*k)) + ": they do not overlap");
        std::get<RefractiveIndex>(material.model).k = *std::move(k);
    }
    return {std::move(material), std::move(notes), std::move(source)};
}

}  // namespace irido::schemas
