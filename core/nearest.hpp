#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irido {

/// The candidate that `word` is most likely a misspelling of, or "" if none is close: at most one
/// edit, or one per three letters, ignoring case.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// ` (did you mean "X"?)` with the nearest candidate, or "".
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace irido
