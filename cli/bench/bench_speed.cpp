#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>

#include "cli/bench/bench.hpp"
#include "cli/bench/bench_speed.hpp"
#include "cli/stopwatch.hpp"
#include "core/math/parallel.hpp"
#include "core/math/vector_math.hpp"
#include "core/periodic/bragg.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/truth/reference.hpp"

namespace irido::cli {

namespace {

struct SpeedOptions {
    std::string time = "0.1";
    std::string cases = "all";
    OutputOptions output;
    bool quiet = false;
    unsigned threads = 0;
};

constexpr SpeedCase filter_case(double alpha, std::string_view name, std::string_view summary) {
    SpeedCase result{name, 0, summary};
    result.alpha = alpha;
    return result;
}

constexpr SpeedCase each_layer_case(std::string_view name, int layers, std::string_view summary,
                                    Stack (*stack)(int layers)) {
    SpeedCase result{name, layers, summary, stack};
    result.each_layer = true;
    return result;
}

constexpr SpeedCase table_case(std::string_view name, int layers, std::string_view summary,
                               const char* stack, const char* path, double first, double last) {
    SpeedCase result{name, layers, summary};
    result.expression = stack;
    result.path = path;
    result.first = first;
    result.last = last;
    return result;
}

Material constant(double n, double k = 0) {
    return {"", RefractiveIndex{Constant{n}, Constant{k}}};
}

/// `layers` distinct films; index(i) is the material of film i.
template <class Index>
Stack films(int layers, const Index& index) {
    Stack stack;
    stack.materials = {constant(1), constant(1.52)};
    stack.substrate = 1;
    for (int i = 0; i < layers; ++i) {
        stack.materials.push_back(index(i));
        stack.elements.push_back(
            {Layer{stack.materials.size() - 1, 50 + 100 * std::fmod(0.618 * i, 1)}});
    }
    return stack;
}

double index_of(int layer) {
    return 1.35 + std::fmod(0.382 * layer, 1);
}

Stack transparent(int layers) {
    return films(layers, [](int i) { return constant(index_of(i)); });
}

Stack absorbing(int layers) {
    return films(layers, [](int i) { return constant(index_of(i), 0.01); });
}

/// Films that absorb beyond 750 nm only.
Stack nearly_transparent(int layers) {
    const Table k{{300, 750, 780}, {0, 0, 0.01}};
    return films(layers, [&](int i) {
        return Material{"", RefractiveIndex{Constant{index_of(i)}, k}};
    });
}

Stack dispersive(int layers) {
    return films(layers, [](int i) {
        return Material{"", RefractiveIndex{Formula{5, {index_of(i), 0.005, -2}, kAllWavelengths},
                                            Constant{0}}};
    });
}

Stack periods(int layers) {
    Stack stack = transparent(2);
    stack.elements = {{Group{static_cast<std::uint64_t>(layers / 2), stack.elements}}};
    return stack;
}

Stack absorbing_periods(int layers) {
    Stack stack = absorbing(2);
    stack.elements = {{Group{static_cast<std::uint64_t>(layers / 2), stack.elements}}};
    return stack;
}

/// Periods between half-spaces with the index of one of the two films.
Stack hosted_periods(int layers) {
    Stack stack = periods(layers);
    stack.incident = stack.substrate =
        std::get<Layer>(std::get<Group>(stack.elements[0].value).elements[0].value).material;
    return stack;
}

constexpr std::array kCases{
    SpeedCase{"film", 1, "one transparent film", transparent},
    SpeedCase{"film_normal", 1, "one transparent film at 0 degrees", transparent, true},
    SpeedCase{"film_R", 1, "one transparent film, R only", transparent, false, true},
    SpeedCase{"film_absorbing", 1, "one absorbing film", absorbing},
    SpeedCase{"2", 2, "two transparent films", transparent},
    SpeedCase{"10", 10, "ten transparent films", transparent},
    SpeedCase{"10_absorbing", 10, "ten absorbing films", absorbing},
    SpeedCase{"40", 40, "40 transparent films", transparent},
    SpeedCase{"40_normal", 40, "40 transparent films at 0 degrees", transparent, true},
    SpeedCase{"40_dispersive", 40, "40 films with dispersion formulas", dispersive},
    SpeedCase{"40_absorbing", 40, "40 absorbing films", absorbing},
    SpeedCase{"40_nearly_transparent", 40, "40 films that absorb beyond 750 nm",
              nearly_transparent},
    each_layer_case("40_each", 40, "40 absorbing films, and what each absorbs", absorbing),
    each_layer_case("500_periods_each", 1000, "500 absorbing periods, and what each layer absorbs",
                    absorbing_periods),
    SpeedCase{"20_periods", 40, "20 periods of two films", periods},
    SpeedCase{"500_periods", 1000, "500 periods of two films", periods},
    SpeedCase{"20_hosted", 40, "20 periods between half-spaces of the first one", hosted_periods},
    SpeedCase{"500_hosted", 1000, "500 periods in such a host", hosted_periods},
    SpeedCase{"1000", 1000, "1000 transparent films", transparent},
    SpeedCase{"1000_absorbing", 1000, "1000 absorbing films", absorbing},
    filter_case(0.001, "falpha_0.001", "transmission filter of a layer, roughness 0.001"),
    filter_case(0.01, "falpha_0.01", "transmission filter, roughness 0.01"),
    filter_case(0.05, "falpha_0.05", "transmission filter, roughness 0.05"),
    filter_case(0.1, "falpha_0.1", "transmission filter, roughness 0.1"),
    filter_case(0.2, "falpha_0.2", "transmission filter, roughness 0.2"),
    filter_case(0.5, "falpha_0.5", "transmission filter, roughness 0.5"),
    filter_case(1, "falpha_1", "transmission filter, roughness 1"),
    table_case("lut_film", 1, "colour table of a film, 64 x 512, cos theta x thickness",
               "1 | 1.33@400 | 1.9+1.5i", "layers.0.thickness_nm", 0, 1000),
    table_case("lut_mirror", 40, "colour table of a mirror of 40 layers, 64 x 512",
               "1 | (2.3@60 | 1.46@94)^20 | 1.52", "layers.0.layers.0.thickness_nm", 40, 80),
    table_case("lut_anodized", 1, "colour table of TiO2 on titanium, 64 x 512",
               "air | TiO2@35 | Ti", "layers.0.thickness_nm", 0, 200),
    table_case("lut_ito", 1, "colour table of ITO on glass, 64 x 512", "air | ITO@150 | BK7",
               "layers.0.thickness_nm", 0, 400),
    table_case("lut_low_e", 3, "colour table of silver between oxides, 64 x 512",
               "air | TiO2@38 | Ag@11 | TiO2@34 | BK7", "layers.0.thickness_nm", 20, 60),
    table_case("lut_six_tables", 6, "colour table of six layers of TiO2 and MgF2, 64 x 512",
               "air | MgF2@40 | TiO2@52 | MgF2@64 | TiO2@76 | MgF2@88 | TiO2@100 | BK7",
               "layers.0.thickness_nm", 20, 120),
    table_case("lut_absorbing_bragg", 20, "colour table of ten absorbing periods, 64 x 512",
               "1 | (2.3+0.01i@60 | 1.46+0.002i@94)^10 | 1.9+1.5i",
               "layers.0.layers.0.thickness_nm", 40, 80),
};

using Clock = std::chrono::steady_clock;

/// Fused multiply-adds of doubles per second on this machine.
double machine_limit(SimdLevel level, unsigned threads) {
    constexpr std::uint64_t kCount = 4'000'000;
    [[maybe_unused]] volatile double sink = 0;
    const double seconds = best_seconds(0.02, [&] {
        parallel_for(threads, threads, [&](std::size_t) {
            const double result = multiply_adds(kCount, level);
            if (result < 0) sink = result;
        });
    });
    return static_cast<double>(kCount * lanes(level) * threads) / seconds;
}

std::vector<double> case_wavelengths() {
    std::vector<double> wavelengths(401);
    for (std::size_t i = 0; i < wavelengths.size(); ++i)
        wavelengths[i] = 380 + static_cast<double>(i);
    return wavelengths;
}

/// One case, with the data shared by its rows.
class Measurement {
public:
    Measurement(const SpeedCase& of, double budget)
        : case_(of),
          budget_(budget),
          stack_(of.stack(of.layers)),
          power_(stack_),
          table_(stack_, case_wavelengths()) {
        needs_.T = needs_.A = !of.only_R;
        needs_.layers = of.each_layer;
        for (int i = 0; i < 90; ++i) angles_deg_.push_back(of.normal ? 0 : i + 0.5);
        for (const double angle : angles_deg_) incidences_.push_back(incident_angle(angle));
        for (std::size_t i = 0; i < kSamples; ++i) {
            const Sample sample{i * 400 / (kSamples - 1), of.normal ? 0 : (i * 37 + 5) % 90};
            samples_.push_back(sample);
            for (const Polarization polarization : {Polarization::s, Polarization::p})
                exact_.push_back(reference(sample, polarization, Precision::digits50));
        }
    }

