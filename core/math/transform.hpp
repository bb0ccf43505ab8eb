#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/complex.hpp"

namespace irido {

/// Chebyshev coefficients of the polynomial through values at the Chebyshev points of the second
/// kind, x_j = cos(pi j / degree), j = 0 .. degree: f(x) = sum_k c_k T_k(x). The matrix is
/// symmetric, so the same transform turns the moments of a weight against T_k into the weights of
/// the interpolatory rule on these points. It is a type-I discrete cosine transform: an FFT, or, up
/// to kPlainDegree, direct sums that need no plan.
/// Source: J. P. Boyd, Chebyshev and Fourier Spectral Methods (2001), section 5.5.
class ChebyshevTransform {
public:
    explicit ChebyshevTransform(std::size_t degree);  ///< degree >= 1
    ~ChebyshevTransform();
    ChebyshevTransform(const ChebyshevTransform&) = delete;
    ChebyshevTransform& operator=(const ChebyshevTransform&) = delete;

    /// Coefficients from values. `in` and `out` have degree + 1 entries each and must not overlap.
    /// Thread-safe.
    void operator()(std::span<const double> in, std::span<double> out) const;

    static constexpr std::size_t kPlainDegree = 128;

private:
    struct Plan;
    void sum(std::span<const double> in, std::span<double> out) const;

    std::size_t degree_;
    std::vector<double> cosine_;  ///< of pi j / degree, j below 2 degree, up to kPlainDegree
    std::unique_ptr<Plan> plan_;  ///< above kPlainDegree
};

/// Matrix rows that turn a polynomial's values at the Chebyshev points of one degree into its
/// slopes there: slope[i] = sum_j rows[i * stride + j] (value[j] - c) for any c. Differences of
/// cosines are formed as products of sines.
///   degree  of the polynomial, >= 1
///   stride  at least degree + 1; the rest of each row is zero
/// Source: L. N. Trefethen, Spectral Methods in MATLAB (2000), theorem 7.
std::vector<double> chebyshev_slopes(std::size_t degree, std::size_t stride);

/// The transform of one degree, built on first use. Thread-safe.
const ChebyshevTransform& chebyshev_transform(std::size_t degree);

/// Fourier sums of weights at unequally spaced points, for several sets of weights at the same
/// points,
///     F[c][k] = sum_i weights[c][i] exp(2 pi i turns[i] k),   k = 0 .. count - 1,
/// each within 1e-13 of sum_i |weights[c][i]|: the weights are spread onto an equally spaced grid
/// by a kernel exp(b sqrt(1 - z^2)), one FFT follows, and the kernel's transform is divided out.
///   turns    positions in [-1/2, 1/2], else DomainError
///   weights  one vector per set, as long as `turns`
///   count    number of harmonics, >= 1
/// Source: A. H. Barnett, J. Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019),
/// section 3, type 1.
std::vector<std::vector<Complex>> transform_of_points(std::span<const double> turns,
                                                      std::span<const std::vector<double>> weights,
                                                      std::size_t count);

}  // namespace irido
