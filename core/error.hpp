#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irido {

/// Whatever irido refuses or cannot do, as one line for the user: what catches errors of one room
/// cannot miss those of another.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What was asked for cannot be had, though nothing is wrong with the input: exit status 1.
class CheckFailed : public Error {
public:
    using Error::Error;
};

/// A tolerance that cannot be met.
class ToleranceError : public CheckFailed {
public:
    using CheckFailed::CheckFailed;
};

/// An argument outside the closed range that a function of core states. The text names the
/// argument, the rule and the value: "thickness_nm must be in [0, 1e9] (got -5)".
class DomainError : public Error {
public:
    using Error::Error;
};

/// Shortest decimal text that reads back to the same double.
std::string to_text(double value);

/// Throws DomainError unless `value` lies in the closed range [lowest, highest]; NaN never does.
void require_in_range(std::string_view name, double value, double lowest, double highest);

/// "must be one of a, b, c (got x)".
std::string not_one_of(std::span<const std::string_view> names, std::string_view got);

}  // namespace irido
