#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/color/color_request.hpp"
#include "core/color/color_tables.hpp"

namespace irido {

struct ColorMethod;

/// The number that may follow a method's name and a slash: equal/32.
struct MethodNumber {
    double fewest = 0, most = 0;  ///< closed range; a method without a number has most = 0
    std::size_t fallback = 0;     ///< ColorMethod::count if there is no number
    std::size_t offset = 0;       ///< count less the number: 1 if 0 is a number, too
};

/// The colours by which run time and error of a method are measured, see `irido bench pareto`.
struct MethodTrials {
    int last_power = 0;                     ///< tolerances 1e-2 to 10^-last_power; 0: none
    std::span<const std::size_t> counts{};  ///< values of ColorMethod::count
    double tolerance_of_counts = 1e-6;      ///< tolerance for these
    std::string_view what{};                ///< for --help
};

/// Trials of a method without tolerances and numbers.
inline constexpr std::array<std::size_t, 1> kNoNumber{0};

enum class MethodUse {
    exact,     ///< estimates the error of its colours
    variant,   ///< a simplification of the exact method described before it
    baseline,  ///< what others do, for comparison: no error is known
};

/// A method to compute colours. core/color/methods/NAME.cpp defines the object color_method_NAME;
/// nothing else lists it.
struct ColorMethodKind {
    std::string_view name;
    int place = 0;  ///< in lists, on pages and among the rows of trials, from 1 on
    MethodUse use = MethodUse::baseline;
    MethodNumber number{};
    std::string_view help;  ///< "equal/N: ...", without line breaks
    MethodTrials trials;
    bool needs_reflected_film = false;  ///< takes only light reflected by one film
    bool takes_base_color = false;      ///< ColorMethod::base_color has a meaning
    /// What else the method does not support, as fault_in() says it; nullptr: nothing.
    std::string (*fault)(const Stack& stack, const ColorRequest& request) = nullptr;
    /// Prepares the method, as color_algorithm() does, for a stack without a fault.
    std::unique_ptr<ColorAlgorithm> (*prepare)(const ColorTables& tables, const Stack& stack,
                                               const ColorMethod& method,
                                               const ColorRequest& request) = nullptr;

    bool takes_number() const { return number.most > 0; }

    /// Why the method does not support a stack or a request, a sentence; "" if it does.
    std::string fault_in(const Stack& stack, const ColorRequest& request) const;
};

extern const ColorMethodKind color_method_auto;

/// A method and its parameters; by default the cheapest exact method for the tolerance.
struct ColorMethod {
    const ColorMethodKind* kind = &color_method_auto;
    /// What the method counts, as MethodNumber has it: wavelengths of equal, [2, 1e6], orders or
    /// harmonics of a series that is truncated, [1, 1001], subdivisions of landmarks, [1, 1000]; 0
    /// where the method takes as many as the tolerance needs, or has no number.
    std::size_t count = 0;
    /// Linear sRGB of the base, each in [0, 1]; absent: that of the bare base.
    std::optional<Triple> base_color{};

    bool is(std::string_view name) const { return kind->name == name; }
};

/// All methods, in the order of their places. The list is made from the files in
/// core/color/methods/.
std::span<const ColorMethodKind* const> color_methods();

/// nullptr if there is no method of that name.
const ColorMethodKind* find_color_method(std::string_view name);

/// A method by name. Throws DomainError if there is none.
///   name   without its number
///   count  see ColorMethod
ColorMethod color_method(std::string_view name, std::size_t count = 0);

}  // namespace irido
