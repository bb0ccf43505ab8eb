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

/// R and T of a stack as a function of the angle of incidence, which is theta_d of the facets in a
/// rough layer; roughness then enters as moments. Each wavelength's series adapts independently and
/// is computed once. Thread-safe; values depend on their own arguments only.
class FacetSeries {
public:
    /// Throws DomainError as StackPower does.
    ///   stack  of the facets
    ///   light  polarization
    ///   sides  functions of the series, in this order
    ///   simd   instruction set
    FacetSeries(Stack stack, Light light, std::vector<Side> sides, SimdLevel simd);

    /// Computes the series of wavelengths needed later. Throws DomainError as IndexTable does.
    void prepare(std::span<const double> wavelength_nm, unsigned threads) const;

    /// Series whose functions are the sides, in order; their error is far below 1e-10.
    std::shared_ptr<const AngleSeries> operator()(double wavelength_nm) const;
    std::vector<std::shared_ptr<const AngleSeries>> operator()(
        std::span<const double> wavelength_nm) const;

    /// Values [side][angle][wavelength] computed directly; angles in [0, 90] degrees.
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
