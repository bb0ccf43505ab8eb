#pragma once

#include <span>
#include <string_view>

#include "core/material/material.hpp"

namespace irido {

/// Relative spectral power of a CIE illuminant, linear between rows and zero outside.
///   D65, D50   5 nm rows, 300 to 830 nm;   100 at 560 nm
///   A          1 nm rows, 300 to 830 nm, from its formula;   100 at 560 nm
///   E          100 from 300 to 830 nm
///   FL2, FL11  5 nm rows, 380 to 780 nm
/// Throws DomainError listing the names if `name` is unknown.
/// Source: CIE 15, Colorimetry; ISO/CIE 11664-2.
Table illuminant(std::string_view name);

/// All names that illuminant() accepts, the default first.
std::span<const std::string_view> illuminant_names();

}  // namespace irido
