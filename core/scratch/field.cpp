#include "core/scratch/field.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/degrees.hpp"
#include "core/math/philox.hpp"

namespace irido {

namespace {

constexpr double kCell_um = 1000, kLongestScratch_um = 1e5;

void require_range(const char* name, const DrawnRange& range, double lowest, double highest) {
    require_in_range(name, range.low, lowest, highest);
    require_in_range(name, range.high, lowest, highest);
    if (range.low > range.high)
        throw DomainError(std::string(name) + " must ascend (got " + to_text(range.low) + ", " +
                          to_text(range.high) + ")");
}

double drawn(const DrawnRange& range, PhiloxSequence& numbers) {
    return std::min(numbers.uniform(range.low, range.high), range.high);
}

/// Knuth's product of uniform numbers, in parts whose exp(-mean) a double holds.
std::uint32_t poisson(double mean, PhiloxSequence& numbers) {
    constexpr double kPart = 256;
    std::uint32_t count = 0;
    for (double rest = mean; rest > 0; rest -= kPart) {
        const double limit = std::exp(-std::min(rest, kPart));
        for (double product = numbers.next(); product > limit; product *= numbers.next()) ++count;
    }
    return count;
}

}  // namespace

void require_valid(const ScratchField& field) {
    constexpr double kMostPerArea = 1e6, kLeast = std::numeric_limits<double>::min();
    require_in_range("count_per_mm2", field.count_per_mm2, 0, kMostPerArea);
    require_range("length_um", field.length_um, kLeast, kLongestScratch_um);
    require_range("width_um", field.width_um, kLeast, kWidest_um);
    require_range("depth_um", field.depth_um, 0, kDeepest_um);
    require_range("angle_deg", field.angle_deg, -360, 360);
}

double distance_um(const Scratch& scratch, SurfacePoint at) {
    const double tx = cos_deg(scratch.angle_deg), ty = sin_deg(scratch.angle_deg);
    const double dx = at.x_um - scratch.point.x_um, dy = at.y_um - scratch.point.y_um;
    const double along = dx * tx + dy * ty, across = dy * tx - dx * ty;
    const double past = std::max({scratch.start_um - along, along - scratch.end_um, 0.0});
    return std::hypot(past, across);
}

std::vector<Scratch> scratches_near(const ScratchField& field, std::uint64_t seed,
                                    std::uint32_t field_number, SurfacePoint at, double radius_um) {
    require_valid(field);
    require_in_range("x_um", at.x_um, -Scratch::kLongest_um, Scratch::kLongest_um);
    require_in_range("y_um", at.y_um, -Scratch::kLongest_um, Scratch::kLongest_um);
    require_in_range("radius_um", radius_um, 0, 1e7);
    require_in_range("field number", field_number, 0, 65535);
    const double reach = field.length_um.high / 2 + radius_um;
    const auto cell_of = [](double place) {
        return static_cast<std::int64_t>(std::floor(place / kCell_um));
    };
    const std::int64_t left = cell_of(at.x_um - reach), right = cell_of(at.x_um + reach),
                       low = cell_of(at.y_um - reach), high = cell_of(at.y_um + reach);
    const double draws = static_cast<double>(right - left + 1) *
                         static_cast<double>(high - low + 1) * field.count_per_mm2;
    if (draws > kMostDrawn)
        throw DomainError("the field has " + to_text(draws) + " scratches in reach, more than " +
                          to_text(kMostDrawn));
    std::vector<Scratch> found;
    for (std::int64_t row = low; row <= high; ++row)
        for (std::int64_t column = left; column <= right; ++column) {
            PhiloxSequence numbers(philox_key(seed),
                                   {field_number, static_cast<std::uint32_t>(column),
                                    static_cast<std::uint32_t>(row)});
            const std::uint32_t count = poisson(field.count_per_mm2, numbers);
            for (std::uint32_t i = 0; i < count; ++i) {
                Scratch scratch;
                scratch.point = {(static_cast<double>(column) + numbers.next()) * kCell_um,
                                 (static_cast<double>(row) + numbers.next()) * kCell_um};
                const double length = drawn(field.length_um, numbers);
                scratch.start_um = -length / 2;
                scratch.end_um = length / 2;
                scratch.width_um = drawn(field.width_um, numbers);
                scratch.depth_um = drawn(field.depth_um, numbers);
                scratch.angle_deg = drawn(field.angle_deg, numbers);
                if (distance_um(scratch, at) <= radius_um) found.push_back(scratch);
            }
        }
    return found;
}

}  // namespace irido
