#pragma once

#include "core/material/material.hpp"
#include "core/math/series.hpp"

namespace irido {

/// 1 + x, the optical frequency relative to that at the expansion wavelength.
Series<double> relative_frequency();

/// n + i k around a vacuum wavelength as a series in x = (w - w0)/w0, with w the optical frequency
/// and w0 its value at that wavelength. Derivatives of formulas are exact; those of tables are the
/// slope between two rows (at a row, towards longer wavelengths). They vanish where an end value is
/// clamped. Throws DomainError as index_at() does.
Series<Complex> index_series(const Material& material, double wavelength_nm);

/// The series of extraordinary_index_at().
Series<Complex> extraordinary_series(const Material& material, double wavelength_nm);

/// Whether the derivatives are slopes between table rows.
bool has_rows(const Material& material);

}  // namespace irido
