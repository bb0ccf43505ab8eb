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

/// How a question is answered, besides what is asked.
struct Answering {
    Execution execution{1};
    /// What the user should know; may be called from many threads.
    std::function<void(const std::string&)> note = [](const std::string&) {};
    /// Stacks of the same materials and structure that will be asked about.
    double stacks = 1;
    /// Layers in which these differ; none if there is one stack only.
    std::vector<LayerPlace> varied = {};
    /// Structures that may be prepared at the same time; they share the memory.
    std::size_t structures = 1;
    /// Every stack comes with a wavelength of its own, instead of those asked for.
    bool varies_wavelength = false;
    /// Nobody reads notes, or there are too many stacks for any: no errors of methods that are not
    /// exact either, unless asked for.
    bool is_silent = false;
};

/// The light that falls on a stack.
struct Incidence {
    std::span<const double> angles_deg;        ///< [0, 90]
    std::optional<double> wavelength_nm = {};  ///< instead of those asked for
};

/// A stack document with all that its stacks have in common, whatever their thicknesses.
struct PreparedStack {
    explicit PreparedStack(schemas::StackDocument read) : document(std::move(read)) {}
    virtual ~PreparedStack() = default;

    schemas::StackDocument document;
};

/// Rows of one stack after another, on one thread.
class Answers {
public:
    virtual ~Answers() = default;

    /// Adds the rows of a stack that differs from the prepared one in thicknesses only, by angle
    /// first; returns how many. Nothing is added if it throws: InputError, UsageError,
    /// ToleranceError.
    virtual std::size_t add(const PreparedStack& prepared, const Stack& stack,
                            const Incidence& incidence) = 0;
    /// All rows since the last call.
    virtual tables::Records records() = 0;
};

/// What a command asks of a stack, parsed from its options.
class Question {
public:
    virtual ~Question() = default;

    virtual std::span<const double> angles_deg() const = 0;
    /// Whether the wavelengths may be others than those asked for.
    virtual bool takes_wavelength() const { return false; }
    /// Whether rows of all angles may be asked for angle by angle.
    virtual bool splits_angles() const { return true; }
    /// Rows of one stack at one angle; 0 if their number is not known before.
    virtual std::size_t rows_per_angle() const = 0;
    /// Names and types of the rows' columns.
    virtual tables::RecordLayout layout(const schemas::StackDocument& document) const = 0;

    /// How rows are drawn: what their columns are.
    virtual tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const = 0;

    /// What the answers depend on that was read from files.
    virtual nlohmann::json data() const;

    /// Throws InputError or UsageError. Safe from many threads.
    virtual std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const = 0;
    virtual std::unique_ptr<Answers> answers() const = 0;
    /// Microseconds of one stack at one angle, more or less: a function of its arguments that is
    /// the same on every machine.
    virtual double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                           std::optional<double> wavelength_nm) const = 0;
    /// Computes a share, (0, 1], of what is asked about the document's stack and forgets it, to see
    /// how long that takes; returns the share that it was. Throws as prepare() and Answers::add().
    virtual double try_share(const schemas::StackDocument& document, const Incidence& incidence,
                             double share) const;
};

/// Says so if an incident medium that has k is taken as transparent at the table's wavelengths.
void note_incident(const schemas::StackDocument& document, const IndexTable& table,
                   const std::function<void(const std::string&)>& say);

/// The rows of the prepared stack itself at the question's angles.
tables::Records records_of(const Question& question, const PreparedStack& prepared);

/// A figure of rows under a title; `varied` are columns of values of the stack that differ from row
/// to row. What is noted in the figure is also said. Throws tables::PictureError.
tables::Figure figure_of_rows(const Question& question, const tables::Records& rows,
                              const std::vector<std::string>& varied, const std::string& title,
                              tables::GamutMapping gamut,
                              const std::function<void(const std::string&)>& say);

/// Seconds that the question's rows of a stack will take on so many threads; see tried_seconds().
double seconds_of_rows(const Question& question, const schemas::StackDocument& document,
                       unsigned threads);

/// Options of one kind of question, as typed.
class QuestionOptions {
public:
    virtual ~QuestionOptions() = default;

    /// Throws UsageError or InputError.
    virtual std::unique_ptr<const Question> parse(const Answering& answering) const = 0;
    /// All that the answers depend on, besides stack, Answering and what is read from files.
    virtual nlohmann::json typed() const = 0;
};

/// A kind of question that commands and sweeps ask.
struct QuestionKind {
    std::string_view name;  ///< of the command
    /// Binds the options, which must live as long as the command.
    std::unique_ptr<QuestionOptions> (*add_options)(CLI::App& command);
};

/// spectrum, color, bands and cm.
std::span<const QuestionKind> question_kinds();
std::vector<std::string_view> question_names();

}  // namespace irido::cli
