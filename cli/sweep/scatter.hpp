#pragma once

#include <string>
#include <vector>

#include "cli/sweep/space.hpp"
#include "schemas/documents/stack_document.hpp"

namespace CLI {
class App;
}

namespace irido::cli {

/// Gaussian errors of a stack's values, as given on the command line.
struct ScatterOptions {
    std::vector<std::string> paths;   ///< PATH=SIGMA
    std::string samples, seed, link;  ///< "" for the defaults
    bool summary = false;
    std::vector<std::string> limits;  ///< COLUMN<=VALUE
};

/// Adds --scatter, --samples, --seed, --link, --summary and --limit.
void add_scatter_options(CLI::App& command, ScatterOptions& options);

/// The columns of a sweep over samples: the sample number, from 1, and every value that is drawn,
/// named by its path. Empty without --scatter. `*` in a path matches every element of an array, and
/// in `layers.*` every layer, including those of groups. Groups whose repetitions have independent
/// errors are expanded in the document: {"repeat": 2, "layers": [a, b]} becomes {"repeat": 1,
/// "layers": [a, b, a, b]}.
///
/// The deviate of a value depends only on seed, sample and path (or what it is linked with), so
/// that shards, threads and other scattered values do not affect it. Throws UsageError or
/// InputError.
/// options  as given
/// vary     the paths varied otherwise; they may not lie in a group that is expanded
/// source   the stack
std::vector<SweptColumn> scattered_columns(const ScatterOptions& options,
                                           const std::vector<std::string>& vary,
                                           schemas::StackSource& source);

}  // namespace irido::cli
