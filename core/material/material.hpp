#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/complex.hpp"
#include "core/material/graded.hpp"
#include "core/material/mixing_rule.hpp"

namespace irido {

/// Closed range of vacuum wavelengths, nm.
struct WavelengthRange {
    double first_nm = 0;
    double last_nm = 0;
    bool operator==(const WavelengthRange&) const = default;
};

/// Behaviour outside the range of a material's data.
enum class Outside { refuse, clamp };

/// A wavelength-independent number.
struct Constant {
    double value = 0;
    bool operator==(const Constant&) const = default;
};

/// The medium to which an index and its wavelengths refer: vacuum, or air at 101325 Pa (air.hpp).
struct Reference {
    bool index_to_air = false;       ///< n is relative to the index of air
    bool wavelength_in_air = false;  ///< wavelengths are those in air
    double temperature_c = 20;       ///< of that air
    bool operator==(const Reference&) const = default;
};

/// One of the nine dispersion formulas of the refractiveindex.info database (n only). Formula 2 is
/// Sellmeier with squared poles, formula 5 is Cauchy's series.
///   number        1..9
///   coefficients  c1, c2, ... for wavelengths in um; missing ones are 0
///   range         vacuum wavelengths
///   reference     medium to which the formula's wavelengths and index refer
/// Source: M. N. Polyanskiy, Sci. Data 11, 94 (2024), and the database's definition sheet.
struct Formula {
    int number = 5;
    std::vector<double> coefficients;
    WavelengthRange range;
    Reference reference = {};
    bool operator==(const Formula&) const = default;
};

/// Piecewise linear in the vacuum wavelength. `wavelength_nm` is strictly increasing with at least
/// one row; a single row is valid at that wavelength only.
struct Table {
    std::vector<double> wavelength_nm;
    std::vector<double> value;
    bool operator==(const Table&) const = default;
};

/// n or k as a function of wavelength.
using Dispersion = std::variant<Constant, Formula, Table>;

/// n + i k as two real functions, each with its own range.
struct RefractiveIndex {
    Dispersion n = Constant{1};
    Dispersion k = Constant{0};
    bool operator==(const RefractiveIndex&) const = default;
};

/// eps(E) = eps_infinity + sum_j f_j wp^2 / (w_j^2 - E^2 - i E G_j), E = h c / lambda; the first
/// Drude term has w_j = 0. Source: A. D. Rakic et al., Appl. Opt. 37, 5271 (1998), eqs. 1-3.
struct LorentzDrude {
    struct Oscillator {
        double strength = 0;      ///< f_j
        double damping_ev = 0;    ///< G_j
        double resonance_ev = 0;  ///< w_j
        bool operator==(const Oscillator&) const = default;
    };
    double eps_infinity = 1;
    double plasma_ev = 0;  ///< wp
    std::vector<Oscillator> oscillators;
    WavelengthRange range;
    bool operator==(const LorentzDrude&) const = default;
};

struct Material;

/// A fine mixture of two media. parts: inclusion, host;  fraction: volume of the inclusion, [0, 1]
struct Mixture {
    MixingRule rule = MixingRule::bruggeman;
    double fraction = 0.5;
    std::vector<Material> parts;
    bool operator==(const Mixture& other) const;
};

/// A crystal, or layers finer than the wavelength, with the optic axis along the stack's normal. s
/// waves see the ordinary index only. parts: ordinary, extraordinary
struct Uniaxial {
    std::vector<Material> parts;
    bool operator==(const Uniaxial& other) const;
};

/// One slice of a graded layer, a uniaxial medium.
///   half, steps  as for GradedHalfStep
///   ends         materials at the layer's top and bottom, shared by all slices
struct GradedPart {
    GradedProfile profile = GradedProfile::n;
    std::size_t half = 0, steps = 1;
    std::shared_ptr<const std::vector<Material>> ends;
    bool operator==(const GradedPart& other) const;
};

/// Complex index of a medium, n + i k; k > 0 absorbs (fields vary as exp(-i w t)).
struct Material {
    std::string name;
    std::variant<RefractiveIndex, LorentzDrude, Mixture, Uniaxial, GradedPart> model;
    Outside outside = Outside::refuse;
    bool operator==(const Material&) const = default;
};

/// All vacuum wavelengths that irido accepts, nm.
inline constexpr WavelengthRange kAllWavelengths{1, 1e7};

/// Range in which both n and k are known; kAllWavelengths for constants; first_nm > last_nm if
/// empty. A mixture is known wherever its parts are known or clamped.
WavelengthRange range_of(const Material& material);

/// n + i k at one vacuum wavelength in kAllWavelengths. A material set to clamp holds the end
/// values of n and of k outside their respective ranges, as do the parts of such a mixture. Throws
/// DomainError naming the material, the range (of n or of k) and the wavelength, or the value if
/// the result is not an index that irido accepts: n in [0, 1e4], k in [-1e4, 1e4], |n + ik| >=
/// 1e-6.
Complex index_at(const Material& material, double wavelength_nm);

/// Whether p waves see a different index; index_at() is then that of s waves.
bool is_uniaxial(const Material& material);

/// The first uniaxial material, or nullptr.
const Material* first_uniaxial(std::span<const Material> materials);

/// n + i k along the stack's normal: the extraordinary index, or index_at(). Throws DomainError as
/// that does, and if one of the two absorbs while the other amplifies.
Complex extraordinary_index_at(const Material& material, double wavelength_nm);

/// Constituents of a material: the parts of a mixture or a uniaxial medium, the ends of a graded
/// layer; empty for others.
std::span<const Material> parts_of(const Material& material);

/// True if the index is the same at every wavelength.
bool is_constant(const Material& material);

/// Wavelengths strictly inside `between` where n or k has a kink; sorted, unique.
std::vector<double> kinks(const Material& material, WavelengthRange between);

/// Those kinks that are table rows, including the tables of mixtures; empty for uniaxial media.
std::vector<double> table_rows(const Material& material, WavelengthRange between);

}  // namespace irido
