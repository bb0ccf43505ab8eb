#pragma once

/// Instruction sets that Highway compiles the vector code for, one per SimdLevel. Highway's own
/// dispatch is not used, so its library is not linked and the level is an argument.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
/// The baseline is Highway's scalar target with every compiler: some would take 128 emulated bits.
#define HWY_BROKEN_EMU128 1

/// Selects the instance of a function in irido::HWY_NAMESPACE for a SimdLevel.
#if defined(__x86_64__)
#define IRIDO_DISPATCH(level, function)                        \
    ((level) == SimdLevel::avx512 ? &::irido::N_AVX3::function \
     : (level) == SimdLevel::avx2 ? &::irido::N_AVX2::function \
                                  : &::irido::N_SCALAR::function)
#else
#define IRIDO_DISPATCH(level, function) ((void)(level), &HWY_STATIC_DISPATCH(function))
#endif
