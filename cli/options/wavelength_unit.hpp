#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schemas/input_error.hpp"

namespace CLI {
class App;
}

namespace irido::cli {

/// The unit of --wavelengths and its column.
struct WavelengthUnit {
    std::string_view name;    ///< value of --unit
    std::string_view column;  ///< name of the output column
    double per_nm;            ///< a wavelength in this unit is nm per_nm; 0 for
    double times_nm;          ///< energies and wavenumbers, which are times_nm / nm

    double to_nm(double value) const;
    double from_nm(double nm) const;
};

/// The default LIST of spectra.
inline constexpr const char* kUsualWavelengths_nm = "380:780:1";

/// Adds --unit.
void add_unit_option(CLI::App& command, std::string& unit);

/// Parses a unit. Throws UsageError.
const WavelengthUnit& parse_unit(const std::string& text);

/// Whether a column holds wavelengths in any of the units.
bool is_wavelength_column(std::string_view column);

/// Wavelengths in nm, with the numbers given for them.
class TypedWavelengths {
public:
    TypedWavelengths() : unit_(&parse_unit("nm")) {}
    /// A LIST in the unit, [1, 1e7] nm; if it is "", `otherwise_nm`. Throws UsageError.
    TypedWavelengths(const std::string& list, const std::string& unit,
                     const std::string& otherwise_nm);

    const WavelengthUnit& unit() const { return *unit_; }
    const std::vector<double>& nm() const { return nm_; }
    /// The error of a stack at these wavelengths; names their unit if it is not nm.
    schemas::InputError with_unit(const schemas::InputError& error) const;
    /// How a wavelength is printed: as the number given for it, if there is one.
    double printed(double nm) const;

private:
    const WavelengthUnit* unit_;
    std::vector<double> nm_;
    std::vector<std::pair<double, double>> typed_;  ///< by nm; empty if the unit is nm
};

}  // namespace irido::cli
