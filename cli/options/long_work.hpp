#pragma once

#include <ctime>
#include <functional>
#include <string>

#include "tables/lut/lut_maker.hpp"

namespace irido::cli {

/// Work that is announced takes more than this.
inline constexpr double kLongWork_s = 60;

/// A first trial of work whose units may themselves be long.
inline constexpr double kFirstShare = 1.0 / 1024;

/// Seconds of the processor, on all threads, whatever else the machine is doing.
double processor_seconds(const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// `asked`, or one for each core where that is 0.
unsigned threads_used(unsigned asked);

/// Seconds that work of equal units will take, or fewer than `long_s` if that is all that is known.
/// Tries more and more of it until its time can be told, which takes a tenth of a second, a first
/// trial, or a twentieth of the work. What a trial throws is left for the work itself to find: 0.
/// first       units of the first trial; may be part of one
/// seconds_of  seconds that so many units take
double tried_seconds(double units, double first,
                     const std::function<double(double units)>& seconds_of,
                     double long_s = kLongWork_s);

/// Whether even a trial of a table takes long: colours of three spread layers.
bool is_slow(const tables::LutKind& kind, const tables::LutRequest& request);
inline constexpr const char* kSlowNote =
    "colours of three layers with a thickness_sigma_nm take seconds each: this may take hours";

/// The seconds that a table will take, or, with a tolerance, the fewest; tried_seconds() with
/// `share` of kLongWork_s.
double least_seconds(const tables::LutPlan& plan, const tables::LutMaking& making,
                     double share = 1);

/// "1 s", "20 s", "3 minutes", "5 hours", "2 days": one digit, or two.
std::string coarse_time(double seconds);

/// Says how long work takes, if that is long; `is_least`: or longer.
void note_long_work(double seconds, bool is_least,
                    const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
