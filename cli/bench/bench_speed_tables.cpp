#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "cli/bench/bench_speed.hpp"
#include "cli/stopwatch.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/constants.hpp"
#include "core/rough/filter.hpp"
#include "core/truth/filter_reference.hpp"
#include "tables/lut/lut_maker.hpp"

namespace irido::cli {

namespace {

/// F_alpha as in FPB24: eq. 29 by the midpoint rule over psi.
double filter_by_sum(double alpha, double theta_i_deg, double theta_d_deg) {
    constexpr int kSamples = 1000;
    const double ti = theta_i_deg * kPi / 180, td = theta_d_deg * kPi / 180;
    const double a2 = alpha * alpha, cc = std::cos(ti) * std::cos(td),
                 ss = std::sin(ti) * std::sin(td);
    const double psi_max = ti + td > kPi / 2 ? std::acos(std::max(-1.0, -cc / ss)) : kPi;
    double sum = 0;
    for (int k = 0; k < kSamples; ++k) {
        const double x = cc + ss * std::cos(psi_max * (k + 0.5) / kSamples);
        const double width = 1 - (1 - a2) * x * x;
        sum += a2 / (kPi * width * width);
    }
    const double G1 = 2 / (1 + std::sqrt(1 + a2 * std::tan(ti) * std::tan(ti)));
    return 2 * G1 * G1 * std::cos(td) / std::cos(ti) * std::sin(td) * sum * psi_max / kSamples;
}

/// The filter of one roughness, with both angles in 0:89.75:0.25 degrees.
class FilterMeasurement {
public:
    FilterMeasurement(const SpeedCase& of, double budget)
        : case_(of), budget_(budget), filter_(of.alpha), axis_(angles(), "theta_d_deg") {
        for (std::size_t i = 0; i < kSamples; ++i) {
            // every second one in the peak, the rest anywhere
            const std::size_t theta_i = 1 + (i * 37 + 5) % (kAngles - 1);
            const auto width = static_cast<std::size_t>(of.alpha * 180 / std::numbers::pi * 4);
            const std::size_t theta_d = i % 2 == 0 ? theta_i + i % (width + 2) : i * 89;
            samples_.push_back({theta_i, 1 + theta_d % (kAngles - 1)});
            exact_.push_back(reference_filter(of.alpha, angle(samples_.back().theta_i),
                                              angle(samples_.back().theta_d)));
        }
    }

    SpeedRow by_closed_form(SimdLevel level) const {
        std::vector<double> row(kAngles);
        return measured(std::string(name_of(level)), [&](std::size_t theta_i) {
            filter_.row(angle(theta_i), axis_, row, level);
            return std::span<const double>(row);
        });
    }

    SpeedRow by_sum() const {
        std::vector<double> row(kAngles);
        return measured("sum_1000", [&](std::size_t theta_i) {
            for (std::size_t d = 0; d < kAngles; ++d)
                row[d] = filter_by_sum(case_.alpha, angle(theta_i), angle(d));
            return std::span<const double>(row);
        });
    }

private:
    static constexpr std::size_t kAngles = 360, kSamples = 60;
    /// Indices of two angles.
    struct Sample {
        std::size_t theta_i, theta_d;
    };

    static double angle(std::size_t index) { return 0.25 * static_cast<double>(index); }

    static std::vector<double> angles() {
        std::vector<double> all(kAngles);
        for (std::size_t i = 0; i < kAngles; ++i) all[i] = angle(i);
        return all;
    }

    /// row_of(theta_i) gives F at all theta_d; slow methods get fewer theta_i.
    template <class RowOf>
    SpeedRow measured(std::string method, const RowOf& row_of) const {
        [[maybe_unused]] volatile double sink = 0;
        const double one_row = seconds_of([&] { sink = row_of(kAngles / 2).front(); });
        const auto affordable = static_cast<std::size_t>(std::max(1.0, budget_ / one_row));
        const std::size_t rows = std::min(affordable, kAngles);
        SpeedRow row;
        row.name = case_.name;
        row.method = std::move(method);
        row.points = static_cast<double>(rows * kAngles);
        row.rate = row.points / best_seconds(budget_, [&] {
                       for (std::size_t i = 0; i < rows; ++i)
                           sink = row_of(kAngles * i / rows).back();
                   });
        for (std::size_t i = 0; i < kSamples; ++i) {
            const double F = row_of(samples_[i].theta_i)[samples_[i].theta_d];
            row.worst_F = std::max(row.worst_F, std::abs(F / exact_[i] - 1));
        }
        return row;
    }

    SpeedCase case_;
    double budget_;
    TransmissionFilter filter_;
    FilterAxis axis_;
    std::vector<Sample> samples_;
    std::vector<double> exact_;
};

}  // namespace

SpeedRow filter_row(const SpeedCase& of, SimdLevel level, double budget) {
    return FilterMeasurement(of, budget).by_closed_form(level);
}

SpeedRow filter_sum_row(const SpeedCase& of, double budget) {
    return FilterMeasurement(of, budget).by_sum();
}

SpeedRow table_row(const SpeedCase& of, const Execution& execution, double budget) {
    constexpr std::size_t angles = 64, values = 512;
    const tables::LutKind& kind = *tables::find_lut_kind("color");
    tables::LutRequest request;
    request.source = schemas::load_stack({std::string(of.expression), {}});
    request.document = schemas::read_stack({std::string(of.expression), {}});
    request.sensitivity = std::make_shared<Sensitivity>(observer(2), illuminant("D65"));
    request.illuminant = "D65";
    request.observer = "2";
    request.space = &rgb_space("srgb");
    request.color.simd = execution.simd;
    request.options["cos"] = tables::equally_spaced(0, 1, angles);
    request.vary = {{std::string(of.path), tables::equally_spaced(of.first, of.last, values)}};
    tables::LutMaking making;
    making.measure = false;
    making.threads = execution.threads;
    SpeedRow row;
    row.name = of.name;
    row.method = name_of(execution.simd);
    row.layers = of.layers;
    row.threads = execution.threads;
    row.points = angles * values;
    row.rate = row.points /
               best_seconds(budget, [&] { tables::make_lut(kind, kind.plan(request), making); });
    return row;
}

}  // namespace irido::cli
