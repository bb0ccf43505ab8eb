#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace irido {

/// Base class of every error that irido reports; what() is one line for the user. Catching it
/// misses none, whichever part of irido threw it.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The input is valid but the request cannot be satisfied: exit status 1.
class CheckFailed : public Error {
public:
    using Error::Error;
};

/// The requested tolerance cannot be met.
class ToleranceError : public CheckFailed {
public:
    using CheckFailed::CheckFailed;
};

/// An argument outside the closed range documented for it. The message names the argument, the rule
/// and the value: "thickness_nm must be in [0, 1e9] (got -5)".
class DomainError : public Error {
public:
    using Error::Error;
};

/// Shortest decimal string that reads back to the same double.
std::string to_text(double value);

/// Throws DomainError unless a value lies in a closed range; NaN always throws.
///   name             of the argument, for the message
///   value            to check
///   lowest, highest  ends of the range
void require_in_range(std::string_view name, double value, double lowest, double highest);

/// "must be one of a, b, c (got x)".
std::string not_one_of(std::span<const std::string_view> names, std::string_view got);

}  // namespace irido
