#pragma once

namespace irido::cli {

/// Exit statuses besides 0; a run that a signal ends has 128 and the signal's number.
inline constexpr int kCheckFailed = 1;  ///< computed, but a tolerance or a check is not met
inline constexpr int kBadInput = 2;     ///< the command line, an input or an output was refused

}  // namespace irido::cli
