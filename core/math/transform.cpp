#include "core/math/transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "core/math/gauss.hpp"
#include "core/math/vector_math.hpp"

namespace irido {

namespace {

/// FFTW's planner is not thread-safe; executing its plans is.
std::mutex& planner() {
    static std::mutex lock;
    return lock;
}

}  // namespace

struct ChebyshevTransform::Plan {
    fftw_plan handle;
};

ChebyshevTransform::ChebyshevTransform(std::size_t degree) : degree_(degree) {
    if (degree <= kPlainDegree) {
        for (std::size_t j = 0; j < 2 * degree; ++j)
            cosine_.push_back(
                std::cos(std::numbers::pi * static_cast<double>(j) / static_cast<double>(degree)));
        return;
    }
    plan_ = std::make_unique<Plan>();
    std::vector<double> in(degree + 1), out(degree + 1);
    const std::scoped_lock guard(planner());
    // ESTIMATE: measured plans vary from run to run, and the last digits with them
    plan_->handle = fftw_plan_r2r_1d(static_cast<int>(degree + 1), in.data(), out.data(),
                                     FFTW_REDFT00, FFTW_ESTIMATE | FFTW_UNALIGNED);
}

ChebyshevTransform::~ChebyshevTransform() {
    if (!plan_) return;
    const std::scoped_lock guard(planner());
    fftw_destroy_plan(plan_->handle);
}

void ChebyshevTransform::sum(std::span<const double> in, std::span<double> out) const {
    for (std::size_t k = 0; k <= degree_; ++k) {
        double sum = in[0] + (k % 2 == 0 ? in[degree_] : -in[degree_]);
        std::size_t at = 0;
        for (std::size_t j = 1; j < degree_; ++j) {
            at += k;
            if (at >= 2 * degree_) at -= 2 * degree_;
            sum += 2 * in[j] * cosine_[at];
        }
        out[k] = sum;
    }
}

void ChebyshevTransform::operator()(std::span<const double> in, std::span<double> out) const {
    if (plan_) {
        std::vector<double> copy(in.begin(), in.end());  // FFTW's interface lacks const
        fftw_execute_r2r(plan_->handle, copy.data(), out.data());
    } else {
        sum(in, out);
    }
    const double scale = 1 / static_cast<double>(degree_);
    for (double& value : out) value *= scale;
    out.front() /= 2;
    out.back() /= 2;
}

std::vector<double> chebyshev_slopes(std::size_t degree, std::size_t stride) {
    const auto half_angle = [&](std::size_t j) {
        return std::numbers::pi / 2 * static_cast<double>(j) / static_cast<double>(degree);
    };
    const auto end = [&](std::size_t j) { return j == 0 || j == degree ? 2.0 : 1.0; };
    std::vector<double> rows((degree + 1) * stride, 0.0);
    for (std::size_t i = 0; i <= degree; ++i) {
        double* row = rows.data() + i * stride;
        for (std::size_t j = 0; j <= degree; ++j) {
            if (i == j) continue;
            const double distance = 2 * std::sin(half_angle(i + j)) *
                                    std::sin(i < j ? half_angle(j - i) : -half_angle(i - j));
            row[j] = ((i + j) % 2 == 0 ? 1 : -1) * end(i) / end(j) / distance;
            row[i] -= row[j];
        }
    }
    return rows;
}

const ChebyshevTransform& chebyshev_transform(std::size_t degree) {
    static std::mutex lock;
    static std::map<std::size_t, ChebyshevTransform> transforms;
    const std::scoped_lock guard(lock);
    return transforms.try_emplace(degree, degree).first->second;
}

namespace {

/// Grid points that a weight is spread over, and the kernel's exponent: on a grid twice as fine as
/// the sums need, the aliased part of its transform is 1e-14.
constexpr std::size_t kTaps = 16;
constexpr double kHalfWidth = kTaps / 2.0, kExponent = 2.3 * kTaps;

/// Points spread per batch.
constexpr std::size_t kSpreadTogether = 128;

/// Smallest FFT-friendly length 2^a, 3 2^a or 5 2^a that is at least `least`.
std::size_t fast_length(std::size_t least) {
    std::size_t best = 1;
    while (best < least) best *= 2;
    for (const std::size_t factor : {3U, 5U}) {
        std::size_t length = factor;
        while (length < least) length *= 2;
        best = std::min(best, length);
    }
    return best;
}

/// Exponents of the kernel at the grid points around a point, starting with the first.
void kernel_exponents(double from_first, std::span<double> out) {
    for (std::size_t tap = 0; tap < kTaps; ++tap) {
        const double z = (static_cast<double>(tap) - from_first) / kHalfWidth;
        out[tap] = kExponent * (std::sqrt(std::max(0.0, 1 - z * z)) - 1);
    }
}

/// Spreads all weights onto grids of `length` points per turn.
void spread_points(std::span<const double> turns, std::span<const std::vector<double>> weights,
                   std::size_t length, std::vector<std::vector<double>>& grids) {
    const auto size = static_cast<double>(length);
    std::array<double, kSpreadTogether * kTaps> kernel{};
    std::array<std::size_t, kSpreadTogether> start{};
    for (std::size_t begin = 0; begin < turns.size(); begin += kSpreadTogether) {
        const std::size_t count = std::min(kSpreadTogether, turns.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const double turn = turns[begin + i];
            require_in_range("turns", turn, -0.5, 0.5);
            const double first = std::ceil(turn * size - kHalfWidth);
            start[i] = static_cast<std::size_t>(first + size) % length;
            kernel_exponents(std::fma(turn, size, -first),  // keeps the position's last digits
                             std::span(kernel).subspan(i * kTaps, kTaps));
        }
        const std::span used = std::span(kernel).first(count * kTaps);
        expm1(used, used, best_simd_level());
        for (double& value : used) value += 1;
        for (std::size_t c = 0; c < weights.size(); ++c)
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t tap = 0; tap < kTaps; ++tap)
                    grids[c][start[i] + tap] += weights[c][begin + i] * kernel[i * kTaps + tap];
    }
    for (std::vector<double>& grid : grids)  // wrap around what lies past the end
        for (std::size_t tap = 0; tap < kTaps; ++tap) grid[tap] += grid[length + tap];
}

/// Transform of the kernel at k = 0 .. count - 1, by quadrature over its width.
std::vector<double> kernel_transform(std::size_t length, std::size_t count) {
    std::vector<double> angle(count), sine(count), cosine(count), result(count, 0.0);
    for (const GaussNode& node : gauss_legendre<60>()) {
        if (node.x < 0) continue;  // the kernel is even
        const double weight = 2 * kHalfWidth * node.weight *
                              std::exp(kExponent * (std::sqrt(1 - node.x * node.x) - 1));
        const double step =
            2 * std::numbers::pi * kHalfWidth * node.x / static_cast<double>(length);
        for (std::size_t k = 0; k < count; ++k) angle[k] = step * static_cast<double>(k);
        sin_cos(angle, sine, cosine, best_simd_level());
        for (std::size_t k = 0; k < count; ++k) result[k] += weight * cosine[k];
    }
    return result;
}

}  // namespace