    SpeedRow by_kernel(const Execution& execution) const {
        SpeedRow row = new_row(std::string(name_of(execution.simd)));
        row.threads = execution.threads;
        // a slow kernel gets fewer angles
        const double one_angle = seconds_of([&] { run(1, execution); });
        const auto affordable = static_cast<std::size_t>(std::max(1.0, budget_ / one_angle));
        const std::size_t angles = std::min(affordable, incidences_.size());
        row.points = static_cast<double>(angles * table_.wavelength_nm().size());
        row.rate = row.points / best_seconds(budget_, [&] { run(angles, execution); });
        row.worst_R = error_of_kernel(execution);
        return row;
    }

    SpeedRow by_long_double() const {
        SpeedRow row = new_row("long_double");
        std::size_t done = 0;
        const double seconds = seconds_of([&] {
            const Clock::time_point start = Clock::now();
            while (std::chrono::duration<double>(Clock::now() - start).count() < budget_) {
                const Sample& sample = samples_[done++ % kSamples];
                for (const Polarization polarization : polarizations())
                    reference(sample, polarization, Precision::extended);
            }
        });
        row.points = static_cast<double>(done);
        row.rate = row.points / seconds;
        for (std::size_t i = 0; i < kSamples; ++i)
            for (std::size_t p = 0; p < polarizations().size(); ++p)
                row.worst_R = std::max(
                    row.worst_R,
                    std::abs(reference(samples_[i], polarizations()[p], Precision::extended) -
                             exact_[2 * i + p]));
        return row;
    }

private:
    static constexpr std::size_t kSamples = 12;
    /// Indices of a wavelength and an angle.
    struct Sample {
        std::size_t wavelength, angle;
    };

