#pragma once

#include <cstddef>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A material that is not known over the whole visible range and holds its end values there.
struct HeldRange {
    std::size_t material = 0;  ///< index into Stack::materials
    WavelengthRange range;     ///< where it is known
    bool usable = true;        ///< false if it is not known over 400 to 700 nm, which colour needs
    Triple weight{};           ///< fraction of the X, Y, Z weight outside its range
};

/// Materials of the stack that are not known over the sensitivity's support and do not say clamp.
std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity);

/// The stack with materials that hold their end values outside their range. Throws DomainError if a
/// held range is not usable.
Stack held_stack(const Stack& stack, const Sensitivity& sensitivity);

/// The ends of `support` and the wavelengths between them where a material has a kink or ends,
/// ascending: the stack's spectra are smooth in between, but for rows of tables if these are left
/// out.
std::vector<double> smooth_pieces(const Stack& stack, WavelengthRange support,
                                  bool with_rows = true);

/// Whether k is 0 at every wavelength.
bool is_real(const Material& material);

}  // namespace irido
