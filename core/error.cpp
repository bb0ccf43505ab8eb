#include "core/error.hpp"

#include <array>
#include <charconv>
#include <vector>

#include "core/nearest.hpp"

namespace irido {

std::string to_text(double value) {
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

void require_in_range(std::string_view name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;
    throw DomainError(std::string(name) + " must be in [" + to_text(lowest) + ", " +
                      to_text(highest) + "] (got " + to_text(value) + ")");
}

std::string not_one_of(std::span<const std::string_view> names, std::string_view got) {
    std::string text = "must be one of ";
    for (std::size_t i = 0; i < names.size(); ++i) text.append(i == 0 ? "" : ", ").append(names[i]);
    return text.append(" (got '").append(got).append("')") +
           did_you_mean(got, {names.begin(), names.end()});
}

}  // namespace irido
