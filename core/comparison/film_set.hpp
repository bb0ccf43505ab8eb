#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/comparison/stack_comparison.hpp"

namespace irido {

/// dielectric: k = 0; conductor: one n + ik for all wavelengths; colored: one index per channel.
enum class BaseKind { dielectric, conductor, colored };

std::string_view name_of(BaseKind base);
/// "dielectric", "conductor", "colored".
std::span<const std::string_view> base_kind_names();
/// Throws DomainError for any other name.
BaseKind base_kind(std::string_view name);

/// One film at one angle.
struct ComparedFilm {
    std::string id;
    double angle_deg = 0;
    EngineFilm film;
    std::optional<Stack> stack = {};  ///< absent if the base is three indices, not a spectrum

    BaseKind base() const;
};

/// A film in air; `stack` is set if n and k of the base are the same for all channels. Throws
/// DomainError as with_base() does, and unless angle_deg is in [0, 90].
ComparedFilm compared_film(std::string id, double angle_deg, EngineFilm film);

/// Random films, uniformly distributed in
///     film index 1.2 to 2.6, thickness 5 to 1000 nm, angle 0 to 85 degrees;
///     dielectric: n 1 to 2.6;   conductor: n 0.1 to 4, k 0.5 to 6;   colored: Au, Cu, brass, TiN
/// and rounded to 0.001, 0.1 nm and 0.1 degrees; the same on every machine. The id is the stack and
/// the angle in command-line syntax.
///   tables  for the coloured bases
///   count   number of films
///   seed    of the random numbers
///   base    kind of base, or any
std::vector<ComparedFilm> random_films(const ColorTables& tables, std::size_t count,
                                       std::uint64_t seed, const std::optional<BaseKind>& base);

/// Results [film][engine]. A film without a stack has no exact colour, and among the methods only
/// naive has a result, with its three wavelengths as the channels.
///   tables               observer and illuminant
///   engines, difference  what to compare, and how
///   films                see compared_film() and random_films()
///   request              options of the exact colours
///   threads              0: one per core
std::vector<EngineColor> compare_films(const ColorTables& tables,
                                       std::span<const ComparedEngine> engines,
                                       const EngineDifference& difference,
                                       std::span<const ComparedFilm> films,
                                       const ColorRequest& request, unsigned threads);

/// Statistics of differences; quantiles are interpolated linearly between order statistics.
struct DifferenceSummary {
    std::size_t count = 0;  ///< number of differences
    double mean = 0, median = 0, p95 = 0, max = 0;
    std::size_t worst = 0;  ///< index of the largest, the first if several are equal
};

/// Summary of those `values` that are present.
DifferenceSummary summary_of(std::span<const std::optional<double>> values);

}  // namespace irido
