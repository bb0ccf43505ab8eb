#include "core/rough/layered/refracted_light.hpp"

#include <algorithm>
#include <cmath>

#include "core/color/baselines/bare_base.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/refraction_lobe.hpp"

namespace irido {

namespace {

/// Wavelengths 1 nm apart, and every other one of them for an estimate of the error.
constexpr std::size_t kRefractedWavelengths = 471, kHalfOfThem = 236;

}  // namespace

RefractedLight::RefractedLight(Stack stack, double alpha, const Execution& execution)
    : alpha_(alpha),
      execution_(execution),
      facets_(std::move(stack), Light::unpolarized, {Side::transmitted}, execution.simd) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    for (const std::size_t medium : {facets_.stack().incident, facets_.stack().substrate})
        if (is_uniaxial(facets_.stack().materials[medium]))
            throw DomainError("transmitted light takes isotropic media on both sides");
}

bool RefractedLight::is_constant() const {
    const Stack& stack = facets_.stack();
    return irido::is_constant(stack.materials[stack.incident]) &&
           irido::is_constant(stack.materials[stack.substrate]);
}

RefractedLight::Lobes RefractedLight::lobes(std::span<const ScatterPair> pairs,
                                            double wavelength_nm) const {
    const Stack& stack = facets_.stack();
    const Complex n_i = index_at(stack.materials[stack.incident], wavelength_nm);
    const Complex n_o = index_at(stack.materials[stack.substrate], wavelength_nm);
    if (n_o.imag() != 0)
        throw DomainError("transmitted light takes a substrate that does not absorb (got k = " +
                          to_text(n_o.imag()) + " at " + to_text(wavelength_nm) + " nm)");
    if (n_o.real() == n_i.real())
        throw DomainError(
            "light goes straight on where the substrate has the incident medium's index (see "
            "--quantity transmissivity)");
    Lobes lobes;
    for (const ScatterPair& pair : pairs) {
        const RefractingFacet facet = refracting_facet(n_i.real(), n_o.real(), pair.theta_i_deg,
                                                       pair.theta_o_deg, pair.phi_deg);
        lobes.theta_deg.push_back(facet.is_there ? facet.theta_deg : 0);
        lobes.scale.push_back(
            refraction_lobe(alpha_, n_o.real(), pair.theta_i_deg, pair.theta_o_deg, facet));
    }
    return lobes;
}

std::vector<double> RefractedLight::btdf(std::span<const ScatterPair> pairs,
                                         const std::vector<double>& wavelength_nm) const {
    const std::size_t W = wavelength_nm.size();
    std::vector<double> f(pairs.size() * W);
    // wavelengths that refract at the same facets
    const std::size_t together = is_constant() ? W : 1;
    for (std::size_t begin = 0; begin < W; begin += together) {
        const std::vector<double> some(
            wavelength_nm.begin() + static_cast<std::ptrdiff_t>(begin),
            wavelength_nm.begin() + static_cast<std::ptrdiff_t>(begin + together));
        const Lobes at = lobes(pairs, some.front());
        const std::vector<double> T = facets_.values(at.theta_deg, some);
        for (std::size_t p = 0; p < pairs.size(); ++p)
            for (std::size_t w = 0; w < together; ++w)
                f[p * W + begin + w] = at.scale[p] * T[p * together + w];
    }
    return f;
}

std::vector<SurfaceColor> RefractedLight::color(const ColorTables& tables,
                                                std::span<const ScatterPair> pairs,
                                                const ColorMethod& method, double tolerance) const {
    std::vector<SurfaceColor> colors(pairs.size());
    const Sensitivity& sensitivity = tables.sensitivity();
    if (!is_constant() && method.is("auto")) {
        const auto by_rule = [&](std::size_t count) {
            const SampleRule rule = equal_rule(sensitivity, count);
            std::vector<double> f = btdf(pairs, rule.wavelength_nm);
            for (double& value : f) value *= kPi;
            return sampled_colors(sensitivity, rule, f);
        };
        const std::vector<Triple> xyz = by_rule(kRefractedWavelengths);
        const std::vector<Triple> half = by_rule(kHalfOfThem);
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            colors[p].xyz = xyz[p];
            for (std::size_t c = 0; c < 3; ++c)
                colors[p].error = std::max(colors[p].error, std::abs(xyz[p][c] - half[p][c]));
        }
        return colors;
    }
    const Lobes at = lobes(pairs, kMiddle_nm);
    ColorRequest request;
    request.tolerance = std::max(kSmallestTolerance, tolerance / 2);
    request.colors = pairs.size();
    request.simd = execution_.simd;
    const bool is_known = !method.kind->needs_reflected_film;
    request.sides = {is_known ? Side::transmitted : Side::reflected};
    const std::vector<StackColor> found =
        stack_color(tables, facets_.stack(), method, request, at.theta_deg, execution_.threads);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const double scale = kPi * at.scale[p];
        for (std::size_t c = 0; c < 3; ++c) {
            const double T = found[p].xyz[c];
            colors[p].xyz[c] = scale * (is_known ? T : sensitivity.white()[c] - T);
        }
        colors[p].error = scale > 0 ? found[p].error * std::min(1.0, scale) : 0;
    }
    return colors;
}

}  // namespace irido