std::vector<std::vector<Complex>> transform_of_points(std::span<const double> turns,
                                                      std::span<const std::vector<double>> weights,
                                                      std::size_t count) {
    const std::size_t length = fast_length(std::max(4 * count, 2 * kTaps));
    std::vector<std::vector<double>> grids(weights.size(),
                                           std::vector<double>(length + kTaps, 0.0));
    spread_points(turns, weights, length, grids);
    const std::vector<double> kernel = kernel_transform(length, count);
    std::vector<Complex> sums(length / 2 + 1);
    auto* const out = reinterpret_cast<fftw_complex*>(sums.data());
    fftw_plan plan = nullptr;
    {
        const std::scoped_lock guard(planner());
        plan = fftw_plan_dft_r2c_1d(static_cast<int>(length), grids.front().data(), out,
                                    FFTW_ESTIMATE | FFTW_UNALIGNED);
    }
    std::vector<std::vector<Complex>> result(weights.size());
    for (std::size_t c = 0; c < weights.size(); ++c) {
        fftw_execute_dft_r2c(plan, grids[c].data(), out);
        result[c].resize(count);
        // FFTW uses the opposite sign
        for (std::size_t k = 0; k < count; ++k) result[c][k] = std::conj(sums[k]) / kernel[k];
    }
    const std::scoped_lock guard(planner());
    fftw_destroy_plan(plan);
    return result;
}

}  // namespace irido
