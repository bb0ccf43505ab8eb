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

/// An option of a kind beside the common ones, as the command line shows it.
struct LutOption {
    enum class Type { list, number, whole, word, flag };
    std::string_view name;  ///< without dashes
    Type type = Type::list;
    std::string_view help;        ///< with unit, range and default
    std::string_view fallback{};  ///< as typed; "" for none
    double lowest = 0, highest = 0;
    std::vector<std::string_view> words{};  ///< of a word
    char letter = 0;                        ///< short form, 0 for none
};

/// What was typed for the options of a kind, in values; those with neither value nor fallback are
/// missing. A flag is there or not.
using LutOptions =
    std::map<std::string, std::variant<std::vector<double>, double, std::string>, std::less<>>;

/// A number of the stack that varies.
struct VariedValue {
    std::string path;            ///< dotted, in the stack's document: layers.0.thickness_nm
    std::vector<double> values;  ///< strictly monotonic
};

/// What is asked of a kind, in values.
struct LutRequest {
    LutOptions options;

    bool has(std::string_view name) const { return options.find(name) != options.end(); }
    const std::vector<double>& list(std::string_view name) const;
    double number(std::string_view name) const;
    const std::string& word(std::string_view name) const;

    // for kinds with `stack`
    schemas::StackSource source;      ///< with --set applied
    schemas::StackDocument document;  ///< the same, read

    // for kinds with `light`: what falls on the stack and who looks
    std::shared_ptr<const Sensitivity> sensitivity;
    nlohmann::json illuminant;  ///< a name, or the rows of a file
    std::string observer;       ///< 2 or 10 degrees

    // for kinds with `color`
    ColorRequest color;
    const RgbSpace* space = nullptr;
    Adaptation adaptation = Adaptation::bradford;
    std::vector<VariedValue> vary;  ///< for kinds with `vary`: at most two

    Execution execution;
};

/// An axis before its size is settled.
struct AxisPlan {
    LutAxis axis;        ///< with the default or typed samples
    bool fixed = false;  ///< samples were typed, or are not a range: never resized
    /// Beyond its last sample the function may become constant: the range may be cut there.
    bool may_end_early = false;
    std::string_view end_reason{};  ///< why, in words; "" if it is not known
};

/// How far two rows of samples are apart, at most.
struct LutMeasure {
    std::string name;  ///< as the metadata has it: delta_e_2000, relative to ..., absolute
    /// Of two blocks of values [..][channel] of the same place, `exact` and `approximate`: one
    /// number for each sample. `axes` are those of the block.
    std::function<std::vector<double>(const std::vector<LutAxis>& axes,
                                      std::span<const double> exact,
                                      std::span<const double> approximate)>
        differences;
};

/// A table's function, made ready for a request.
struct LutPlan {
    std::vector<AxisPlan> axes;  ///< slowest first
    std::vector<std::string> channels;
    bool mips = false;           ///< the first axis can be mip levels
    std::size_t split_axis = 0;  ///< the work is divided along this axis
    /// Values [axes][channel] at all combinations of the axes' samples. Depends on each sample
    /// alone, not on its neighbours; safe from many threads.
    std::function<std::vector<double>(const std::vector<LutAxis>& axes)> evaluate;
    LutMeasure measure;
    nlohmann::json facts = nlohmann::json::object();  ///< color_space, notes, request of its own
};

/// A kind of table.
struct LutKind {
    std::string_view name;
    std::string_view summary;                  ///< one line
    std::string_view axes;                     ///< for the list: "theta_i, theta_d"
    std::string_view notes{};                  ///< for --help: formulas, units
    std::vector<std::string_view> examples{};  ///< of command lines, without "irido lut "
    bool stack = false;                        ///< needs a stack
    bool light = false;                        ///< needs an illuminant and an observer
    bool color = false;                        ///< needs side, polarization and space
    bool vary = false;                         ///< up to two numbers of the stack may vary
    std::vector<LutOption> options{};
    /// Throws DomainError or InputError for what cannot be made.
    LutPlan (*plan)(const LutRequest&) = nullptr;
    /// Invariants that a table of this kind breaks, one line each.
    std::vector<std::string> (*problems)(const Lut&) = nullptr;
};

/// All kinds, by name. The list is made from the files in tables/lut/kinds/.
std::span<const LutKind* const> lut_kinds();

/// nullptr if there is none of that name.
const LutKind* find_lut_kind(std::string_view name);

/// The paths of what varies, in its order.
std::vector<std::string> paths_of(std::span<const VariedValue> vary);

}  // namespace irido::tables
