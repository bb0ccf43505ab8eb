#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace irido {

/// Wavelengths of the rows of every observer: kFirstRow_nm + i, i in [0, kObserverRows).
inline constexpr double kFirstRow_nm = 360;
inline constexpr std::size_t kObserverRows = 471;

/// Colour-matching functions, one row per nm from 360 to 830 nm, linear between rows and zero
/// outside. The CIE tabulates them for standard air; here they are functions of the vacuum
/// wavelength, which is 0.03 % longer (at most 0.23 nm).
struct Observer {
    std::string_view name;
    std::span<const double> x, y, z;  ///< xbar, ybar, zbar
};

/// The CIE 1931 2-degree or the CIE 1964 10-degree standard observer; DomainError for any other
/// field size.
/// Source: CIE 15, Colorimetry; ISO/CIE 11664-1.
const Observer& observer(int degrees);

}  // namespace irido