    SpeedRow new_row(std::string method) const {
        SpeedRow row;
        row.name = case_.name;
        row.method = std::move(method);
        row.layers = case_.layers;
        row.operations = work_of(power_, table_, incidences_, needs_, {1, SimdLevel::baseline})
                             .operations_per_point;
        return row;
    }

    std::span<const Polarization> polarizations() const {
        static constexpr std::array both{Polarization::s, Polarization::p};
        return std::span(both).first(case_.normal ? 1 : 2);
    }

    double reference(const Sample& sample, Polarization polarization, Precision precision) const {
        return reference_power(stack_, table_.wavelength_nm()[sample.wavelength],
                               angles_deg_[sample.angle], polarization, precision)
            .R;
    }

    void run(std::size_t angles, const Execution& execution) const {
        spectra(power_, table_, std::span(incidences_).first(angles), needs_, execution, out_);
    }

    double error_of_kernel(const Execution& execution) const {
        double worst = 0;
        for (std::size_t i = 0; i < kSamples; ++i) {
            const Spectra at =
                spectra(power_, table_, std::span(incidences_).subspan(samples_[i].angle, 1),
                        needs_, execution);
            const std::size_t w = samples_[i].wavelength;
            worst = std::max({worst, std::abs(at.s.R[w] - exact_[2 * i]),
                              std::abs(at.p.R[w] - exact_[2 * i + 1])});
        }
        return worst;
    }

