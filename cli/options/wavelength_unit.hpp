#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace irido::cli {

/// What --wavelengths and its column are in.
struct WavelengthUnit {
    std::string_view name;    ///< as typed
    std::string_view column;  ///< of the output
    double per_nm;            ///< a wavelength is nm per_nm in the unit; 0 for
    double times_nm;          ///< energies and wavenumbers, which are times_nm / nm

    double to_nm(double value) const;
    double from_nm(double nm) const;
};

/// The LIST of spectra if none is typed.
inline constexpr const char* kUsualWavelengths_nm = "380:780:1";

/// --unit
void add_unit_option(CLI::App& command, std::string& unit);

/// Throws UsageError.
const WavelengthUnit& parse_unit(const std::string& text);

/// Whether a column is that of a unit.
bool is_wavelength_column(std::string_view column);

/// Wavelengths in nm, with what was typed for them.
class TypedWavelengths {
public:
    TypedWavelengths() : unit_(&parse_unit("nm")) {}
    /// A LIST in the unit, [1, 1e7] nm; "" is another one in nm. Throws UsageError.
    TypedWavelengths(const std::string& list, const std::string& unit,
                     const std::string& otherwise_nm);

    const WavelengthUnit& unit() const { return *unit_; }
    const std::vector<double>& nm() const { return nm_; }
    /// What a wavelength is printed as: the number that was typed for it, if there is one.
    double printed(double nm) const;

private:
    const WavelengthUnit* unit_;
    std::vector<double> nm_;
    std::vector<std::pair<double, double>> typed_;  ///< by nm; none if the unit is nm
};

}  // namespace irido::cli
