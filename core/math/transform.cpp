#include "core/math/transform.hpp"

#include <fftw3.h>

#include <map>
#include <mutex>
#include <vector>

namespace irido {

struct ChebyshevTransform::Plan {
    fftw_plan handle;
};

ChebyshevTransform::ChebyshevTransform(std::size_t degree)
    : degree_(degree), plan_(std::make_unique<Plan>()) {
    std::vector<double> in(degree + 1), out(degree + 1);
    // ESTIMATE, because measured plans depend on the machine's mood and with them the last digits
    plan_->handle = fftw_plan_r2r_1d(static_cast<int>(degree + 1), in.data(), out.data(),
                                     FFTW_REDFT00, FFTW_ESTIMATE | FFTW_UNALIGNED);
}

ChebyshevTransform::~ChebyshevTransform() {
    fftw_destroy_plan(plan_->handle);
}

void ChebyshevTransform::operator()(std::span<const double> in, std::span<double> out) const {
    std::vector<double> copy(in.begin(), in.end());  // FFTW's interface has no const
    fftw_execute_r2r(plan_->handle, copy.data(), out.data());
    const double scale = 1 / static_cast<double>(degree_);
    for (double& value : out) value *= scale;
    out.front() /= 2;
    out.back() /= 2;
}

void ChebyshevTransform::values(std::span<const double> coefficients, std::span<double> out) const {
    std::vector<double> halved(coefficients.begin(), coefficients.end());
    for (std::size_t k = 1; k < degree_; ++k) halved[k] /= 2;
    fftw_execute_r2r(plan_->handle, halved.data(), out.data());
}

std::vector<double> chebyshev_derivative(std::span<const double> coefficients) {
    std::vector<double> result(coefficients.size(), 0.0);
    for (std::size_t k = coefficients.size() - 1; k > 0; --k)
        result[k - 1] = (k + 1 < coefficients.size() ? result[k + 1] : 0.0) +
                        2 * static_cast<double>(k) * coefficients[k];
    result[0] /= 2;
    return result;
}

const ChebyshevTransform& chebyshev_transform(std::size_t degree) {
    static std::mutex lock;
    static std::map<std::size_t, ChebyshevTransform> transforms;
    const std::scoped_lock guard(lock);
    return transforms.try_emplace(degree, degree).first->second;
}

}  // namespace irido
