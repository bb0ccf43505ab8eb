#include "schemas/readers/materials/column_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/index_rows.hpp"

namespace irido::schemas {

namespace {

enum class Quantity { n, k, eps1, eps2, loss };

struct QuantityName {
    std::string_view words;
    Quantity quantity;
};

constexpr std::array kQuantities{
    QuantityName{"n", Quantity::n},
    QuantityName{"index", Quantity::n},
    QuantityName{"refractive index", Quantity::n},
    QuantityName{"refractive index n", Quantity::n},
    QuantityName{"k", Quantity::k},
    QuantityName{"kappa", Quantity::k},
    QuantityName{"extinction", Quantity::k},
    QuantityName{"extinction coefficient", Quantity::k},
    QuantityName{"extinction coefficient k", Quantity::k},
    QuantityName{"eps1", Quantity::eps1},
    QuantityName{"eps 1", Quantity::eps1},
    QuantityName{"eps re", Quantity::eps1},
    QuantityName{"eps real", Quantity::eps1},
    QuantityName{"e1", Quantity::eps1},
    QuantityName{"e 1", Quantity::eps1},
    QuantityName{"eps2", Quantity::eps2},
    QuantityName{"eps 2", Quantity::eps2},
    QuantityName{"eps im", Quantity::eps2},
    QuantityName{"eps imag", Quantity::eps2},
    QuantityName{"e2", Quantity::eps2},
    QuantityName{"e 2", Quantity::eps2},
    QuantityName{"loss", Quantity::loss},
};

struct ValueColumn {
    Quantity quantity;
    bool negated = false;
};

std::optional<ValueColumn> value_column(std::string_view column) {
    std::string words = plain_words(column);
    const bool negated = words.starts_with('-');
    if (negated) words.erase(0, 1);
    const auto found = std::ranges::find(kQuantities, words, &QuantityName::words);
    if (found == kQuantities.end()) return std::nullopt;
    const bool is_real = found->quantity == Quantity::n || found->quantity == Quantity::eps1;
    if (negated && is_real) return std::nullopt;
    return ValueColumn{found->quantity, negated};
}

/// Which column of a table is what.
struct Layout {
    std::optional<std::size_t> spectral, real, imaginary;
    std::optional<SpectralUnit> unit;
    bool is_permittivity = false;
    double sign = 1;  ///< of the imaginary part
};

/// Nothing for names that are not known, or not n, k or eps1, eps2 over one spectral column.
std::optional<Layout> layout_of(const std::vector<std::string>& header) {
    Layout layout;
    std::optional<Quantity> real, imaginary;
    for (std::size_t c = 0; c < header.size(); ++c) {
        if (const auto spectral = spectral_column(header[c])) {
            if (layout.spectral) return std::nullopt;
            layout.spectral = c;
            layout.unit = spectral->unit;
            continue;
        }
        const auto value = value_column(header[c]);
        if (!value) return std::nullopt;
        const bool is_real = value->quantity == Quantity::n || value->quantity == Quantity::eps1;
        if ((is_real ? layout.real : layout.imaginary)) return std::nullopt;
        (is_real ? layout.real : layout.imaginary) = c;
        (is_real ? real : imaginary) = value->quantity;
        if (value->negated) layout.sign = -1;
    }
    if (!layout.spectral || !real) return std::nullopt;
    layout.is_permittivity = real == Quantity::eps1;
    const Quantity other = layout.is_permittivity ? Quantity::eps2 : Quantity::k;
    if (imaginary && imaginary != other && imaginary != Quantity::loss) return std::nullopt;
    return layout;
}

bool are_index_columns(const std::vector<std::string>& header) {
    return layout_of(header).has_value();
}

/// Wavelengths of rows in nm, in the order of the file.
std::vector<IndexRow> rows_of(const ColumnText& table, const Layout& layout, SpectralUnit unit,
                              const std::string& name) {
    std::vector<IndexRow> rows;
    rows.reserve(table.rows.size());
    for (const ColumnRow& row : table.rows) {
        const double spectral = row.values[*layout.spectral];
        if (!(spectral > 0) || !std::isfinite(to_nm(spectral, unit)))
            throw InputError(name, place_of(row.line, row.cells[*layout.spectral]),
                             "the wavelength must be positive (got " + to_text(spectral) + ")");
        rows.push_back({to_nm(spectral, unit), row.values[*layout.real],
                        layout.imaginary ? layout.sign * row.values[*layout.imaginary] : 0});
    }
    return rows;
}

/// n + ik of a permittivity whose imaginary part is not negative.
void take_roots(std::vector<IndexRow>& rows) {
    for (IndexRow& row : rows) {
        const std::complex<double> root = std::sqrt(std::complex(row[1], row[2]));
        row[1] = root.real();
        row[2] = root.imag();
    }
}

/// Long waves in nm, or angstroms?
void note_angstroms(const std::vector<IndexRow>& rows, std::vector<std::string>& notes) {
    if (rows.front()[0] >= 1000 && rows.back()[0] <= 30000)
        notes.push_back("no header: wavelengths taken as " + to_text(rows.front()[0]) + " to " +
                        to_text(rows.back()[0]) +
                        " nm (if they are in angstroms, add a header angstrom,n,k)");
}

}  // namespace

std::string known_columns() {
    return "a wavelength in nm, um, angstrom, eV or cm-1, and n, k or eps1, eps2 (k and eps2 also "
           "as loss, or -k)";
}

MaterialFile material_of_columns(const ColumnText& table, const std::vector<std::string>& header,
                                 const std::string& name) {
    const Layout layout = layout_of(header).value();
    if (!layout.unit) require_nm(table, *layout.spectral, name, "n,k");
    const SpectralUnit unit = layout.unit.value_or(SpectralUnit::nm);
    std::vector<IndexRow> rows = rows_of(table, layout, unit, name);
    std::vector<std::string> notes;
    const bool rises_with_energy = unit == SpectralUnit::ev || unit == SpectralUnit::per_cm;
    if (rises_with_energy && rows.front()[0] > rows.back()[0]) std::ranges::reverse(rows);
    put_in_order(rows, "", notes);
    make_k_positive(rows, name, notes);
    if (layout.is_permittivity) take_roots(rows);
    if (table.header.empty() && !layout.unit) note_angstroms(rows, notes);
    const bool has_k = std::ranges::any_of(rows, [](const IndexRow& row) { return row[2] != 0; });
    return material_of(name, column(rows, 1), has_k ? std::optional(column(rows, 2)) : std::nullopt,
                       std::move(notes));
}

MaterialFile read_column_file(std::string_view text, const std::string& name) {
    const ColumnNames names{are_index_columns, known_columns(), 2, 3,
                            "; other files: refractiveindex.info (YAML, CSV), SOPRA (.nk, .MAT), "
                            "Woollam (.mat)"};
    const ColumnText table = read_columns(lines_of(text), name, names);
    if (!table.header.empty()) return material_of_columns(table, table.header, name);
    if (table.has_semicolon_comments)
        throw InputError(
            name, "",
            "wavelengths of files with ; comments may be in nm or angstroms: add a header "
            "such as angstrom,n,k");
    std::vector<std::string> header{"wavelength", "n", "k"};
    header.resize(table.rows[0].values.size());
    return material_of_columns(table, header, name);
}

}  // namespace irido::schemas
