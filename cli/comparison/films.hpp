#pragma once

#include <string>
#include <vector>

#include "cli/queries/comparison_query.hpp"
#include "core/comparison/film_set.hpp"

namespace irido::cli {

/// The films of a CSV file: id, film_n, film_d_nm, angle_deg, and base_n_r, base_n_g, base_n_b,
/// base_k_r, base_k_g, base_k_b or base_n, base_k (0 where there is no k). Throws InputError.
std::vector<ComparedFilm> read_films(const std::string& file);

/// One row for each film and engine; columns id, then those of EngineRows.
tables::Records film_rows(const Triple& white, std::span<const ComparedEngine> engines,
                          std::span<const ComparedFilm> films, std::span<const EngineColor> colors);

/// One row for each engine and kind of base that occurs, then all of them: columns engine, base,
/// count (of films), mean, median, p95, max, worst (an id).
tables::Records film_statistics(std::span<const ComparedEngine> engines,
                                std::span<const ComparedFilm> films,
                                std::span<const EngineColor> colors);

/// The engines with their versions, inputs, spaces and limits: the rows of compare list.
tables::Records engine_list();

}  // namespace irido::cli
