#include "schemas/readers/number_list.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

constexpr std::size_t kMostValues = 10'000'000;

class ListParser {
public:
    void add(std::string_view item) {
        const std::size_t first = item.find(':');
        if (first == std::string_view::npos) return push(number(item));
        const std::string_view start = item.substr(0, first), rest = item.substr(first + 1);
        if (const std::size_t slash = rest.find('/'); slash != std::string_view::npos)
            return add_count(number(start), number(rest.substr(0, slash)), rest.substr(slash + 1));
        const std::size_t second = rest.find(':');
        if (second == std::string_view::npos)
            fail("must be start:stop:step or start:stop/count (got '" + std::string(item) + "')");
        add_steps(start, rest.substr(0, second), rest.substr(second + 1));
    }

    std::vector<double> values;

private:
    [[noreturn]] static void fail(const std::string& text) { throw InputError("", "", text); }

    /// How to write what was meant as a range, "380-780" or "380..780", or as several values.
    static std::string range_hint(std::string_view text) {
        for (const std::string_view between : {"..", "-", "to", " "}) {
            const std::size_t at = text.find(between, 1);
            if (at >= text.size()) continue;
            const auto first = parse_number(trimmed(text.substr(0, at)));
            const auto last = parse_number(trimmed(text.substr(at + between.size())));
            if (!first || !last) continue;
            const std::string start = to_text(*first), stop = to_text(*last);
            if (between == " ") return "; several values are written " + start + "," + stop;
            return "; a range is written " + start + ":" + stop + ":STEP or " + start + ":" + stop +
                   "/COUNT";
        }
        return "";
    }

    static double number(std::string_view text) {
        const auto value = parse_number(trimmed(text));
        if (!value) fail("must be a number (got " + in_quotes(text) + ")" + range_hint(text));
        return *value;
    }

    void push(double value) {
        if (values.size() >= kMostValues)
            fail("must have at most " + std::to_string(kMostValues) + " values");
        values.push_back(value);
    }

    void add_count(double start, double stop, std::string_view text) {
        const double count = number(text);
        if (count != std::floor(count) || count < 1 || count > static_cast<double>(kMostValues))
            fail("the count after '/' must be a whole number in [1, 10000000] (got '" +
                 std::string(text) + "')");
        if (count == 1 && start != stop)
            fail("the count after '/' must be at least 2 unless start equals stop (got 1)");
        const auto last = static_cast<std::size_t>(count) - 1;
        for (std::size_t i = 0; i <= last; ++i)
            push(i == last
                     ? stop
                     : start + (stop - start) * static_cast<double>(i) / static_cast<double>(last));
    }

    /// Digits after the decimal point, or -1 for a number with an exponent.
    static int decimals(std::string_view text) {
        if (text.find_first_of("eE") != std::string_view::npos) return -1;
        const std::size_t point = text.find('.');
        return point == std::string_view::npos ? 0 : static_cast<int>(text.size() - point - 1);
    }

    void add_steps(std::string_view start_text, std::string_view stop_text,
                   std::string_view step_text) {
        const double start = number(start_text), stop = number(stop_text), step = number(step_text);
        if (step == 0 || (stop - start) / step < 0)
            fail("the step must lead from start to stop (got '" + std::string(step_text) + "')");
        const double count = std::floor((stop - start) / step + 1e-9);
        if (count >= static_cast<double>(kMostValues))
            fail("must have at most " + std::to_string(kMostValues) + " values");
        // whole multiples of the last decimal place, so that rounding errors do not accumulate
        const int places = std::max(decimals(trimmed(start_text)), decimals(trimmed(step_text)));
        const bool exact = places >= 0 && places <= 12 && decimals(trimmed(start_text)) >= 0 &&
                           decimals(trimmed(step_text)) >= 0;
        const double scale = exact ? std::pow(10.0, places) : 1;
        const double a = exact ? std::round(start * scale) : start;
        const double b = exact ? std::round(step * scale) : step;
        for (std::size_t i = 0; i <= static_cast<std::size_t>(count); ++i)
            push((a + static_cast<double>(i) * b) / scale);
    }
};

}  // namespace

std::vector<std::string_view> comma_separated(std::string_view text) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (comma == std::string_view::npos) return parts;
        text.remove_prefix(comma + 1);
    }
}

std::vector<double> read_number_list(std::string_view text) {
    ListParser parser;
    for (const std::string_view item : comma_separated(text)) parser.add(item);
    return std::move(parser.values);
}

}  // namespace irido::schemas
