#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/truth/color_cases.hpp"

namespace irido::cli {

/// Errors of a method's colours in one case, and the time per colour.
struct MethodReport {
    double colors = 0;
    double evaluations = 0;                      ///< mean number of wavelengths per colour
    double ns_per_color = 0;                     ///< see ColorComparison
    double max_error = 0;                        ///< of X, Y, Z
    double mean_de = 0, p95_de = 0, max_de = 0;  ///< CIEDE2000
    // where CIEDE2000 is largest
    std::string worst_stack;
    double worst_angle_deg = 0;
    std::string worst_hex, exact_hex;
};

/// Equally spaced wavelengths that match another method's error; all 0 if none do.
struct EqualMatch {
    double wavelengths = 0, ns_per_color = 0;
};

/// Compares methods on the colours of one case: reflected unpolarized light, one thread, as in a
/// run over very many colours. The exact colours are those of quadrature at 1e-11. Times are the
/// fastest of repeated runs; for a set they include preparing each stack's algorithm.
class ColorComparison {
public:
    /// tables    of the observer and the illuminant
    /// families  the case's stacks
    /// is_set    whether times include preparation
    /// seconds   time spent on each timing
    /// simd      instruction set
    ColorComparison(const ColorTables& tables, std::vector<ColorFamily> families, bool is_set,
                    double seconds, SimdLevel simd);

    /// Empty if the method cannot compute the stacks.
    std::optional<MethodReport> measure(const ColorMethod& method, double tolerance) const;

    /// The fewest equally spaced wavelengths, up to kMostEqual, with at most this error of X, Y, Z:
    /// found by doubling, then bisection to within 3 % (the error is not monotonic).
    EqualMatch equal_match(double max_error);

    static constexpr std::size_t kMostEqual = 1U << 16;

private:
    using Algorithms = std::vector<std::unique_ptr<ColorAlgorithm>>;  ///< one per family
    struct Run {
        std::vector<StackColor> colors;
        double ns_per_color = 0;
    };

    ColorRequest request(double tolerance) const;
    Algorithms algorithms(const ColorMethod& method, const ColorRequest& request) const;
    void compute(const ColorAlgorithm& algorithm, const ColorFamily& family,
                 std::span<StackColor> colors) const;
    std::vector<StackColor> colors(const Algorithms& algorithms) const;
    Run run(const ColorMethod& method, double tolerance) const;
    double max_error(const std::vector<StackColor>& colors) const;
    double equal_error(std::size_t count);

    const ColorTables& tables_;
    std::vector<ColorFamily> families_;
    bool is_set_;
    double seconds_;
    SimdLevel simd_;
    std::size_t count_ = 0;  ///< colours
    std::vector<Triple> exact_;
    std::map<std::size_t, double> equal_errors_, equal_ns_;  ///< by count
};

}  // namespace irido::cli
