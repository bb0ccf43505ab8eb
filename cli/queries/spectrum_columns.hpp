#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/queries/spectrum_answers.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// Optional columns, in addition to R, T and A.
enum class SpectrumColumn {
    r_re,
    r_im,
    t_re,
    t_im,
    psi_deg,
    delta_deg,
    A_layers,
    delta_nebraska_deg,
    N,
    C,
    S,
    depolarization,
    phase_r_deg,
    phase_t_deg,
    gd_r_fs,
    gd_t_fs,
    gdd_r_fs2,
    gdd_t_fs2,
    tod_r_fs3,
    tod_t_fs3,
};

/// The names of all columns.
std::span<const std::string_view> spectrum_column_names();

/// Parses "r_re,psi_deg" into columns, in that order; none for "". Throws UsageError for unknown or
/// repeated names.
std::vector<SpectrumColumn> parse_spectrum_columns(std::string_view text);

/// The quantities required for rows with these polarizations (letters of "spu") and columns. Throws
/// UsageError if a column is undefined for one of the polarizations or for the stack.
SpectrumNeeds spectrum_needs(const std::string& polarizations,
                             const std::vector<SpectrumColumn>& columns, const StackPower& stack);

/// Names of the numeric columns, R, T, A and the optional ones, for a stack of `layers` layers.
std::vector<std::string> spectrum_number_names(const std::vector<SpectrumColumn>& columns,
                                               std::size_t layers);

/// Dimensions of rows sorted by angle, then polarization, then wavelength.
struct SpectrumShape {
    std::size_t angles;
    std::string_view polarizations;  ///< letters of "spu"
    std::size_t wavelengths;
    bool has_ellipsometry = true;  ///< whether the first polarization's rows, and only they, have
                                   ///< the columns that describe s and p together

    std::size_t rows() const { return angles * polarizations.size() * wavelengths; }
};

/// Appends rows to numeric columns.
/// shape    numbers of angles, polarizations and wavelengths
/// columns  the optional columns
/// layers   number of layers listed by A_layers
/// answers  the values, [angle][wavelength]
/// to       one column per name of spectrum_number_names()
void append_spectrum_numbers(const SpectrumShape& shape, const std::vector<SpectrumColumn>& columns,
                             std::size_t layers, const SpectrumAnswers& answers,
                             std::vector<tables::Column::Numbers>& to);

}  // namespace irido::cli
