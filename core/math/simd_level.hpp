#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace irido {

/// Instruction set of a computation, and how many points it handles at once.
enum class SimdLevel {
    plain,     ///< the scalar kernel
    baseline,  ///< the vector kernel on any machine, one point at a time
    avx2,      ///< AVX2 and FMA, 4 doubles
    avx512,    ///< AVX-512 F, BW, CD, DQ and VL, 8 doubles
};
inline constexpr std::array kSimdLevels{SimdLevel::plain, SimdLevel::baseline, SimdLevel::avx2,
                                        SimdLevel::avx512};

/// Lanes of the widest vector of doubles. Rows read as vectors are padded by that many values, so
/// that the last vector needs no special case.
inline constexpr std::size_t kMostLanes = 8;

/// `count` rounded up to a multiple of kMostLanes.
constexpr std::size_t whole_vectors(std::size_t count) {
    return (count + kMostLanes - 1) / kMostLanes * kMostLanes;
}

/// "plain", "baseline", "avx2", "avx512".
std::string_view name_of(SimdLevel level);

/// Whether this machine supports the level.
bool is_available(SimdLevel level);

/// The widest level that this machine supports.
SimdLevel best_simd_level();

/// How to run a computation. Results depend on `simd` in the last digits only, and not at all on
/// `threads`.
struct Execution {
    unsigned threads = 0;  ///< 0: one per core
    SimdLevel simd = best_simd_level();

    Execution(unsigned threads_ = 0, SimdLevel simd_ = best_simd_level())
        : threads(threads_), simd(simd_) {}
};

}  // namespace irido
