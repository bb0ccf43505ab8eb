#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/rough/angle_series.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

/// R and T of a stack over the angle of incidence, the facets' theta_d in rough layers: what a
/// roughness then makes of them are moments. Each wavelength's series adapts to it alone and is
/// made once. Safe from many threads; a value depends on its own arguments only.
class FacetSeries {
public:
    /// Throws DomainError as StackPower does.
    FacetSeries(Stack stack, Light light, std::vector<Side> sides, SimdLevel simd);

    /// Computes the series of wavelengths that will be asked for. Throws DomainError as IndexTable
    /// does.
    void prepare(std::span<const double> wavelength_nm, unsigned threads) const;

    /// The functions are the sides, in their order; their error is far below 1e-10.
    std::shared_ptr<const AngleSeries> operator()(double wavelength_nm) const;
    std::vector<std::shared_ptr<const AngleSeries>> operator()(
        std::span<const double> wavelength_nm) const;

    /// Values [side][angle][wavelength] without a series; angles in [0, 90] degrees.
    std::vector<double> values(std::span<const double> theta_deg,
                               const std::vector<double>& wavelength_nm) const;

    const Stack& stack() const { return stack_; }

private:
    Stack stack_;
    StackPower power_;
    Light light_;
    ColorRequest request_;
    mutable std::mutex lock_;
    mutable std::map<double, std::shared_ptr<const AngleSeries>> series_;
};

}  // namespace irido
