#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/math/parallel.hpp"
#include "core/rough/layered/layered_color.hpp"

namespace irido::cli {

/// One way to evaluate a rough surface. What was not measured is NaN, an empty field.
struct LayeredRow {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::string name, method;
    double prepare_s = 0, evaluate_s = 0;
    double evaluations = 0;  ///< in evaluate_s: pairs of directions, paths or structures
    double smape = kNone;    ///< a part of 1
    double reference_s = kNone;
    double delta_e_mean = kNone, delta_e_max = kNone;
};

/// What a case is measured with.
struct LayeredBench {
    std::uint64_t samples = 0;  ///< paths of the reference
    double budget_s = 0;        ///< for repeating each measurement
    Execution one;              ///< one thread
};

/// 240 directions of view under a beam from 30 degrees.
std::vector<ScatterPair> bench_pairs();

/// Symmetric mean absolute error, a part of 1.
double smape(const std::vector<double>& values, const std::vector<double>& reference);

/// SMAPE of X, Y, Z and CIEDE2000 of colours, those that are brighter than white brought down
/// together.
void set_color_errors(const std::vector<Triple>& colors, const std::vector<Triple>& exact,
                      const Triple& white, LayeredRow& row);

// Cases that are colours, see the help of `irido bench layered`.
void add_film_dielectric(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_film_conductor(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_film_dispersive(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_film_spread(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_film_remapped(const LayeredBench& bench, std::vector<LayeredRow>& rows);
void add_landmarks(const LayeredBench& bench, std::vector<LayeredRow>& rows);

}  // namespace irido::cli
