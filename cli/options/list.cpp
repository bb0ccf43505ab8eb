#include "cli/options/list.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "schemas/readers/number.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kMostValues = 10'000'000;

class ListParser {
public:
    ListParser(std::string_view option, double lowest, double highest)
        : option_(option), lowest_(lowest), highest_(highest) {}

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
    [[noreturn]] void fail(const std::string& text) const {
        throw UsageError(std::string(option_) + ": " + text);
    }

    /// A wavelength out of range is often one in um.
    std::string unit_hint(double value) const {
        if (option_ != "--wavelengths" && option_ != "--at") return "";
        const std::string hint = "; wavelengths are in nm";
        if (!(value > 0 && value < lowest_)) return hint;
        return hint + ", " + to_text(value) + " um is " + to_text(std::round(value * 1e9) / 1e6);
    }

    double number(std::string_view text) const {
        const auto value = schemas::parse_number(schemas::trimmed(text));
        if (!value) fail("must be a number (got '" + std::string(text) + "')");
        return *value;
    }

    void push(double value) {
        if (values.size() >= kMostValues)
            fail("must have at most " + std::to_string(kMostValues) + " values");
        try {
            require_in_range(option_, value, lowest_, highest_);
        } catch (const DomainError&) {
            fail("must be in [" + to_text(lowest_) + ", " + to_text(highest_) + "] (got " +
                 to_text(value) + ")" + unit_hint(value));
        }
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
        const int places =
            std::max(decimals(schemas::trimmed(start_text)), decimals(schemas::trimmed(step_text)));
        const bool exact = places >= 0 && places <= 12 &&
                           decimals(schemas::trimmed(start_text)) >= 0 &&
                           decimals(schemas::trimmed(step_text)) >= 0;
        const double scale = exact ? std::pow(10.0, places) : 1;
        const double a = exact ? std::round(start * scale) : start;
        const double b = exact ? std::round(step * scale) : step;
        for (std::size_t i = 0; i <= static_cast<std::size_t>(count); ++i)
            push((a + static_cast<double>(i) * b) / scale);
    }

    std::string_view option_;
    double lowest_, highest_;
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

std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest) {
    ListParser parser(option, lowest, highest);
    for (const std::string_view item : comma_separated(text)) parser.add(item);
    return std::move(parser.values);
}

double parse_one_number(std::string_view option, std::string_view text, double lowest,
                        double highest) {
    const std::vector<double> values = parse_list(option, text, lowest, highest);
    if (values.size() != 1)
        throw UsageError(std::string(option) + ": must be a single number (got '" +
                         std::string(text) + "')");
    return values.front();
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text, double lowest,
                                 double highest) {
    const std::vector<double> values = parse_list(option, text, lowest, highest);
    const auto whole = static_cast<std::uint64_t>(values.front());
    if (values.size() != 1 || values.front() != static_cast<double>(whole))
        throw UsageError(std::string(option) + ": must be a single whole number (got '" +
                         std::string(text) + "')");
    return whole;
}

std::pair<double, double> parse_range(std::string_view option, std::string_view text, double lowest,
                                      double highest) {
    const std::size_t colon = text.find(':');
    const std::string rule = std::string(option) +
                             ": must be FIRST:LAST, FIRST not above LAST (got '" +
                             std::string(text) + "')";
    if (colon == std::string_view::npos || text.find(':', colon + 1) != std::string_view::npos)
        throw UsageError(rule);
    const double first = parse_one_number(option, text.substr(0, colon), lowest, highest);
    const double last = parse_one_number(option, text.substr(colon + 1), lowest, highest);
    if (!(first <= last)) throw UsageError(rule);
    return {first, last};
}

}  // namespace irido::cli