    SpeedCase case_;
    double budget_;
    Stack stack_;
    StackPower power_;
    IndexTable table_;
    Needs needs_;
    std::vector<double> angles_deg_;
    std::vector<IncidentAngle> incidences_;
    std::vector<Sample> samples_;
    std::vector<double> exact_;  ///< R of every sample, for s and p
    mutable Spectra out_;
};

/// Sine and cosine of 4096 phases up to 1e5; the plain level is the C library.
SpeedRow sine_row(SimdLevel level, double budget) {
    std::vector<double> x(4096), sine(x.size()), cosine(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = 1e5 * std::fmod(std::numbers::phi * static_cast<double>(i), 1);
    const auto by_library = [&] {
        for (std::size_t i = 0; i < x.size(); ++i) {
            sine[i] = std::sin(x[i]);
            cosine[i] = std::cos(x[i]);
        }
    };
    const auto by_vectors = [&] { sin_cos(x, sine, cosine, level); };
    SpeedRow row;
    row.name = "sin_cos";
    row.method = name_of(level);
    row.points = static_cast<double>(x.size());
    row.operations = kSinCosOperations;
    row.rate = row.points / (level == SimdLevel::plain ? best_seconds(budget, by_library)
                                                       : best_seconds(budget, by_vectors));
    return row;
}

/// The zero of a function that changes sign in [low, high], by bisection until there is no double
/// in between.
template <class Function>
double halved(double low, double high, const Function& f) {
    const bool rises = f(high) > 0;
    while (true) {
        const double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high)) return middle;
        ((f(middle) > 0) == rises ? high : low) = middle;
    }
}

/// Both edges of one gap and the Airy point below it.
using ThreeLandmarks = std::array<double, 3>;

ThreeLandmarks landmarks_by_newton(const BraggPeriod& period, double order) {
    const BandGap gap = band_gap(period, order);
    return {omega_of_airy(period, order - 1), gap.low_per_nm, gap.high_per_nm};
}

/// Finds landmarks by bisection of cos KL: Airy points between modes, edges between Airy points and
/// the mode. Closed gaps are not found. `above` is the Airy point above the gap, which the next gap
/// needs. Source: FPB24 (CGF 43(2), 2024), section 3.
ThreeLandmarks landmarks_by_dichotomy(const BraggPeriod& period, double order, double& above) {
    const double q = period.admittance_ratio, mean = (q + 1 / q) / 2;
    const double side = std::fmod(order, 2) == 0 ? 1 : -1;
    const auto cos_kl = [&](double omega) {
        const double a = omega * period.path1_nm, b = omega * period.path2_nm;
        return std::cos(a) * std::cos(b) - mean * std::sin(a) * std::sin(b);
    };
    const auto past_edge = [&](double omega) { return side * cos_kl(omega) - 1; };
    const double mode = omega_of_mode(period, order);
    const double below = order == 1 ? halved(0, mode, cos_kl) : above;
    above = halved(mode, omega_of_mode(period, order + 1), cos_kl);
    return {below, halved(below, mode, past_edge), halved(mode, above, past_edge)};
}

/// Edges and Airy points of the first 8 gaps of 64 mirrors, on one thread, one at a time.
SpeedRow landmarks_row(bool by_newton, double budget) {
    constexpr int kMirrors = 64, kOrders = 8;
    std::array<BraggPeriod, kMirrors> mirrors;
    for (int i = 0; i < kMirrors; ++i)
        mirrors.at(static_cast<std::size_t>(i)) = {100 + 300 * std::fmod(0.618 * i, 1),
                                                   100 + 300 * std::fmod(0.382 * i, 1),
                                                   1.2 + std::fmod(0.7548 * i, 1)};
    [[maybe_unused]] volatile double sink = 0;
    const double seconds = best_seconds(budget, [&] {
        for (const BraggPeriod& mirror : mirrors) {
            double above = 0;
            for (int order = 1; order <= kOrders; ++order)
                sink = (by_newton ? landmarks_by_newton(mirror, order)
                                  : landmarks_by_dichotomy(mirror, order, above))[1];
        }
    });
    SpeedRow row;
    row.name = "landmarks";
    row.method = by_newton ? "newton" : "dichotomy";
    row.layers = 2;
    row.points = 3 * kMirrors * kOrders;
    row.rate = row.points / seconds;
    return row;
}

tables::Records to_records(const std::vector<SpeedRow>& rows) {
    tables::Column::Texts names, methods;
    for (const SpeedRow& row : rows) {
        names.push_back(row.name);
        methods.push_back(row.method);
    }
    tables::Records records{{{"case", std::move(names)}, {"method", std::move(methods)}}};
    const auto add = [&](std::string name, auto value) {
        add_numbers(records, std::move(name), rows, value);
    };
    add("threads", [](const SpeedRow& r) { return r.threads; });
    add("layers", [](const SpeedRow& r) { return r.layers; });
    add("points", [](const SpeedRow& r) { return r.points; });
    add("points_per_s", [](const SpeedRow& r) { return r.rate; });
    add("ns_per_point", [](const SpeedRow& r) { return 1e9 / r.rate; });
    add("worst_R", [](const SpeedRow& r) { return r.worst_R; });
    add("operations_per_point", [](const SpeedRow& r) { return r.operations; });
    add("limit_per_s", [](const SpeedRow& r) { return r.limit; });
    add("fraction_of_limit", [](const SpeedRow& r) { return r.rate * r.operations / r.limit; });
    add("worst_F", [](const SpeedRow& r) { return r.worst_F; });
    // of the same on one thread, times the threads
    add("thread_efficiency", [&](const SpeedRow& r) {
        const auto single = std::ranges::find_if(rows, [&](const SpeedRow& one) {
            return one.name == r.name && one.method == r.method && one.threads == 1;
        });
        return single == rows.end() ? 0 : r.rate / (r.threads * single->rate);
    });
    return records;
}

int run_speed(const SpeedOptions& options) {
    resolved_record_format(options.output);
    const double budget = parse_one_number("--time", options.time, 0.001, 60);
    const std::vector<SpeedCase> cases = chosen_cases<SpeedCase>(options.cases, kCases, "speed");
    const unsigned all_threads =
        options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
    const SimdLevel widest = execution_of(all_threads).simd;
    std::vector<SpeedRow> rows;
    StepProgress progress(options.quiet, cases.size() + 1);
    progress.begin("machine");
    // clock rates change: the limit is measured before and after the rate
    const auto add = [&](SimdLevel level, unsigned threads, const auto& measure) {
        const double before = machine_limit(level, threads);
        SpeedRow row = measure();
        row.limit = std::max(before, machine_limit(level, threads));
        rows.push_back(std::move(row));
    };
    std::vector<SimdLevel> levels;
    for (const SimdLevel level : kSimdLevels)
        if (level <= widest && is_available(level)) levels.push_back(level);
    for (const SimdLevel level : levels) add(level, 1, [&] { return sine_row(level, budget); });
    for (const bool by_newton : {true, false})
        add(SimdLevel::plain, 1, [&] { return landmarks_row(by_newton, budget); });
    for (const SpeedCase& one : cases) {
        progress.begin(std::string(one.name));
        if (one.alpha > 0) {
            add(SimdLevel::plain, 1, [&] { return filter_sum_row(one, budget); });
            for (const SimdLevel level : levels)
                add(level, 1, [&] { return filter_row(one, level, budget); });
            continue;
        }
        if (!one.expression.empty()) {
            add(widest, 1, [&] { return table_row(one, {1, widest}, budget); });
            if (all_threads > 1)
                add(widest, all_threads, [&] {
                    return table_row(one, {all_threads, widest}, budget);
                });
            continue;
        }
        const Measurement measurement(one, budget);
        add(SimdLevel::plain, 1, [&] { return measurement.by_long_double(); });
        for (const SimdLevel level : levels)
            add(level, 1, [&] { return measurement.by_kernel({1, level}); });
        if (all_threads > 1)
            add(widest, all_threads, [&] { return measurement.by_kernel({all_threads, widest}); });
    }
    progress.clear();
    write_records(to_records(rows), options.output);
    return 0;
}

}  // namespace

