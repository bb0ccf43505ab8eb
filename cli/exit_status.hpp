#pragma once

namespace irido::cli {

/// Non-zero exit statuses; a run ended by a signal has 128 plus the signal's number.
inline constexpr int kCheckFailed = 1;  ///< computed, but a tolerance was not met or a check failed
inline constexpr int kBadInput = 2;     ///< the command line, an input or an output was refused

}  // namespace irido::cli
