#pragma once

#include <ctime>
#include <functional>
#include <string>

#include "tables/lut/lut_maker.hpp"

namespace irido::cli {

/// Work that takes longer than this is announced.
inline constexpr double kLongWork_s = 60;

/// Size of the first trial, in units, of work whose single units may take long.
inline constexpr double kFirstShare = 1.0 / 1024;

/// Processor time of `work` in seconds, summed over all threads: independent of the machine's load.
double processor_seconds(const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// `asked`, or one thread per core if it is 0.
unsigned threads_used(unsigned asked);

/// Estimated seconds of work that consists of equal units. Times increasingly large trials until
/// one takes a tenth of a second, or the estimate is below `long_s`, or a trial would exceed a
/// twentieth of the work. 0 if a trial throws: the work itself will report the error.
/// units       units in the whole work
/// first       units in the first trial; may be a fraction
/// seconds_of  runs a trial of that many units and returns its seconds
/// long_s      seconds below which a rough estimate is enough
double tried_seconds(double units, double first,
                     const std::function<double(double units)>& seconds_of,
                     double long_s = kLongWork_s);

/// Whether even a trial of a table takes long, as for colours with three thickness distributions.
bool is_slow(const tables::LutKind& kind, const tables::LutRequest& request);
inline constexpr const char* kSlowNote =
    "colours of three layers with a thickness_sigma_nm take seconds each: this may take hours";

/// Estimated seconds to make a table or, with a tolerance, a lower bound: tried_seconds() with
/// `share` of kLongWork_s.
double least_seconds(const tables::LutPlan& plan, const tables::LutMaking& making,
                     double share = 1);

/// "1 s", "20 s", "3 minutes", "5 hours", "2 days": one or two significant digits.
std::string coarse_time(double seconds);

/// Announces work that will take long; `is_least` adds "or longer".
void note_long_work(double seconds, bool is_least,
                    const std::function<void(const std::string&)>& say);

}  // namespace irido::cli
