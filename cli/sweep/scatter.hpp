#pragma once

#include <string>
#include <vector>

#include "cli/sweep/space.hpp"
#include "schemas/documents/stack_document.hpp"

namespace CLI {
class App;
}

namespace irido::cli {

/// Gaussian errors of a stack's values, as typed.
struct ScatterOptions {
    std::vector<std::string> paths;   ///< PATH=SIGMA
    std::string samples, seed, link;  ///< "" for the defaults
    bool summary = false;
    std::vector<std::string> limits;  ///< COLUMN<=VALUE
};

/// --scatter, --samples, --seed, --link, --summary and --limit.
void add_scatter_options(CLI::App& command, ScatterOptions& options);

/// The columns of a sweep over samples: their number, from 1, and every value that is drawn, named
/// by its path. Empty without --scatter. `*` in a path stands for every element of an array, and
/// in `layers.*` for every layer, those of groups included. Groups whose repetitions have errors of
/// their own are written out in the document: {"repeat": 2, "layers": [a, b]} becomes
/// {"repeat": 1, "layers": [a, b, a, b]}.
///
/// The deviate of a value is a function of seed, sample and path (or what it is linked with) alone,
/// so that shards, threads and other scattered values do not matter to it.
/// options  as typed
/// vary     the paths that vary otherwise; they may not lie in a group that is written out
/// source   the stack
/// Throws UsageError or InputError.
std::vector<SweptColumn> scattered_columns(const ScatterOptions& options,
                                           const std::vector<std::string>& vary,
                                           schemas::StackSource& source);

}  // namespace irido::cli
