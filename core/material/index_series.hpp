#pragma once

#include "core/material/material.hpp"
#include "core/math/series.hpp"

namespace irido {

/// 1 + x, the optical frequency over that at the wavelength where series are developed.
Series<double> relative_frequency();

/// n + i k near a vacuum wavelength as a series in x = (w - w0)/w0, w the optical frequency and w0
/// that of the wavelength: exact derivatives of formulas; of tables those of the straight line
/// between two rows (at a row, the one towards longer wavelengths). Where an end value holds,
/// outside a range, nothing varies. Throws DomainError as index_at() does.
Series<Complex> index_series(const Material& material, double wavelength_nm);

/// The same of extraordinary_index_at().
Series<Complex> extraordinary_series(const Material& material, double wavelength_nm);

/// Whether the derivatives are those of straight lines between rows.
bool has_rows(const Material& material);

}  // namespace irido
