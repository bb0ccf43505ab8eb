#pragma once

#include <algorithm>

#include "cli/command.hpp"

namespace irido {

/// The subcommands of `irido bench`, each in a file of its own.
void add_bench_speed(CLI::App& bench, Run& run);
void add_bench_stability(CLI::App& bench, Run& run);

/// A column of value(row) for every row.
template <class Row, class Value>
void add_numbers(Records& records, std::string name, const std::vector<Row>& rows,
                 const Value& value) {
    Column::Numbers numbers(rows.size());
    std::ranges::transform(rows, numbers.begin(), value);
    records.columns.push_back({std::move(name), std::move(numbers)});
}

}  // namespace irido
