#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/spectrum.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// The columns that can be asked for beside R, T and A.
enum class SpectrumColumn { r_re, r_im, t_re, t_im, psi_deg, delta_deg, A_layers };

/// Their names.
std::span<const std::string_view> spectrum_column_names();

/// "r_re,psi_deg", in the order typed; "" for none. Throws UsageError for names that are unknown
/// or doubled.
std::vector<SpectrumColumn> parse_spectrum_columns(std::string_view text);

/// What has to be computed for rows of these polarizations (letters of "spu") and these columns.
/// Throws UsageError if a column does not exist in one of the polarizations or for the stack.
Needs spectrum_needs(const std::string& polarizations, const std::vector<SpectrumColumn>& columns,
                     const StackPower& stack);

/// Names of the columns of numbers, R, T, A and those asked for, of a stack of so many layers.
std::vector<std::string> spectrum_number_names(const std::vector<SpectrumColumn>& columns,
                                               std::size_t layers);

/// Rows by angle, then polarization, then wavelength.
struct SpectrumShape {
    std::size_t angles;
    std::string_view polarizations;  ///< letters of "spu"
    std::size_t wavelengths;

    std::size_t rows() const { return angles * polarizations.size() * wavelengths; }
};

/// Appends the numbers of rows to columns, one of each name above.
void append_spectrum_numbers(const SpectrumShape& shape, const std::vector<SpectrumColumn>& columns,
                             std::size_t layers, const Spectra& spectra,
                             std::vector<tables::Column::Numbers>& to);

}  // namespace irido::cli
