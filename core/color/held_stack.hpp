#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// A material whose data do not cover the visible range and are clamped there.
struct HeldRange {
    std::size_t material = 0;  ///< index into Stack::materials
    WavelengthRange range;     ///< where it has data
    bool usable = true;        ///< false if 400 to 700 nm, which colour needs, are not covered
    Triple weight{};           ///< fraction of the weight of X, Y, Z outside its range
};

/// Materials of the stack that lack data within the support and are not set to clamp.
std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity);

/// The stack with all materials clamped outside their range. Throws DomainError if a held range is
/// not usable.
Stack held_stack(const Stack& stack, const Sensitivity& sensitivity);

/// The ends of `support` and the wavelengths in between at which a material has a kink or its data
/// end, ascending: the stack's spectra are smooth from one to the next, except at table rows if
/// these are left out.
std::vector<double> smooth_pieces(const Stack& stack, WavelengthRange support,
                                  bool with_rows = true);

/// Whether k is 0 at every wavelength.
bool is_real(const Material& material);

/// Whether a material's k is known between the smooth_pieces() from what it is there.
bool is_surveyed(const Material& material);

/// The elements that hold varied layers, ascending. Throws DomainError if there is no such layer.
std::vector<std::size_t> varied_elements(const Stack& stack, std::span<const LayerPlace> varied);

}  // namespace irido
