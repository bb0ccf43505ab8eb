#include "core/math/simd_level.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace irido {

std::string_view name_of(SimdLevel level) {
    switch (level) {
        case SimdLevel::avx512:
            return "avx512";
        case SimdLevel::avx2:
            return "avx2";
        case SimdLevel::baseline:
            return "baseline";
        case SimdLevel::plain:
            break;
    }
    return "plain";
}

bool is_available(SimdLevel level) {
#if defined(__x86_64__)
    unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
    const bool f16c = __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_F16C) != 0;
    const bool avx2 = f16c && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi2");
    if (level == SimdLevel::avx512)
        return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (level == SimdLevel::avx2) return avx2;
#endif
    return level == SimdLevel::baseline || level == SimdLevel::plain;
}

SimdLevel best_simd_level() {
    static const SimdLevel best = is_available(SimdLevel::avx512) ? SimdLevel::avx512
                                  : is_available(SimdLevel::avx2) ? SimdLevel::avx2
                                                                  : SimdLevel::baseline;
    return best;
}

}  // namespace irido
