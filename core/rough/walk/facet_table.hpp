#pragma once

#include <span>
#include <vector>

#include "core/rough/layered/layer_transport.hpp"

namespace irido {

/// Functions of an angle at many wavelengths on a uniform grid of angles, interpolated linearly:
/// for simulations, whose noise is far larger than the error.
class AngleTable {
public:
    AngleTable() = default;
    /// Tabulates `count` values at each of `steps` + 1 angles from 0 to 90 degrees.
    AngleTable(std::size_t steps, std::size_t count);

    std::span<float> row(std::size_t step) {
        return std::span(values_).subspan(step * count_, count_);
    }
    std::size_t steps() const { return steps_; }
    double theta_deg(std::size_t step) const {
        return 90 * static_cast<double>(step) / static_cast<double>(steps_);
    }

    /// The values at an angle.
    void at(double theta_deg, std::span<double> out) const;

private:
    std::size_t steps_ = 0, count_ = 0;
    std::vector<float> values_;  ///< [step][value]
};

/// R of a layer's facets, then T, over theta_d: [R at all wavelengths, T at all].
AngleTable facet_table(const LayerTransport& layer, const std::vector<double>& wavelength_nm,
                       unsigned threads);

/// f_t cos of a layer relative to its masking over the angle of incidence.
AngleTable straight_table(const LayerTransport& layer, const std::vector<double>& wavelength_nm,
                          Crossings crossings, unsigned threads);

}  // namespace irido
