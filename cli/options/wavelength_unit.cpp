#include "cli/options/wavelength_unit.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>

#include "cli/options/list.hpp"
#include "cli/options/words.hpp"
#include "core/error.hpp"
#include "core/material/material.hpp"
#include "core/math/constants.hpp"

namespace irido::cli {

namespace {

constexpr std::array kUnits{
    WavelengthUnit{"nm", "wavelength_nm", 1, 0},
    WavelengthUnit{"um", "wavelength_um", 1e-3, 0},
    WavelengthUnit{"eV", "energy_eV", 0, kPhotonEnergy_eVnm},
    WavelengthUnit{"cm-1", "wavenumber_per_cm", 0, 1e7},
};

/// Makes 0.38 um exactly 380 nm, not an adjacent double that may lie outside a material's range.
double without_rounding(double nm) {
    constexpr double kDigits = 1e9, kRounding = 1e-15;
    const double rounded = std::round(nm * kDigits) / kDigits;
    return std::abs(rounded - nm) <= kRounding * nm ? rounded : nm;
}

}  // namespace

double WavelengthUnit::to_nm(double value) const {
    if (per_nm == 1) return value;
    return without_rounding(per_nm > 0 ? value / per_nm : times_nm / value);
}

double WavelengthUnit::from_nm(double nm) const {
    return per_nm > 0 ? nm * per_nm : times_nm / nm;
}

void add_unit_option(CLI::App& command, std::string& unit) {
    command
        .add_option("--unit", unit,
                    "unit of --wavelengths and of their column: nm, um, eV (photon\n"
                    "energy) or cm-1 (wavenumber) [nm]")
        ->type_name("UNIT");
    offer(command, "unit", "nm um eV cm-1");
}

const WavelengthUnit& parse_unit(const std::string& text) {
    const auto found = std::ranges::find(kUnits, text, &WavelengthUnit::name);
    if (found != kUnits.end()) return *found;
    std::vector<std::string_view> names;
    for (const WavelengthUnit& unit : kUnits) names.push_back(unit.name);
    throw UsageError("--unit: " + not_one_of(names, text));
}

bool is_wavelength_column(std::string_view column) {
    return std::ranges::find(kUnits, column, &WavelengthUnit::column) != kUnits.end();
}

TypedWavelengths::TypedWavelengths(const std::string& list, const std::string& unit,
                                   const std::string& otherwise_nm)
    : unit_(&parse_unit(unit)) {
    if (unit_->per_nm == 1 || list.empty()) {
        nm_ = parse_list("--wavelengths", list.empty() ? otherwise_nm : list,
                         kAllWavelengths.first_nm, kAllWavelengths.last_nm);
        return;
    }
    const double first = unit_->from_nm(kAllWavelengths.first_nm),
                 last = unit_->from_nm(kAllWavelengths.last_nm);
    const double least = std::min(first, last), most = std::max(first, last);
    for (const double value :
         parse_list("--wavelengths, " + std::string(unit_->name), list, least, most)) {
        nm_.push_back(
            std::clamp(unit_->to_nm(value), kAllWavelengths.first_nm, kAllWavelengths.last_nm));
        typed_.emplace_back(nm_.back(), value);
    }
    std::ranges::stable_sort(typed_, {}, &std::pair<double, double>::first);
}

schemas::InputError TypedWavelengths::with_unit(const schemas::InputError& error) const {
    if (unit_->per_nm == 1) return error;
    return {error.file, error.where,
            error.message + "; --wavelengths are in " + std::string(unit_->name)};
}

double TypedWavelengths::printed(double nm) const {
    if (unit_->per_nm == 1) return nm;
    const auto found = std::ranges::lower_bound(typed_, nm, {}, &std::pair<double, double>::first);
    return found != typed_.end() && found->first == nm ? found->second : unit_->from_nm(nm);
}

}  // namespace irido::cli
