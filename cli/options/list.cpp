#include "cli/options/list.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number_list.hpp"

namespace irido::cli {

namespace {

/// A hint for a wavelength out of range, which is often in um.
std::string unit_hint(std::string_view option, double value, double lowest) {
    const bool is_wavelength = option == "--wavelengths" || option == "--at";
    if (!is_wavelength || lowest < 0) return "";  // --at of scratches is a place
    const std::string hint = "; wavelengths are in nm";
    if (!(value > 0 && value < lowest)) return hint;
    return hint + ", " + to_text(value) + " um is " + to_text(std::round(value * 1e9) / 1e6);
}

/// A bound of a range, to at most six digits.
std::string bound(double value) {
    constexpr std::size_t kMany = 10;
    std::string exact = to_text(value);
    if (exact.size() <= kMany) return exact;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

void require_within(std::string_view option, const std::vector<double>& values, double lowest,
                    double highest) {
    for (const double value : values)
        if (!(value >= lowest && value <= highest))
            throw UsageError(std::string(option) + ": must be in [" + bound(lowest) + ", " +
                             bound(highest) + "] (got " + to_text(value) + ")" +
                             unit_hint(option, value, lowest));
}

/// A hint for a number that seems to have a decimal comma.
std::string comma_hint(std::string_view text) {
    const std::size_t comma = text.find(',');
    const bool is_decimal = comma != std::string_view::npos && comma + 1 < text.size() &&
                            text.find_first_not_of("0123456789") == comma &&
                            text.find_first_not_of("0123456789", comma + 1) == text.npos;
    if (!is_decimal) return "";
    std::string number(text);
    number[comma] = '.';
    return "; the decimal mark is a point: " + number;
}

std::vector<double> read_list(std::string_view option, std::string_view text) {
    try {
        return schemas::read_number_list(text);
    } catch (const schemas::InputError& error) {
        throw UsageError(std::string(option) + ": " + error.message);
    }
}

}  // namespace

std::vector<std::string_view> comma_separated(std::string_view text) {
    return schemas::comma_separated(text);
}

std::vector<double> parse_list(std::string_view option, std::string_view text, double lowest,
                               double highest) {
    std::vector<double> values = read_list(option, text);
    require_within(option, values, lowest, highest);
    return values;
}

double parse_one_number(std::string_view option, std::string_view text, double lowest,
                        double highest) {
    const std::vector<double> values = read_list(option, text);
    if (values.size() != 1)
        throw UsageError(std::string(option) + ": must be a single number (got '" +
                         std::string(text) + "')" + comma_hint(text));
    require_within(option, values, lowest, highest);
    return values.front();
}

std::uint64_t parse_whole_number(std::string_view option, std::string_view text, double lowest,
                                 double highest) {
    const std::vector<double> values = read_list(option, text);
    const auto refuse = [&] {
        throw UsageError(std::string(option) + ": must be a single whole number (got '" +
                         std::string(text) + "')");
    };
    if (values.size() != 1) refuse();
    require_within(option, values, lowest, highest);
    const auto whole = static_cast<std::uint64_t>(values.front());
    if (values.front() != static_cast<double>(whole)) refuse();
    return whole;
}

std::pair<double, double> parse_range(std::string_view option, std::string_view text, double lowest,
                                      double highest) {
    const std::size_t colon = text.find(':');
    const std::string rule =
        std::string(option) + ": must be LO:HI, LO not above HI (got '" + std::string(text) + "')";
    if (colon == std::string_view::npos || text.find(':', colon + 1) != std::string_view::npos)
        throw UsageError(rule);
    const double first = parse_one_number(option, text.substr(0, colon), lowest, highest);
    const double last = parse_one_number(option, text.substr(colon + 1), lowest, highest);
    if (!(first <= last)) throw UsageError(rule);
    return {first, last};
}

}  // namespace irido::cli
