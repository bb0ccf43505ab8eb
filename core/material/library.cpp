#include "core/material/library.hpp"

#include <algorithm>
#include <array>

namespace irido {

namespace {

/// A row of a table of n or of k alone.
struct Point {
    double nm;
    double value;
};

/// A row of a table of n and k.
struct Row {
    double nm;
    double n;
    double k;
};

constexpr std::size_t kMostCoefficients = 13;

/// A material as static data. Oscillators, if any, give both n and k. Otherwise n comes from `nk`,
/// else `n`, else the formula, else it is 1; k comes from `nk`, else `k`, else it is 0.
struct Entry {
    std::string_view name;
    std::array<std::string_view, 2> aliases = {};
    int year = 0;
    bool film = false;  ///< measured on a film
    std::string_view source;
    int formula = 0;  ///< number of a dispersion formula, 0 for none
    std::array<double, kMostCoefficients> coefficients = {};  ///< trailing zeros are ignored
    WavelengthRange range = {};                               ///< of the formula or model
    bool in_air = false;  ///< formula published for air: index and wavelengths in air of 20 C
    std::span<const Row> nk = {};
    std::span<const Point> n = {};
    std::span<const Point> k = {};
    double plasma_ev = 0;                                        ///< of the Lorentz-Drude model
    std::span<const LorentzDrude::Oscillator> oscillators = {};  ///< if not empty, the
                                                                 ///< Lorentz-Drude model applies
    Outside outside = Outside::refuse;
};

#include "core/material/data/Ag-McPeak.inc"
#include "core/material/data/Ag-Yang.inc"
#include "core/material/data/Ag.inc"
#include "core/material/data/Al-Rakic.inc"
#include "core/material/data/Al.inc"
#include "core/material/data/AlGaAs-30.inc"
#include "core/material/data/AlGaAs-90.inc"
#include "core/material/data/Au-McPeak.inc"
#include "core/material/data/Au.inc"
#include "core/material/data/Cr.inc"
#include "core/material/data/Cu.inc"
#include "core/material/data/Fe.inc"
#include "core/material/data/Fe2O3.inc"
#include "core/material/data/GaAs.inc"
#include "core/material/data/Ge.inc"
#include "core/material/data/Hg.inc"
#include "core/material/data/ITO.inc"
#include "core/material/data/MgF2-film.inc"
#include "core/material/data/Nb2O5.inc"
#include "core/material/data/Ni.inc"
#include "core/material/data/PDMS.inc"
#include "core/material/data/PET.inc"
#include "core/material/data/PMMA.inc"
#include "core/material/data/Pd.inc"
#include "core/material/data/Pt.inc"
#include "core/material/data/Si-Aspnes.inc"
#include "core/material/data/Si.inc"
#include "core/material/data/Si3N4-Vogt.inc"
#include "core/material/data/SiO-k.inc"
#include "core/material/data/SiO-n.inc"
#include "core/material/data/SiO2-film.inc"
#include "core/material/data/Ta2O5.inc"
#include "core/material/data/Ti.inc"
#include "core/material/data/TiN.inc"
#include "core/material/data/TiO2-anatase.inc"
#include "core/material/data/TiO2.inc"
#include "core/material/data/W.inc"
#include "core/material/data/ZnO-film.inc"
#include "core/material/data/ZnS-k.inc"
#include "core/material/data/ZnSe-k.inc"
#include "core/material/data/ZrO2.inc"
#include "core/material/data/brass.inc"
#include "core/material/data/lorentz-drude.inc"
#include "core/material/data/polycarbonate.inc"
#include "core/material/data/polystyrene.inc"
#include "core/material/data/silk-k.inc"
#include "core/material/data/water-Hale.inc"

constexpr std::string_view kSchott =
    "SCHOTT optical glass catalogue (2017-01-20). Glass, 20 C, measured in air, converted to "
    "vacuum. Its very small k is left out.";
constexpr std::string_view kAspnesStudna =
    "D. E. Aspnes and A. A. Studna, Phys. Rev. B 27, 985 (1983). Crystal, ellipsometry, room "
    "temperature.";
constexpr std::string_view kJohnsonChristy1972 =
    "P. B. Johnson and R. W. Christy, Phys. Rev. B 6, 4370 (1972). Evaporated films, room "
    "temperature.";
constexpr std::string_view kJohnsonChristy1974 =
    "P. B. Johnson and R. W. Christy, Phys. Rev. B 9, 5056 (1974). Evaporated films, room "
    "temperature.";
constexpr std::string_view kRakic =
    "A. D. Rakic et al., Appl. Opt. 37, 5271 (1998). Lorentz-Drude model fitted to published data.";
constexpr std::string_view kZhang =
    "X. Zhang et al., Appl. Opt. 59, 2337 (2020). Commercial sheet, room temperature. Its very "
    "small k is left out.";

constexpr Entry kEntries[] = {
#include "core/material/data/materials.inc"
};

constexpr auto kNames = [] {
    std::array<std::string_view, std::size(kEntries)> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kEntries[i].name;
    return names;
}();

template <class Element>
Table column(std::span<const Element> rows, double Element::*value) {
    Table table;
    table.wavelength_nm.reserve(rows.size());
    table.value.reserve(rows.size());
    for (const Element& row : rows) {
        table.wavelength_nm.push_back(row.nm);
        table.value.push_back(row.*value);
    }
    return table;
}

Formula formula_of(const Entry& entry) {
    const auto last = std::find_if(entry.coefficients.rbegin(), entry.coefficients.rend(),
                                   [](double value) { return value != 0; });
    return {entry.formula,
            {entry.coefficients.begin(), last.base()},
            entry.range,
            {entry.in_air, entry.in_air, 20}};
}

decltype(Material::model) model_of(const Entry& entry) {
    if (!entry.oscillators.empty())
        return LorentzDrude{
            1, entry.plasma_ev, {entry.oscillators.begin(), entry.oscillators.end()}, entry.range};
    RefractiveIndex index;
    if (!entry.nk.empty())
        return RefractiveIndex{column(entry.nk, &Row::n), column(entry.nk, &Row::k)};
    if (!entry.n.empty())
        index.n = column(entry.n, &Point::value);
    else if (entry.formula != 0)
        index.n = formula_of(entry);
    if (!entry.k.empty()) index.k = column(entry.k, &Point::value);
    return index;
}

}  // namespace

std::span<const std::string_view> library_names() {
    return kNames;
}

std::optional<LibraryMaterial> find_material(std::string_view name) {
    const auto answers = [name](const Entry& entry) {
        return entry.name == name || std::ranges::count(entry.aliases, name) > 0;
    };
    const auto* const entry = std::ranges::find_if(kEntries, answers);
    if (entry == std::end(kEntries) || name.empty()) return std::nullopt;
    LibraryMaterial found{Material{std::string(entry->name), model_of(*entry), entry->outside},
                          std::string(entry->source),
                          entry->year,
                          entry->film,
                          {}};
    for (const std::string_view alias : entry->aliases)
        if (!alias.empty()) found.aliases.emplace_back(alias);
    return found;
}

std::vector<std::string> library_names_and_aliases() {
    std::vector<std::string> names;
    for (const std::string_view name : library_names()) {
        const std::optional<LibraryMaterial> found = find_material(name);
        names.emplace_back(name);
        names.insert(names.end(), found->aliases.begin(), found->aliases.end());
    }
    return names;
}

}  // namespace irido
