// Compiled once for every instruction set: this file includes itself through foreach_target.h.
#include "core/color/fourier/film_orders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/math/vector_math.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/color/fourier/film_orders.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

#ifndef IRIDO_FILM_ORDERS_ONCE
#define IRIDO_FILM_ORDERS_ONCE
namespace irido {

/// A film's fringes with the carrier's turn over D in each bounce.
struct CarriedOrders {
    FilmOrders orders;
    std::array<double, 2> ratio;
};

}  // namespace irido
#endif

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

constexpr std::size_t kLanes = hn::MaxLanes(Lanes()), kParts = 8 / kLanes;

/// {re, -im, re, -im ...}, the factors of the real and imaginary parts in a row; `part` is only
/// asked where a vector is a single number.
HWY_INLINE V factors(double re, double im, [[maybe_unused]] std::size_t part) {
#if HWY_TARGET == HWY_SCALAR
    return constant(part % 2 == 0 ? re : -im);
#else
    return hn::OddEven(constant(-im), constant(re));
#endif
}

HWY_INLINE OrderSum sum_one(const SensitivityTransform& transform, const CarriedOrders& carried,
                            double tolerance, std::size_t last) {
    const auto& [opd_nm, weight, bounce] = carried.orders;
    const std::span<const double> largest = transform.largest();
    const std::size_t rows = transform.rows();
    const double place = opd_nm / SensitivityTransform::kInterval_nm;
    const auto end = static_cast<double>(largest.size());
    std::array<double, 2> re{2 * weight[0], 2 * weight[1]}, im{};
    std::array<double, 2> rest{};  // of all orders from m on, by their size
    for (std::size_t k = 0; k < 2; ++k)
        if (weight[k] != 0)
            rest[k] = 2 * std::abs(weight[k]) * carried.ratio[k] / (1 - carried.ratio[k]);
    const double all = rest[0] + rest[1];
    V sum[kParts];
    for (std::size_t part = 0; part < kParts; ++part) sum[part] = constant(0);
    double left_out = 0;
    for (std::size_t m = 1;; ++m) {
        const double at = static_cast<double>(m) * place;
        const double from_first = at + 0.5;  // in intervals, from the beginning of the first one
        const bool outside = from_first >= end;
        const auto interval = static_cast<std::size_t>(
            outside ? std::int64_t{0} : static_cast<std::int64_t>(from_first));
        left_out = rest[0] + rest[1];
        if (left_out == 0) break;
        left_out *= outside ? transform.bound(static_cast<double>(m) * opd_nm) : largest[interval];
        if (left_out <= tolerance || outside || m > last) break;
        for (std::size_t k = 0; k < 2; ++k) {
            const double b_re = bounce[k].real(), b_im = bounce[k].imag();
            const double next = re[k] * b_re - im[k] * b_im;
            im[k] = re[k] * b_im + im[k] * b_re;
            re[k] = next;
            rest[k] *= carried.ratio[k];
        }
        const V x = constant(2 * (at - static_cast<double>(interval)));
        const double* const row = transform.table()[interval * rows].value.data();
        for (std::size_t part = 0; part < kParts; ++part) {
            const double* const column = row + part * kLanes;
            V h = hn::Load(Lanes(), column + (rows - 1) * 8);
            for (std::size_t r = rows - 1; r-- > 0;)
                h = hn::MulAdd(h, x, hn::Load(Lanes(), column + r * 8));
            sum[part] = hn::MulAdd(h, factors(re[0] + re[1], im[0] + im[1], part), sum[part]);
        }
    }
    HWY_ALIGN std::array<double, 8> lanes;
    for (std::size_t part = 0; part < kParts; ++part)
        hn::Store(sum[part], Lanes(), lanes.data() + part * kLanes);
    return {{lanes[0] + lanes[1], lanes[2] + lanes[3], lanes[4] + lanes[5]},
            left_out + all * transform.error()};
}

}  // namespace

void sum_each(const SensitivityTransform& transform, std::span<const CarriedOrders> carried,
              double tolerance, std::size_t last, std::span<OrderSum> sums) {
    for (std::size_t i = 0; i < carried.size(); ++i)
        sums[i] = sum_one(transform, carried[i], tolerance, last);
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

void sum_orders(const SensitivityTransform& transform, std::span<const FilmOrders> orders,
                const OrderLimits& limits, std::span<OrderSum> sums, SimdLevel level) {
    constexpr std::size_t kTogether = 32;
    std::array<double, kTogether> angle, sine, cosine;
    std::array<CarriedOrders, kTogether> carried;
    const std::size_t last =
        limits.last == 0 ? std::numeric_limits<std::size_t>::max() : limits.last;
    for (std::size_t begin = 0; begin < orders.size(); begin += kTogether) {
        const std::size_t count = std::min(kTogether, orders.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const double turns = orders[begin + i].opd_nm * transform.carrier();
            angle[i] = 2 * std::numbers::pi * (turns - std::round(turns));
        }
        sin_cos(std::span(angle).first(count), std::span(sine).first(count),
                std::span(cosine).first(count), level);
        for (std::size_t i = 0; i < count; ++i) {
            carried[i].orders = orders[begin + i];
            for (std::size_t k = 0; k < 2; ++k) {
                Complex& bounce = carried[i].orders.bounce[k];
                carried[i].ratio[k] =
                    std::sqrt(bounce.real() * bounce.real() + bounce.imag() * bounce.imag());
                bounce = {bounce.real() * cosine[i] - bounce.imag() * sine[i],
                          bounce.real() * sine[i] + bounce.imag() * cosine[i]};
            }
        }
        IRIDO_DISPATCH(level, sum_each)
        (transform, std::span(carried).first(count), limits.tolerance, last,
         sums.subspan(begin, count));
    }
}

}  // namespace irido

#endif
