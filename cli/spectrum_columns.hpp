#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/interference/spectrum.hpp"
#include "tables/records.hpp"

namespace irido {

/// The columns that can be asked for beside R, T and A.
enum class SpectrumColumn { r_re, r_im, t_re, t_im, psi_deg, delta_deg, A_layers };

/// "r_re,psi_deg", in the order typed; "" for none. Throws UsageError for names that are unknown
/// or doubled.
std::vector<SpectrumColumn> parse_spectrum_columns(std::string_view text);

/// What has to be computed for rows of these polarizations (letters of "spu") and these columns.
/// Throws UsageError if a column does not exist in one of the polarizations or for the stack.
Needs spectrum_needs(const std::string& polarizations, const std::vector<SpectrumColumn>& columns,
                     const StackPower& stack);

/// Rows by angle, then polarization, then wavelength.
Records spectrum_records(const std::vector<double>& wavelengths_nm,
                         const std::vector<double>& angles_deg, const std::string& polarizations,
                         const std::vector<SpectrumColumn>& columns, const Spectra& spectra);

}  // namespace irido
