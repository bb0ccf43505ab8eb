#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irido {

/// An argument outside the closed range that a function of core states. The text names the
/// argument, the rule and the value: "thickness_nm must be in [0, 1e9] (got -5)".
class DomainError : public std::domain_error {
public:
    using std::domain_error::domain_error;
};

/// Shortest decimal text that reads back to the same double.
std::string to_text(double value);

/// Throws DomainError unless `value` lies in the closed range [lowest, highest]; NaN never does.
void require_in_range(std::string_view name, double value, double lowest, double highest);

/// "must be one of a, b, c (got x)".
std::string not_one_of(std::span<const std::string_view> names, std::string_view got);

}  // namespace irido
