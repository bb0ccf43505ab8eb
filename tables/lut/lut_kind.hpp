#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/color/color_request.hpp"
#include "core/colorimetry/sensitivity.hpp"
#include "core/colorimetry/space.hpp"
#include "core/math/simd_level.hpp"
#include "schemas/documents/stack_document.hpp"
#include "tables/lut/lut.hpp"

namespace irido::tables {

/// An option specific to a kind of table, as the command line shows it.
struct LutOption {
    enum class Type { list, number, whole, word, range, flag };  ///< range: a list of LO, HI
    std::string_view name;                                       ///< without dashes
    Type type = Type::list;
    std::string_view help;        ///< with unit, range and default
    std::string_view fallback{};  ///< as typed; "" for none
    double lowest = 0, highest = 0;
    std::vector<std::string_view> words{};  ///< allowed values of a word
    char letter = 0;                        ///< short form, 0 for none
};

/// Parsed values of the options of a kind; those with neither value nor fallback are missing, and
/// so are flags that are not set.
using LutOptions =
    std::map<std::string, std::variant<std::vector<double>, double, std::string>, std::less<>>;

/// A varied number of the stack.
struct VariedValue {
    std::string path;            ///< dotted, in the stack's document: layers.0.thickness_nm
    std::vector<double> values;  ///< strictly monotonic
};

/// The parsed request for a table.
struct LutRequest {
    LutOptions options;

    bool has(std::string_view name) const { return options.find(name) != options.end(); }
    const std::vector<double>& list(std::string_view name) const;
    double number(std::string_view name) const;
    const std::string& word(std::string_view name) const;

    // for kinds with `stack`
    schemas::StackSource source;      ///< with --set applied
    schemas::StackDocument document;  ///< read from the source

    // for kinds with `light`: illuminant and observer
    std::shared_ptr<const Sensitivity> sensitivity;
    nlohmann::json illuminant;  ///< a name, or the rows of a file
    std::string observer;       ///< 2 or 10 degrees

    // for kinds with `color`
    ColorRequest color;
    // for kinds with `color` or `space`
    const RgbSpace* space = nullptr;
    Adaptation adaptation = Adaptation::bradford;
    std::vector<VariedValue> vary;  ///< for kinds with `vary`: at most two

    Execution execution;
};

/// An axis whose size is not final.
struct AxisPlan {
    LutAxis axis;        ///< with default or requested samples
    bool fixed = false;  ///< not resizable: requested samples that are not equally spaced
    /// The range may be cut where the function becomes constant.
    bool may_end_early = false;
    std::string_view end_reason{};  ///< why it becomes constant; "" if unknown
};

/// A measure of the difference between values of a table.
struct LutMeasure {
    std::string name;  ///< as the metadata has it: delta_e_2000, relative to ..., absolute
    /// Differences between two blocks of values [..][channel], one number per sample; `axes` are
    /// those of the block.
    std::function<std::vector<double>(const std::vector<LutAxis>& axes,
                                      std::span<const double> exact,
                                      std::span<const double> approximate)>
        differences;
};

/// The function that a table samples, prepared for a request.
struct LutPlan {
    std::vector<AxisPlan> axes;  ///< slowest first
    std::vector<std::string> channels;
    bool mips = false;           ///< the first axis can be mip levels
    std::size_t split_axis = 0;  ///< the work is divided along this axis
    /// Values [axes][channel] at all combinations of the axes' samples. Each value depends on its
    /// own sample only; thread-safe.
    using Evaluate = std::function<std::vector<double>(const std::vector<LutAxis>& axes)>;
    Evaluate evaluate;
    /// The same with an error of at most `error` in the measure, for trials: quicker. May be empty.
    std::function<Evaluate(double error)> roughly{};
    LutMeasure measure;
    nlohmann::json facts = nlohmann::json::object();  ///< color_space, notes, the kind's request
};

/// A kind of table.
struct LutKind {
    std::string_view name;
    std::string_view summary;                  ///< one line
    std::string_view axes;                     ///< for the list: "theta_i, theta_d"
    std::string_view notes{};                  ///< for --help: formulas, units
    std::vector<std::string_view> examples{};  ///< command lines without "irido lut "
    bool stack = false;                        ///< needs a stack
    bool light = false;                        ///< needs an illuminant and an observer
    bool color = false;                        ///< needs side, polarization and space
    bool space = false;                        ///< values are colours, without a stack
    std::string_view text_type = "f32";        ///< number format of CSV, unless --dtype is given
    bool vary = false;                         ///< up to two numbers of the stack may vary
    std::vector<LutOption> options{};
    /// Throws DomainError or InputError for impossible requests.
    LutPlan (*plan)(const LutRequest&) = nullptr;
    /// Violated invariants of a table of this kind, one line each.
    std::vector<std::string> (*problems)(const Lut&) = nullptr;
};

/// All kinds, by name. The list is made from the files in tables/lut/kinds/.
std::span<const LutKind* const> lut_kinds();

/// nullptr if there is none of that name.
const LutKind* find_lut_kind(std::string_view name);

/// The paths of the varied values, in order.
std::vector<std::string> paths_of(std::span<const VariedValue> vary);

}  // namespace irido::tables