void add_bench_speed(CLI::App& bench, Run& run) {
    CLI::App* command = bench.add_subcommand(
        "speed",
        "Points per second of every kernel, compared with this machine's limit, and their errors.");
    const auto options = std::make_shared<SpeedOptions>();
    command->add_option("-t,--time", options->time, "seconds spent on each row, [0.001, 60] [0.1]")
        ->type_name("S");
    command->add_option("-c,--cases", options->cases, cases_help<SpeedCase>(kCases))
        ->type_name("NAMES");
    const auto names = [] { return case_names<SpeedCase>(kCases); };
    offer(*command, "cases", names, OfferedWords::Use::several);
    add_output_options(*command, options->output, record_formats_text());
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no progress");
    set_examples(
        *command,
        {"irido bench speed -o speed.csv",
         "irido bench speed --cases film,40,40_absorbing --time 1 -f json"},
        "Columns: points of wavelength (380:780:1 nm) and angle (0.5:89.5:1), both\n"
        "polarizations, points_per_s and ns_per_point of each method; worst_R is its\n"
        "largest error of R against 50 digits at 12 points. limit_per_s is the rate of\n"
        "fused multiply-adds of the same instruction set and threads, measured before and\n"
        "after; operations_per_point is the arithmetic of the vector kernel, and\n"
        "fraction_of_limit = points_per_s operations_per_point / limit_per_s. sin_cos is\n"
        "a sine and a cosine; plain and long_double go point by point. landmarks: band\n"
        "edges and Airy points of 64 Bragg mirrors, by irido's Newton steps and by bisection\n"
        "of cos KL between modes, as in Fourneau et al. (2024). falpha is F_alpha at theta_i\n"
        "and theta_d of 0:89.75:0.25, in closed form and, as sum_1000, by 1000 samples of\n"
        "psi; worst_F is its largest relative error at 60 points. lut_: points are samples\n"
        "of a table. thread_efficiency: points_per_s over that of one thread times the threads.");
    set_run(*command, run, options, run_speed);
}

}  // namespace irido::cli
