// Compiled once per instruction set: this file includes itself through foreach_target.h.
#include "core/math/vector_math.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/math/vector_math.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {

/// Calls f on full vectors, the last one padded with zeros.
template <class F>
HWY_ATTR void for_each_vector(std::span<const double> x, const F& f) {
    const std::size_t step = hn::Lanes(Lanes());
    std::size_t i = 0;
    for (; i + step <= x.size(); i += step) f(hn::LoadU(Lanes(), x.data() + i), i, step);
    if (i == x.size()) return;
    HWY_ALIGN std::array<double, kMostLanes> rest{};
    std::copy(x.begin() + static_cast<std::ptrdiff_t>(i), x.end(), rest.begin());
    f(hn::Load(Lanes(), rest.data()), i, x.size() - i);
}

HWY_INLINE void store(V value, std::span<double> out, std::size_t at, std::size_t count) {
    if (count == hn::Lanes(Lanes())) return hn::StoreU(value, Lanes(), out.data() + at);
    HWY_ALIGN std::array<double, kMostLanes> values;
    hn::Store(value, Lanes(), values.data());
    std::copy_n(values.begin(), count, out.begin() + static_cast<std::ptrdiff_t>(at));
}

void all_sin_cos(std::span<const double> x, std::span<double> sine, std::span<double> cosine) {
    for_each_vector(x, [=](V value, std::size_t at, std::size_t count) HWY_ATTR {
        const SinCos both = sin_cos(value);
        store(both.sin, sine, at, count);
        store(both.cos, cosine, at, count);
    });
}

void all_expm1(std::span<const double> x, std::span<double> out) {
    for_each_vector(x, [=](V value, std::size_t at, std::size_t count)
                           HWY_ATTR { store(expm1(value), out, at, count); });
}

std::size_t lane_count() {
    return hn::Lanes(Lanes());
}

double chains(std::uint64_t count) {
    const V factor = constant(1 - 0x1p-20), summand = constant(0x1p-20);
    V a = constant(0.5), b = a, c = a, d = a, e = a, f = a, g = a, h = a, i = a, j = a;
    for (std::uint64_t n = 0; n < count; n += 10) {
        a = hn::MulAdd(a, factor, summand);
        b = hn::MulAdd(b, factor, summand);
        c = hn::MulAdd(c, factor, summand);
        d = hn::MulAdd(d, factor, summand);
        e = hn::MulAdd(e, factor, summand);
        f = hn::MulAdd(f, factor, summand);
        g = hn::MulAdd(g, factor, summand);
        h = hn::MulAdd(h, factor, summand);
        i = hn::MulAdd(i, factor, summand);
        j = hn::MulAdd(j, factor, summand);
    }
    const V first = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, d)), hn::Add(i, j));
    return hn::GetLane(hn::Add(first, hn::Add(hn::Add(e, f), hn::Add(g, h))));
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void sin_cos(std::span<const double> x, std::span<double> sine, std::span<double> cosine,
             SimdLevel level) {
    IRIDO_DISPATCH(level, all_sin_cos)(x, sine, cosine);
}

void expm1(std::span<const double> x, std::span<double> out, SimdLevel level) {
    IRIDO_DISPATCH(level, all_expm1)(x, out);
}

std::size_t lanes(SimdLevel level) {
    return IRIDO_DISPATCH(level, lane_count)();
}

double multiply_adds(std::uint64_t count, SimdLevel level) {
    return IRIDO_DISPATCH(level, chains)(count);
}

}  // namespace irido

#endif
