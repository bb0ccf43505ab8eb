#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/stack/index_table.hpp"
#include "schemas/documents/stack_document.hpp"
#include "tables/pictures/inks.hpp"
#include "tables/pictures/rows_figure.hpp"
#include "tables/records/record_layout.hpp"
#include "tables/records/records.hpp"

namespace irido::cli {

/// The circumstances in which a query is evaluated.
struct QueryRun {
    Execution execution{1};
    /// Receives notes to the user, possibly from several threads.
    std::function<void(const std::string&)> note = [](const std::string&) {};
    /// Number of stacks with the same materials and structure that will be evaluated.
    double stacks = 1;
    /// Layers in which these stacks differ; empty if there is only one stack.
    std::vector<LayerPlace> varied = {};
    /// Number of structures that may be prepared simultaneously; they share the cache memory.
    std::size_t structures = 1;
    /// Every stack has its own wavelength, which replaces those of the query.
    bool varies_wavelength = false;
    /// Notes are not shown, as in sweeps and with --quiet: the error of approximate methods is then
    /// measured only on request.
    bool is_silent = false;
};

/// The light incident on a stack.
struct Incidence {
    std::span<const double> angles_deg;        ///< [0, 90]
    std::optional<double> wavelength_nm = {};  ///< replaces the wavelengths of the query
};

/// A stack document and everything that does not depend on its thicknesses.
struct PreparedStack {
    explicit PreparedStack(schemas::StackDocument read) : document(std::move(read)) {}
    virtual ~PreparedStack() = default;

    schemas::StackDocument document;
};

/// Collects the rows of successive stacks; for use by one thread.
class QueryResult {
public:
    virtual ~QueryResult() = default;

    /// Appends the rows of one stack, ordered by angle first, and returns their number. Throws
    /// InputError, UsageError or ToleranceError, and then appends nothing.
    /// prepared   the prepared document
    /// stack      a stack that differs from the document's only in thicknesses
    /// incidence  angles in degrees, [0, 90], and optionally one wavelength in nm, [1, 1e7]
    virtual std::size_t add(const PreparedStack& prepared, const Stack& stack,
                            const Incidence& incidence) = 0;
    /// Returns and clears all rows since the last call.
    virtual tables::Records records() = 0;
};

/// A quantity to evaluate for stacks: a command with its parsed options.
class Query {
public:
    virtual ~Query() = default;

    virtual std::span<const double> angles_deg() const = 0;
    /// Whether each stack may have its own wavelength.
    virtual bool takes_wavelength() const { return false; }
    /// Whether the angles are independent, so that they can be evaluated one at a time.
    virtual bool splits_angles() const { return true; }
    /// Number of rows for one stack at one angle; 0 if not known in advance.
    virtual std::size_t rows_per_angle() const = 0;
    /// Names and types of the rows' columns.
    virtual tables::RecordLayout layout(const schemas::StackDocument& document) const = 0;

    /// The roles of the columns in a picture.
    virtual tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const = 0;

    /// Contents of files that the rows depend on.
    virtual nlohmann::json data() const;

    /// Throws InputError or UsageError. Thread-safe.
    virtual std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const = 0;
    virtual std::unique_ptr<QueryResult> new_result() const = 0;
    /// Estimated microseconds per stack and angle: depends only on the arguments, so it is the same
    /// on every machine.
    /// prepared, stack  as for QueryResult::add()
    /// angle_deg        angle of incidence in degrees, [0, 90]
    /// wavelength_nm    the stack's own wavelength in nm, [1, 1e7], if wavelengths vary
    virtual double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                           std::optional<double> wavelength_nm) const = 0;
    /// For timing: evaluates about `share`, (0, 1], of the query for the document's stack, discards
    /// the rows, and returns the share that was evaluated. Throws InputError, UsageError or
    /// ToleranceError.
    virtual double try_share(const schemas::StackDocument& document, const Incidence& incidence,
                             double share) const;
};

/// Notes that an incident medium with k > 0 at the table's wavelengths is taken as transparent.
void note_incident(const schemas::StackDocument& document, const IndexTable& table,
                   const std::function<void(const std::string&)>& say);

/// The rows of the prepared document's own stack at the query's angles.
tables::Records records_of(const Query& query, const PreparedStack& prepared);

/// A figure of rows. Throws tables::PictureError.
/// query   the query, which knows the columns
/// rows    the rows
/// varied  the columns of varied values
/// title   the figure's title
/// gamut   how colours outside sRGB are shown
/// say     receives the figure's notes
tables::Figure figure_of_rows(const Query& query, const tables::Records& rows,
                              const std::vector<std::string>& varied, const std::string& title,
                              tables::GamutMapping gamut,
                              const std::function<void(const std::string&)>& say);

/// Estimated seconds for the query's rows of a stack on that many threads; see tried_seconds().
double seconds_of_rows(const Query& query, const schemas::StackDocument& document,
                       unsigned threads);

/// Options of one kind of query, as given on the command line.
class QueryOptions {
public:
    virtual ~QueryOptions() = default;

    /// Throws UsageError or InputError.
    virtual std::unique_ptr<const Query> parse(const QueryRun& run) const = 0;
    /// All options that the rows depend on, as given.
    virtual nlohmann::json typed() const = 0;
};

/// A kind of query, used by a command and by sweeps.
struct QueryKind {
    std::string_view name;  ///< name of the command
    /// Binds the options, which must live as long as the command.
    std::unique_ptr<QueryOptions> (*add_options)(CLI::App& command);
};

/// spectrum, color, bands and cm.
std::span<const QueryKind> query_kinds();
std::vector<std::string_view> query_names();

}  // namespace irido::cli
