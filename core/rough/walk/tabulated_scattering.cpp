#include "core/rough/walk/tabulated_scattering.hpp"

#include <numeric>

#include "core/coherent/coherent.hpp"
#include "core/math/constants.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

TabulatedScattering::TabulatedScattering(const LayeredScattering& scattering,
                                         const SampleRule& rule, Triple white, Paths paths,
                                         Crossings crossings, const Execution& execution)
    : scattering_(scattering),
      wavelength_nm_(rule.wavelength_nm),
      wavelengths_(rule.wavelength_nm.size()) {
    for (std::size_t c = 0; c < 3; ++c) {
        const double light = std::accumulate(rule.weight[c].begin(), rule.weight[c].end(), 0.0);
        for (const double weight : rule.weight[c]) weight_[c].push_back(white[c] * weight / light);
    }
    if (scattering.has_base()) base_ = scattering.base_factors(rule.wavelength_nm, paths);
    for (std::size_t l = 0; l < scattering.layers(); ++l) {
        facets_.push_back(facet_table(scattering.layer(l), rule.wavelength_nm, execution.threads));
        if (l + 1 < scattering.layers() || scattering.has_base())
            straight_.push_back(straight_table(scattering.layer(l), rule.wavelength_nm, crossings,
                                               execution.threads));
    }
}

TabulatedScattering::Direction TabulatedScattering::direction(double theta_deg) const {
    const Coating::Crossing at = scattering_.coating().inward(theta_deg);
    Direction direction{at.theta_deg, at.T, std::vector<double>(wavelengths_, 1)};
    std::vector<double> tau(wavelengths_);
    for (std::size_t l = 0; l < straight_.size(); ++l) {
        straight_[l].at(at.theta_deg, tau);
        const double G1 =
            smith_masking(scattering_.layer(l).alpha(), cos_of_incidence(at.theta_deg));
        for (std::size_t w = 0; w < wavelengths_; ++w)
            direction.straight.push_back(direction.straight[l * wavelengths_ + w] * G1 * tau[w]);
    }
    return direction;
}

Triple TabulatedScattering::operator()(const Direction& i, const Direction& o, double near,
                                       double far) const {
    return (*this)(i, o, MirrorFacets(i.theta_inside_deg, o.theta_inside_deg)(near, far));
}

Triple TabulatedScattering::operator()(const Direction& i, const Direction& o,
                                       const MirrorFacet& facet) const {
    const double factor = i.transmittance * o.transmittance * scattering_.coating().dilution();
    if (factor <= 0) return {};
    thread_local std::vector<double> R, sum;
    R.resize(wavelengths_);
    sum.assign(wavelengths_, 0);
    const auto add = [&](std::size_t l, double scale, const std::vector<double>& values) {
        const double* const in = i.straight.data() + l * wavelengths_;
        const double* const out = o.straight.data() + l * wavelengths_;
        for (std::size_t w = 0; w < wavelengths_; ++w) sum[w] += scale * values[w] * in[w] * out[w];
    };
    for (std::size_t l = 0; l < facets_.size(); ++l) {
        facets_[l].at(facet.theta_d_deg, R);
        add(l, factor * lobe(scattering_.layer(l).alpha(), facet), R);
    }
    if (!base_.empty()) add(facets_.size(), factor / kPi, base_);
    Triple xyz{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t w = 0; w < wavelengths_; ++w) xyz[c] += weight_[c][w] * sum[w];
    return xyz;
}

}  // namespace irido
