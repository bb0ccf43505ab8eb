#pragma once

#include <string>
#include <vector>

#include "cli/queries/comparison_query.hpp"
#include "core/comparison/film_set.hpp"

namespace irido::cli {

/// Reads films from a CSV file with the columns id, film_n, film_d_nm, angle_deg, and either
/// base_n_r, base_n_g, base_n_b, base_k_r, base_k_g, base_k_b or base_n, base_k (k defaults to 0).
/// Throws InputError.
std::vector<ComparedFilm> read_films(const std::string& file);

/// One row per film and engine; columns id, then those of EngineRows.
/// white    XYZ of the illuminant's white
/// engines  the engines compared
/// films    the films
/// colors   colours of the engines for the films
tables::Records film_rows(const Triple& white, std::span<const ComparedEngine> engines,
                          std::span<const ComparedFilm> films, std::span<const EngineColor> colors);

/// One row per engine and kind of base that occurs, then one per engine for all bases: columns
/// engine, base, count (of films), mean, median, p95, max, worst (an id).
tables::Records film_statistics(std::span<const ComparedEngine> engines,
                                std::span<const ComparedFilm> films,
                                std::span<const EngineColor> colors);

/// The engines with their versions, inputs, spaces and limits, as printed by compare list.
tables::Records engine_list();

}  // namespace irido::cli
