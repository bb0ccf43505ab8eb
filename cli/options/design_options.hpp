#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/options/command.hpp"
#include "core/design/global_search.hpp"
#include "schemas/documents/design_document.hpp"

namespace irido::cli {

/// A task as typed: a document, and what is typed besides takes its place there.
struct TaskOptions {
    std::string task;    ///< a task, or a stack
    std::string refine;  ///< a stack, to be refined
    std::vector<std::string> free, targets;
    std::string method, merit, seed, time, evaluations;  ///< "" if not typed
    std::string materials, max_layers, min_thickness;    ///< of needles; "" if not typed
};

/// TASK and the options that design and fit share.
void add_task_options(CLI::App& command, TaskOptions& options);

/// Options of needles.
void add_needle_options(CLI::App& command, TaskOptions& options);

/// PATH or PATH=LOW:HIGH as a free value. Throws UsageError.
nlohmann::json parse_free(const std::string& text);

/// QUANTITY [WAVELENGTHS] [@ANGLES] [POLARIZATION] (=|>=|<=) VALUE as a target. Throws UsageError.
nlohmann::json parse_target(const std::string& text);

/// Reads the task. Throws UsageError or InputError.
schemas::DesignTask read_task(const TaskOptions& options);

/// Checks the name of the file for a report, if there is one. Throws UsageError.
void check_report(const std::string& file);

/// Notes of the task, and materials that colours hold beyond their range.
void note_task(const schemas::DesignTask& task, bool quiet);

}  // namespace irido::cli
