#pragma once

#include <cstdint>
#include <vector>

#include "core/scratch/scratch.hpp"

namespace irido {

/// Range of a uniformly distributed number; low = high for a fixed value.
struct DrawnRange {
    double low = 0, high = 0;
};

/// Straight scratches that lie anywhere, without end: of each square millimetre a Poisson number.
struct ScratchField {
    double count_per_mm2 = 1;         ///< [0, 1e6]
    DrawnRange length_um{200, 3000};  ///< within (0, 1e5]
    DrawnRange width_um{1, 1};
    DrawnRange depth_um{0.1, 0.1};
    DrawnRange angle_deg{-180, 180};
};

/// Throws DomainError naming the member unless all members are in range.
void require_valid(const ScratchField& field);

/// All scratches of a field whose axis comes nearer than `radius_um` to a point, ordered by cell.
/// A scratch is drawn from the seed, the field's number and the 1 mm cell that contains its middle,
/// so every query sees the same scratches, on every machine. Throws DomainError for an argument out
/// of range or more than kMostDrawn draws.
///   field         distribution of the scratches
///   seed          of the random numbers
///   field_number  [0, 65535]
///   at            the point, |x|, |y| <= 1e9 um
///   radius_um     [0, 1e7]
std::vector<Scratch> scratches_near(const ScratchField& field, std::uint64_t seed,
                                    std::uint32_t field_number, SurfacePoint at, double radius_um);
inline constexpr double kMostDrawn = 5e7;

/// Distance of a point from a scratch's axis between its ends, um.
double distance_um(const Scratch& scratch, SurfacePoint at);

}  // namespace irido
