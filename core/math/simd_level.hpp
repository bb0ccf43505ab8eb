#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace irido {

/// How many points are computed together, and with which instructions.
enum class SimdLevel {
    plain,     ///< the plain kernel, without the vector one
    baseline,  ///< the vector kernel for any machine, one point at a time
    avx2,      ///< AVX2 and FMA, 4 doubles
    avx512,    ///< AVX-512 F, BW, CD, DQ and VL, 8 doubles
};
inline constexpr std::array kSimdLevels{SimdLevel::plain, SimdLevel::baseline, SimdLevel::avx2,
                                        SimdLevel::avx512};

/// Lanes of the widest vector of doubles. Rows that vectors read are as much longer than what they
/// hold, so that the last vector needs no care.
inline constexpr std::size_t kMostLanes = 8;

/// The next multiple of kMostLanes.
constexpr std::size_t whole_vectors(std::size_t count) {
    return (count + kMostLanes - 1) / kMostLanes * kMostLanes;
}

/// "plain", "baseline", "avx2", "avx512".
std::string_view name_of(SimdLevel level);

/// Whether this machine runs it.
bool is_available(SimdLevel level);

/// The widest that this machine runs.
SimdLevel best_simd_level();

/// How a computation is to be run; the answer depends on `simd` in its last digits only and on
/// `threads` not at all.
struct Execution {
    unsigned threads = 0;  ///< 0: one a core
    SimdLevel simd = best_simd_level();

    Execution(unsigned threads_ = 0, SimdLevel simd_ = best_simd_level())
        : threads(threads_), simd(simd_) {}
};

}  // namespace irido
