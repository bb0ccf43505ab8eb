#include "tables/lut/measured/measured_bsdf.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"
#include "core/math/degrees.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/layered/lobe.hpp"
#include "tables/lut/measured/tensor_file.hpp"

namespace irido::tables {

namespace {

/// theta of a coordinate in the unit square, radians.
double theta_of_place(double x) {
    return 0.5 * kPi * x * x;
}

/// Projected area of the facets visible from a direction, 1 at the normal.
double seen_area(double alpha, double theta_rad) {
    return 1 / visibility(alpha, std::cos(theta_rad), std::sin(theta_rad));
}

/// A density on [0, 1], linear between equally spaced nodes, with inversion of its integral.
struct LinearDensity {
    std::vector<double> values, sums;  ///< at the nodes

    explicit LinearDensity(std::vector<double> densities) : values(std::move(densities)) {
        sums.assign(values.size(), 0);
        for (std::size_t k = 1; k < values.size(); ++k)
            sums[k] = sums[k - 1] + 0.5 * (values[k - 1] + values[k]);
    }

    /// The interval and the position in it.
    std::pair<std::size_t, double> at_share(double share) const {
        const double wanted = share * sums.back();
        const auto above = std::ranges::upper_bound(sums, wanted);
        const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            above - sums.begin() - 1, 0, static_cast<std::ptrdiff_t>(sums.size()) - 2));
        // solves a t + (b - a) t^2 / 2 = rest without cancellation
        const double a = values[k], b = values[k + 1], rest = wanted - sums[k];
        const double root = std::sqrt(std::max(0.0, a * a + 2 * (b - a) * rest));
        const double t = a + root > 0 ? 2 * rest / (a + root) : 0;
        return {k, std::clamp(t, 0.0, 1.0)};
    }
};

/// The visible normals for one direction over the unit square.
struct NormalSquare {
    std::vector<std::vector<double>> rows;  ///< density at nodes, [y][x]
    LinearDensity marginal{{1, 1}};

    NormalSquare(double alpha, double theta_i_rad, std::size_t nodes) {
        std::vector<double> totals;
        const auto last = static_cast<double>(nodes - 1);
        for (std::size_t j = 0; j < nodes; ++j) {
            const double phi = 2 * kPi * (static_cast<double>(j) / last) - kPi;
            std::vector<double> row;
            for (std::size_t i = 0; i < nodes; ++i) {
                const double x = static_cast<double>(i) / last, theta = theta_of_place(x);
                const double across = std::sin(theta_i_rad) * std::sin(theta) * std::cos(phi) +
                                      std::cos(theta_i_rad) * std::cos(theta);
                row.push_back(std::max(0.0, across) *
                              ggx_distribution(alpha, std::clamp(std::cos(theta), 0.0, 1.0)) * 2 *
                              kPi * kPi * x * std::sin(theta));
            }
            totals.push_back(LinearDensity(row).sums.back());
            rows.push_back(std::move(row));
        }
        marginal = LinearDensity(std::move(totals));
    }

    /// x and y of a sample.
    std::pair<double, double> operator()(double sx, double sy) const {
        const auto last = static_cast<double>(rows.size() - 1);
        const auto [j, t] = marginal.at_share(sy);
        std::vector<double> row(rows[j].size());
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = (1 - t) * rows[j][i] + t * rows[j + 1][i];
        const auto [i, u] = LinearDensity(std::move(row)).at_share(sx);
        return {(static_cast<double>(i) + u) / last, (static_cast<double>(j) + t) / last};
    }
};

std::vector<float> as_floats(std::span<const double> numbers) {
    std::vector<float> floats;
    floats.reserve(numbers.size());
    for (const double number : numbers) floats.push_back(static_cast<float>(number));
    return floats;
}

}  // namespace

std::string measured_bsdf(
    const MeasuredBsdf& bsdf,
    const std::function<std::vector<double>(std::span<const ScatterPair>)>& brdf) {
    const std::size_t T = bsdf.theta_i_deg.size(), W = bsdf.wavelength_nm.size();
    const std::size_t Nx = bsdf.normals, N = bsdf.samples;
    std::vector<double> ndf, sigma, vndf, luminance;
    for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t i = 0; i < Nx; ++i) {
            const double theta =
                theta_of_place(static_cast<double>(i) / static_cast<double>(Nx - 1));
            ndf.push_back(ggx_distribution(bsdf.alpha, std::clamp(std::cos(theta), 0.0, 1.0)));
            sigma.push_back(seen_area(bsdf.alpha, theta));
        }
    std::vector<float> spectra(T * W * N * N);
    for (std::size_t t = 0; t < T; ++t) {
        const double theta_i = bsdf.theta_i_deg[t] * kDegree;
        const NormalSquare square(bsdf.alpha, theta_i, Nx);
        for (const std::vector<double>& row : square.rows)
            vndf.insert(vndf.end(), row.begin(), row.end());
        std::vector<ScatterPair> pairs;
        std::vector<double> factors;
        for (std::size_t j = 0; j < N; ++j)
            for (std::size_t i = 0; i < N; ++i) {
                const auto last = static_cast<double>(N - 1);
                const auto [x, y] =
                    square(static_cast<double>(i) / last, static_cast<double>(j) / last);
                const double theta = theta_of_place(x), phi = 2 * kPi * y - kPi;
                const double mx = std::sin(theta) * std::cos(phi);
                const double my = std::sin(theta) * std::sin(phi), mz = std::cos(theta);
                const double across = std::sin(theta_i) * mx + std::cos(theta_i) * mz;
                const double ox = 2 * across * mx - std::sin(theta_i), oy = 2 * across * my;
                const double oz = std::abs(2 * across * mz - std::cos(theta_i));
                const double theta_o = std::atan2(std::hypot(ox, oy), oz) / kDegree;
                const double turn = std::abs(std::atan2(oy, ox)) / kDegree;
                pairs.push_back({bsdf.theta_i_deg[t], std::clamp(theta_o, 0.0, 90.0),
                                 std::clamp(turn, 0.0, 180.0)});
                factors.push_back(oz * 4 * seen_area(bsdf.alpha, theta_i) /
                                  ggx_distribution(bsdf.alpha, std::clamp(mz, 0.0, 1.0)));
            }
        const std::vector<double> f = brdf(pairs);
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            double mean = 0;
            for (std::size_t w = 0; w < W; ++w) {
                const double value = std::max(0.0, f[k * W + w] * factors[k]);
                spectra[(t * W + w) * N * N + k] = static_cast<float>(value);
                mean += value / static_cast<double>(W);
            }
            luminance.push_back(mean);
        }
    }
    std::vector<double> theta_i;
    for (const double theta : bsdf.theta_i_deg) theta_i.push_back(theta * kDegree);
    const std::vector<std::uint8_t> text(bsdf.description.begin(), bsdf.description.end());
    return tensor_file({
        {"description", {text.size()}, {}, text},
        {"jacobian", {1}, {}, {1}},
        {"phi_i", {1}, {0}, {}},
        {"theta_i", {T}, as_floats(theta_i), {}},
        {"ndf", {2, Nx}, as_floats(ndf), {}},
        {"sigma", {2, Nx}, as_floats(sigma), {}},
        {"vndf", {1, T, Nx, Nx}, as_floats(vndf), {}},
        {"luminance", {1, T, N, N}, as_floats(luminance), {}},
        {"wavelengths", {W}, as_floats(bsdf.wavelength_nm), {}},
        {"spectra", {1, T, W, N, N}, std::move(spectra), {}},
    });
}

}  // namespace irido::tables
