#pragma once

#include <cstddef>
#include <vector>

#include "core/colorimetry/sensitivity.hpp"

namespace irido {

/// X, Y and Z accumulated up to a wavelength,
///     C_j(lambda) = integral of s_j from the short end of the support to lambda,
/// exact: between the rows of observer and illuminant s_j is quadratic and C_j cubic.
/// Source: FPB24 eq. 16.
class CumulativeSensitivity {
public:
    explicit CumulativeSensitivity(const Sensitivity& sensitivity);

    /// At any wavelength: 0 below the support, the white above.
    Triple operator()(double wavelength_nm) const;

private:
    /// Polynomial between two rows: c0 + t (c1 + t (c2 + t c3)), t = wavelength - first.
    struct Cell {
        std::array<Triple, 4> c{};
    };
    WavelengthRange support_;
    Triple white_;
    std::vector<double> ends_;  ///< of the cells
    std::vector<Cell> cells_;
    std::vector<std::size_t> cell_at_;  ///< cell at each whole nanometre above the support's start
};

}  // namespace irido
