#include "core/colorimetry/cumulative_sensitivity.hpp"

namespace irido {

CumulativeSensitivity::CumulativeSensitivity(const Sensitivity& sensitivity)
    : support_(sensitivity.support()),
      white_(sensitivity.white()),
      ends_(sensitivity.cells(sensitivity.support())) {
    Triple sum{};
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
        const double width = ends_[i + 1] - ends_[i];
        const Triple s0 = sensitivity.at(ends_[i]);
        const Triple s1 = sensitivity.at((ends_[i] + ends_[i + 1]) / 2);
        const Triple s2 = sensitivity.at(ends_[i + 1]);
        Cell cell;
        for (std::size_t c = 0; c < 3; ++c) {
            const double slope = (4 * s1[c] - 3 * s0[c] - s2[c]) / width;
            const double bend = 2 * (s0[c] - 2 * s1[c] + s2[c]) / (width * width);
            cell.c[0][c] = sum[c];
            cell.c[1][c] = s0[c];
            cell.c[2][c] = slope / 2;
            cell.c[3][c] = bend / 3;
            sum[c] += width * (s0[c] + width * (slope / 2 + width * bend / 3));
        }
        cells_.push_back(cell);
    }
    std::size_t cell = 0;
    for (double nm = support_.first_nm; nm < support_.last_nm; ++nm) {
        while (cell + 1 < cells_.size() && ends_[cell + 1] <= nm) ++cell;
        cell_at_.push_back(cell);
    }
}

Triple CumulativeSensitivity::operator()(double wavelength_nm) const {
    if (!(wavelength_nm > support_.first_nm)) return {};
    if (wavelength_nm >= support_.last_nm) return white_;
    std::size_t i = cell_at_[static_cast<std::size_t>(wavelength_nm - support_.first_nm)];
    while (ends_[i + 1] < wavelength_nm) ++i;
    const double t = wavelength_nm - ends_[i];
    const auto& c = cells_[i].c;
    Triple result{};
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = c[0][k] + t * (c[1][k] + t * (c[2][k] + t * c[3][k]));
    return result;
}

}  // namespace irido
