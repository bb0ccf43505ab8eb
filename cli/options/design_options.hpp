#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "core/design/global_search.hpp"
#include "schemas/documents/design_document.hpp"

namespace irido::cli {

/// A task on the command line: a document, and options that replace parts of it.
struct TaskOptions {
    std::string task;    ///< a task, or a stack
    std::string refine;  ///< a stack to refine
    std::vector<std::string> free, targets;
    std::string method, merit, seed, time, evaluations;  ///< "" if not given
    std::string materials, max_layers, min_thickness;    ///< for needles; "" if not given
    bool strict = false;                                 ///< as of ColorOptions
};

/// Adds TASK and the options common to design and fit.
void add_task_options(CLI::App& command, TaskOptions& options);

/// Adds the options of needles.
void add_needle_options(CLI::App& command, TaskOptions& options);

/// Parses PATH or PATH=LO:HI as a free value. Throws UsageError.
nlohmann::json parse_free(const std::string& text);

/// Parses QUANTITY [WAVELENGTHS] [@ANGLES] [POLARIZATION] (=|>=|<=) VALUE as a target. Throws
/// UsageError.
nlohmann::json parse_target(const std::string& text);

/// Reads the task, with the options applied. Throws UsageError or InputError.
schemas::DesignTask read_task(const TaskOptions& options);

/// Checks the files of a result: the stack, and a report and a plot if there are any ("" and none).
/// Throws UsageError.
void check_result_files(const OutputOptions& stack, const std::string& report,
                        const std::optional<std::string>& plot);

/// Notes of the task, and materials that colours hold beyond their range; with `strict` these are
/// refused.
void note_task(const schemas::DesignTask& task, bool strict, bool quiet);

}  // namespace irido::cli
