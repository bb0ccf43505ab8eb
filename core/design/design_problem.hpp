#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// One parameter of a material's model.
struct MaterialNumber {
    enum class Part {
        n,            ///< of a constant index
        k,            ///< of a constant index
        coefficient,  ///< of the formula of n; `index` among its coefficients
        n_row,        ///< of the table of n
        k_row,        ///< of the table of k
        eps_infinity,
        plasma,
        strength,  ///< of oscillator `index`
        damping,
        resonance,
    };
    std::size_t material = 0;  ///< index into Stack::materials
    Part part = Part::n;
    std::size_t index = 0;
    bool operator==(const MaterialNumber&) const = default;
};

/// What a free value controls in the stack. `Rebuilt` marks a value that only
/// DesignProblem::rebuild can set, differentiated by finite differences.
struct ThicknessOf {
    LayerPlace layer;
};
struct RepeatOf {
    LayerPlace group;
};
struct Rebuilt {};
using FreePlace = std::variant<ThicknessOf, RepeatOf, MaterialNumber, Rebuilt>;

/// A free value, applied at all its places at once.
struct FreeValue {
    std::string name;
    double start = 0;
    double low = 0, high = 0;  ///< closed bounds; may be infinite
    bool is_integer = false;
    std::vector<FreePlace> places;
};

enum class DesignQuantity {
    R,
    T,
    A,
    psi_deg,
    delta_deg,
    delta_nebraska_deg,
    phase_r_deg,
    phase_t_deg,
    gd_r_fs,
    gd_t_fs,
    gdd_r_fs2,
    gdd_t_fs2,
    tod_r_fs3,
    tod_t_fs3,
    lab,
    total_thickness_nm,  ///< of all layers, with groups expanded
};

/// Inequality targets: a residual counts only while the value is below (at_least) or above
/// (at_most) the target.
enum class TargetSide { equal, at_least, at_most };

/// Illuminant, observer and side of a colour target.
struct TargetLight {
    Table illuminant{};
    int observer_deg = 2;
    Side side = Side::reflected;
    bool operator==(const TargetLight&) const = default;
};

/// Target values of one quantity. Entries run over angles, then polarizations, then wavelengths;
/// psi and delta involve both polarizations and have one entry for the pair.
struct DesignTarget {
    DesignQuantity quantity = DesignQuantity::R;
    std::vector<double> wavelength_nm{};  ///< empty for lab and total_thickness_nm
    std::vector<double> angle_deg{};      ///< [0, 90)
    std::vector<Light> polarizations{Light::unpolarized};
    std::vector<double> target{};  ///< one per entry
    std::vector<Triple> lab{};     ///< for lab: one per entry
    std::vector<double> weight{};  ///< one per entry, >= 0
    std::vector<double> sigma{};   ///< one per entry, > 0
    TargetSide side = TargetSide::equal;
    TargetLight light{};  ///< for lab
};

enum class MeritKind {
    rms,           ///< sqrt(sum w e^2 / sum w)
    mean_abs,      ///< sum w |e| / sum w
    chi2,          ///< sum (e / sigma)^2
    delta_e_76,    ///< rms over the colours
    delta_e_2000,  ///< the same with CIEDE2000
};

/// A stack, its free values and its targets, as plain values.
struct DesignProblem {
    Stack stack;
    std::vector<FreeValue> free;
    std::vector<DesignTarget> targets;
    MeritKind merit = MeritKind::rms;
    /// Builds the stack for given values of `free`; required if any of them is Rebuilt.
    /// Thread-safe.
    std::function<Stack(const std::vector<double>&)> rebuild{};
};

/// Number of entries of a target.
inline std::size_t entry_count(const DesignTarget& target) {
    if (target.quantity == DesignQuantity::total_thickness_nm) return 1;
    if (target.quantity == DesignQuantity::lab)
        return target.angle_deg.size() * target.polarizations.size();
    const bool both = target.quantity == DesignQuantity::psi_deg ||
                      target.quantity == DesignQuantity::delta_deg ||
                      target.quantity == DesignQuantity::delta_nebraska_deg;
    return target.angle_deg.size() * target.wavelength_nm.size() *
           (both ? 1 : target.polarizations.size());
}

}  // namespace irido
