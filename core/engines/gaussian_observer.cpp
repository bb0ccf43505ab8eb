#include "core/engines/gaussian_observer.hpp"

#include <cmath>
#include <numbers>

namespace irido {

namespace {

/// A Gaussian in the wavenumber 1/lambda (1/m).
struct WavenumberFit {
    std::size_t channel;
    double height, center, variance;
};
constexpr std::array kWavenumberFits{WavenumberFit{0, 5.4856e-13, 1.6810e6, 4.3278e9},
                                     WavenumberFit{0, 9.7470e-14, 2.2399e6, 4.5282e9},
                                     WavenumberFit{1, 4.4201e-13, 1.7953e6, 9.3046e9},
                                     WavenumberFit{2, 5.2481e-13, 2.2084e6, 6.6121e9}};
constexpr double kFitScale = 1.0685e-7;

}  // namespace

GaussianObserver::GaussianObserver(double opd_nm) : p_(2 * std::numbers::pi * 1e-9 * opd_nm) {
    for (std::size_t i = 0; i < kWavenumberFits.size(); ++i) {
        const WavenumberFit& fit = kWavenumberFits[i];
        heights_[i] = fit.height * std::sqrt(2 * std::numbers::pi * fit.variance) *
                      std::exp(-fit.variance * p_ * p_) / kFitScale;
    }
}

Triple GaussianObserver::operator()(const Triple& phase) const {
    Triple xyz{};
    for (std::size_t i = 0; i < kWavenumberFits.size(); ++i) {
        const WavenumberFit& fit = kWavenumberFits[i];
        if (heights_[i] != 0)
            xyz[fit.channel] += heights_[i] * std::cos(fit.center * p_ + phase[fit.channel]);
    }
    return xyz;
}

}  // namespace irido
