#include "core/design/fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/options/design_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/search_end.hpp"
#include "cli/queries/design_report.hpp"
#include "core/design/problem_values.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "tables/files/atomic_file.hpp"

namespace irido::cli {

namespace {

using nlohmann::json;

struct FitCommand {
    TaskOptions task;
    OutputOptions stack;  ///< where it goes, if anywhere
    OutputOptions table;  ///< of the parameters
    bool prints_stack = false;
    std::string report;
    std::optional<std::string> plot;
    bool correlation = false;
    unsigned threads = 0;
    bool quiet = false;
};

/// Correlation above which values count as indistinguishable.
constexpr double kClose = 0.99;

/// NaN, empty in a table, where the data do not determine the error.
double shown(double error) {
    return std::isfinite(error) ? error : std::nan("");
}

tables::Records parameter_table(const schemas::DesignTask& task, const FitResult& result,
                                bool with_correlation) {
    tables::Column::Texts names;
    tables::Column::Numbers values, errors;
    const std::size_t size = result.x.size();
    std::vector<tables::Column::Numbers> correlations(with_correlation ? size : 0);
    for (std::size_t i = 0; i < size; ++i) {
        names.push_back(task.problem.free[i].name);
        values.push_back(result.x[i]);
        errors.push_back(shown(result.standard_error[i]));
        for (std::size_t j = 0; j < correlations.size(); ++j)
            correlations[j].push_back(result.correlation[i * size + j]);
    }
    for (const auto& [name, value] :
         {std::pair("chi2", result.chi2), std::pair("dof", static_cast<double>(result.dof))}) {
        names.emplace_back(name);
        values.push_back(value);
        errors.push_back(std::nan(""));
        for (auto& column : correlations) column.push_back(std::nan(""));
    }
    tables::Records records{{{"parameter", std::move(names)},
                             {"value", std::move(values)},
                             {"stderr", std::move(errors)}}};
    for (std::size_t j = 0; j < correlations.size(); ++j)
        records.columns.push_back(
            {"correlation_" + task.problem.free[j].name, std::move(correlations[j])});
    return records;
}

/// Notes what the table of numbers does not show.
void note_fit(const schemas::DesignTask& task, const FitResult& result, bool quiet) {
    const std::size_t size = result.x.size();
    const auto& free = task.problem.free;
    for (std::size_t i = 0; i < size; ++i) {
        if (free[i].is_integer) continue;
        if (!std::isfinite(result.standard_error[i]))
            note("the data do not determine " + free[i].name +
                     ": its stderr is infinite and left empty",
                 quiet);
        if (free[i].low < free[i].high &&
            (result.x[i] == free[i].low || result.x[i] == free[i].high))
            note(free[i].name + " is at a bound, " + to_text(result.x[i]), quiet);
        for (std::size_t j = 0; j < i; ++j) {
            const double correlation = result.correlation[i * size + j];
            if (std::abs(correlation) > kClose)
                note(free[j].name + " and " + free[i].name +
                         " cannot be told apart: their correlation is " + to_text(correlation),
                     quiet);
        }
    }
    if (!task.has_sigma)
        note("no target states its noise (sigma): stderr is scaled by sqrt(chi2/dof)", quiet);
    if (!result.other.empty() && result.starts > 1) {
        std::string where;
        for (std::size_t i = 0; i < size; ++i)
            where += (where.empty() ? "" : ", ") + free[i].name + " = " + to_text(result.other[i]);
        note("the next-best minimum has chi2 = " + to_text(result.other_chi2) + " at " + where,
             quiet);
    }
}

FitResult fitted(const schemas::DesignTask& task, const SearchEnd& end, const FitCommand& command) {
    Progress progress(command.quiet);
    const SearchSettings settings = search_settings(task, end, progress, command.threads);
    const bool is_bounded = std::ranges::all_of(task.problem.free, [](const FreeValue& value) {
        return std::isfinite(value.low) && std::isfinite(value.high);
    });
    const bool is_local = task.has_method && task.method == "refine";
    try {
        FitResult result = fit(task.problem, settings, is_bounded && !is_local ? kFitStarts : 0);
        if (!task.has_sigma && result.dof > 0)
            for (double& error : result.standard_error)
                error *= std::sqrt(result.chi2 / static_cast<double>(result.dof));
        return result;
    } catch (const DomainError& error) {
        throw schemas::InputError(task.file, "", error.what());
    }
}

int run_fit(const FitCommand& command) {
    resolved_record_format(command.table);
    schemas::DesignTask task = read_task(command.task);
    task.problem.merit = MeritKind::chi2;
    note_task(task, command.task.strict, command.quiet);
    check_result_files(command.stack, command.report, command.plot);
    const SearchEnd end(task.time_s);
    const FitResult result = fitted(task, end, command);
    if (end.signal() != 0 && command.stack.file.empty()) return 128 + end.signal();
    DesignRows rows;
    exact_merit(task.problem, result.x, &rows);
    const tables::Records report = target_report(task, rows);
    note_fit(task, result, command.quiet);
    json design{{"chi2", result.chi2},
                {"dof", result.dof},
                {"evaluations", result.evaluations},
                {"end", result.is_stopped ? "stopped" : std::string(words_of(result.end))},
                {"starts", result.starts},
                {"starts_within_1_percent", result.starts_within}};
    for (std::size_t i = 0; i < result.x.size(); ++i)
        if (std::isfinite(result.standard_error[i]))
            design["stderr"][task.problem.free[i].name] = result.standard_error[i];
    const std::string text =
        command.stack.file.empty() && !command.prints_stack
            ? ""
            : designed_text(task, result.x, std::move(design), command.stack.file);
    std::string picture;
    if (command.plot)
        picture = picture_bytes([&] { return target_figure(task, report, true); }, {},
                                picture_format_of("--plot", *command.plot), *command.plot);
    if (!text.empty()) write_bytes(text, command.stack, false);
    if (!command.report.empty()) write_records(report, {command.report, ""});
    if (command.plot) tables::write_file(*command.plot, picture);
    if (end.signal() != 0) return 128 + end.signal();
    if (command.prints_stack) return 0;
    write_records(parameter_table(task, result, command.correlation), command.table);
    return 0;
}

}  // namespace

void add_fit_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "fit", "Fit a stack to measurements: values, their standard errors and correlations.");
    const auto options = std::make_shared<FitCommand>();
    add_task_options(*command, options->task);
    command
        ->add_option_function<std::string>(
            "-o,--output",
            [options](const std::string& file) {
                options->prints_stack = file == "-";
                options->stack.file = file == "-" ? "" : file;
            },
            "also write the fitted stack there (.json); - prints it instead of the\n"
            "table")
        ->type_name("FILE");
    add_format_option(*command, options->table.format, record_formats_text());
    command->add_flag("--correlation", options->correlation,
                      "add a column correlation_NAME for every parameter");
    command
        ->add_option("--report", options->report,
                     "a table of values beside the measurements (.csv, .json, ...)")
        ->type_name("FILE");
    command->add_option("--plot", options->plot, "a picture of the residuals (.svg, .png, .pdf)")
        ->type_name("FILE");
    add_threads_option(*command, options->threads);
    add_quiet_option(*command, options->quiet, "no notes and no progress");
    set_examples(
        *command,
        {"irido fit oxide.json",
         "irido fit oxide.json --correlation --plot residuals.svg -o fitted.json"},
        "Rows are parameter,value,stderr, one for each free value, then chi2 and dof. The fit\n"
        "begins with the given values and, if all bounds are finite, with 100 others inside\n"
        "them (not with --method refine). stderr follows from the sigma of the targets and is\n"
        "not scaled; if none is stated, it is scaled by sqrt(chi2/dof).");
    set_run(*command, run, options, run_fit);
}

}  // namespace irido::cli
