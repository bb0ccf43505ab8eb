// Compiled once for every instruction set: this file includes itself through foreach_target.h.
#include "core/color/bloch/bloch_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/math/transform.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/color/bloch/bloch_sums.cpp"
#include "core/math/vector_targets.hpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "core/math/vector_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace irido::HWY_NAMESPACE {
namespace {

struct ComplexV {
    V re, im;
};

HWY_INLINE ComplexV times(ComplexV x, ComplexV y) {
    return {hn::NegMulAdd(x.im, y.im, hn::Mul(x.re, y.re)),
            hn::MulAdd(x.re, y.im, hn::Mul(x.im, y.re))};
}
HWY_INLINE ComplexV squared(ComplexV x) {
    const V twice = hn::Add(x.re, x.re);
    return {hn::NegMulAdd(x.im, x.im, hn::Mul(x.re, x.re)), hn::Mul(twice, x.im)};
}

HWY_INLINE ComplexV whole_power(ComplexV x, std::uint64_t n) {
    while ((n & 1) == 0) {
        x = squared(x);
        n >>= 1;
    }
    ComplexV result = x;
    while ((n >>= 1) > 0) {
        x = squared(x);
        if (n & 1) result = times(result, x);
    }
    return result;
}

/// What bloch_point() has, at a vector of omegas, with its constants made ready.
struct PointV {
    V sin2, cos2, u, v;
};
struct Constants {
    double half_sum, half_difference;           ///< of the paths
    double q_plus, q_minus, r_plus, r_minus;    ///< (1 +- q)/2 and (1 +- 1/q)/2
    double cross, first_in_M12, second_in_M12;  ///< (Yin - Yout)(1/q - q)/2, Yin Yout / Y
    double Y_first, Y_second;
    double P, four_Y;  ///< Y_in + Y_out, 4 Y_in Y_out
};

HWY_INLINE Constants constants_of(const BlochMirror& m) {
    const double q = m.Y_second / m.Y_first, product = m.Y_in * m.Y_out;
    return {(m.period.path1_nm + m.period.path2_nm) / 2,
            (m.period.path1_nm - m.period.path2_nm) / 2,
            (1 + q) / 2,
            (1 - q) / 2,
            (1 + 1 / q) / 2,
            (1 - 1 / q) / 2,
            (m.Y_in - m.Y_out) * (1 / q - q) / 2,
            product / m.Y_first,
            product / m.Y_second,
            m.Y_first,
            m.Y_second,
            m.Y_in + m.Y_out,
            4 * product};
}

HWY_INLINE PointV point(const Constants& k, V omega) {
    const V x[2] = {hn::Mul(omega, constant(k.half_sum)),
                    hn::Mul(omega, constant(k.half_difference))};
    SinCos out[2];
    sin_cos<2>(x, out);
    const auto [sin_h, cos_h] = out[0];
    const auto [sin_g, cos_g] = out[1];
    const auto mix = [](V a, double plus, V b, double minus) {
        return hn::MulAdd(a, constant(plus), hn::Mul(b, constant(minus)));
    };
    const V sc = hn::Mul(sin_h, cos_g), cs = hn::Mul(cos_h, sin_g);
    const V cc = hn::Mul(cos_h, cos_g), ss = hn::Mul(sin_h, sin_g);
    const V sin_a = hn::Add(sc, cs), sin_b = hn::Sub(sc, cs);
    const V cos_a = hn::Sub(cc, ss), cos_b = hn::Add(cc, ss);
    const V one = hn::Mul(sin_a, cos_b), other = hn::Mul(cos_a, sin_b);
    return {hn::Mul(mix(sin_h, k.q_plus, sin_g, k.q_minus), mix(sin_h, k.r_plus, sin_g, k.r_minus)),
            hn::Mul(mix(cos_h, k.q_plus, cos_g, k.q_minus), mix(cos_h, k.r_plus, cos_g, k.r_minus)),
            hn::Mul(constant(k.cross), hn::Mul(sin_a, sin_b)),
            hn::Abs(hn::MulAdd(one, constant(k.first_in_M12 + k.Y_first),
                               hn::Mul(other, constant(k.second_in_M12 + k.Y_second))))};
}

/// In a band, without its ends.
struct BandPoint : PointV {
    V sine;
};
HWY_INLINE BandPoint in_band(const PointV& at) {
    const V tiny = constant(1e-290);
    const V sin2 = hn::Max(at.sin2, tiny), cos2 = hn::Max(at.cos2, tiny);
    return {{sin2, cos2, at.u, at.v}, hn::Mul(constant(2), hn::Sqrt(hn::Mul(sin2, cos2)))};
}

/// T in a band, all of it.
HWY_INLINE V whole_transmittance(const Constants& k, const BandPoint& at, std::uint64_t repeat) {
    const ComplexV z = whole_power({hn::Sub(at.cos2, at.sin2), at.sine}, repeat);
    const V p = hn::Mul(constant(k.P), at.sine);
    const V down = hn::MulAdd(p, z.re, hn::Mul(at.u, z.im)), across = hn::Mul(at.v, z.im);
    const V size = hn::MulAdd(down, down, hn::Mul(across, across));
    return hn::Div(hn::Mul(constant(k.four_Y), hn::Mul(at.sine, at.sine)), size);
}

HWY_INLINE V average_transmittance(const Constants& k, const BandPoint& at) {
    return hn::Div(hn::Mul(constant(k.four_Y / k.P), at.sine), at.v);
}

/// The average and the harmonics 1 .. terms - 1: with b the bounce
/// average (1 + 2 Re (b - b^terms) / (1 - b)).
HWY_INLINE V some_transmittance(const Constants& k, const BandPoint& at, std::uint64_t repeat,
                                std::uint64_t terms) {
    const V p = hn::Mul(constant(k.P), at.sine), p2 = hn::Mul(p, p);
    const V rest = hn::MulAdd(at.u, at.u, hn::Mul(at.v, at.v)), half = constant(0.5);
    const V A = hn::Mul(half, hn::Add(p2, rest));
    const V scale = hn::Div(constant(-1), hn::MulAdd(p, at.v, A));
    const ComplexV B{hn::Mul(scale, hn::Mul(half, hn::Sub(p2, rest))),
                     hn::Neg(hn::Mul(scale, hn::Mul(p, at.u)))};
    const ComplexV z = whole_power({hn::Sub(at.cos2, at.sin2), at.sine}, 2 * repeat);
    const ComplexV b = times(B, z), last = whole_power(b, terms);
    const V re = hn::Sub(constant(1), b.re);
    const V size = hn::Max(hn::MulAdd(re, re, hn::Mul(b.im, b.im)), constant(1e-290));
    // Re (b - last) conj(1 - b)
    const V product =
        hn::NegMulAdd(hn::Sub(b.im, last.im), b.im, hn::Mul(hn::Sub(b.re, last.re), re));
    const V sum = hn::Div(product, size);
    return hn::Mul(average_transmittance(k, at), hn::MulAdd(constant(2), sum, constant(1)));
}

HWY_INLINE V gap_transmittance(const Constants& k, const PointV& at, bool is_odd, double repeat) {
    const V x = hn::Max(hn::Neg(is_odd ? at.cos2 : at.sin2), constant(1e-290));
    const V one = constant(1);
    const V kappa = hn::Mul(constant(2), asinh(hn::Sqrt(x)));
    const V sinh = hn::Mul(constant(2), hn::Sqrt(hn::MulAdd(x, x, x)));
    const V exponent = hn::Max(hn::Mul(constant(-2 * repeat), kappa), constant(-600));
    const V less = expm1(exponent), e = hn::Add(less, one), whole = hn::Add(one, e);
    const V U = hn::Div(hn::Neg(less), hn::Mul(whole, sinh));
    const V turned = is_odd ? hn::Neg(U) : U;
    const V down = hn::MulAdd(at.u, turned, constant(k.P)), across = hn::Mul(at.v, U);
    const V size = hn::MulAdd(down, down, hn::Mul(across, across));
    return hn::Div(hn::Mul(constant(4 * k.four_Y), e), hn::Mul(hn::Mul(whole, whole), size));
}

/// Places of the nodes in the table and the weights of its rows there, times what of(omega) gives.
template <class Of>
HWY_INLINE void fill(const BlochRange& range, const CosineNodes& nodes,
                     const std::vector<double>& rule, const SmoothSensitivity& sensitivity,
                     BlochMemory& memory, const Of& of) {
    const std::size_t stride = nodes.x.size();
    const V middle = constant((range.low + range.high) / 2);
    const V half = constant((range.high - range.low) / 2);
    const double per_omega = sensitivity.per_nu() / (2 * std::numbers::pi);
    const V scale = constant(per_omega),
            offset = constant(sensitivity.first() * sensitivity.per_nu());
    double* place = memory.place.data();
    double* weight = memory.weight.data();
    const V one = constant(1), two = constant(2), sixth = constant(1.0 / 6), third = constant(0.5);
    for (std::size_t j = 0; j < stride; j += hn::Lanes(Lanes())) {
        const V omega = hn::MulAdd(half, hn::LoadU(Lanes(), nodes.x.data() + j), middle);
        const V T = hn::Mul(of(omega), hn::LoadU(Lanes(), rule.data() + j));
        const V at = hn::MulSub(omega, scale, offset), whole = hn::Floor(at);
        const V t = hn::Sub(at, whole);
        hn::StoreU(whole, Lanes(), place + j);
        const V before = hn::Sub(t, one), far = hn::Sub(t, two), after = hn::Add(t, one);
        const V inner = hn::Mul(T, hn::Mul(before, far)), outer = hn::Mul(T, hn::Mul(after, t));
        hn::StoreU(hn::Neg(hn::Mul(sixth, hn::Mul(t, inner))), Lanes(), weight + j);
        hn::StoreU(hn::Mul(third, hn::Mul(after, inner)), Lanes(), weight + stride + j);
        hn::StoreU(hn::Neg(hn::Mul(third, hn::Mul(far, outer))), Lanes(), weight + 2 * stride + j);
        hn::StoreU(hn::Mul(sixth, hn::Mul(before, outer)), Lanes(), weight + 3 * stride + j);
    }
}

/// Sum over nodes and over the four rows around each.
HWY_INLINE Triple sum_of(std::size_t count, std::size_t stride, const BlochMemory& memory,
                         const SmoothSensitivity::Row* rows) {
    const double* place = memory.place.data();
    const double* weight = memory.weight.data();
    const hn::CappedTag<double, 4> four;
    alignas(32) double sums[4] = {};
    for (std::size_t c = 0; c < 4; c += hn::Lanes(four)) {
        auto first = hn::Zero(four), second = first, third = first, fourth = first;
        for (std::size_t j = 0; j < count; ++j) {
            const double* row = rows[static_cast<std::size_t>(place[j]) - 1].value.data() + c;
            const double* w = weight + j;
            first = hn::MulAdd(hn::Set(four, w[0]), hn::LoadU(four, row), first);
            second = hn::MulAdd(hn::Set(four, w[stride]), hn::LoadU(four, row + 4), second);
            third = hn::MulAdd(hn::Set(four, w[2 * stride]), hn::LoadU(four, row + 8), third);
            fourth = hn::MulAdd(hn::Set(four, w[3 * stride]), hn::LoadU(four, row + 12), fourth);
        }
        hn::StoreU(hn::Add(hn::Add(first, second), hn::Add(third, fourth)), four, sums + c);
    }
    return {sums[0], sums[1], sums[2]};
}

}  // namespace

Triple vector_bloch_sum(const BlochMirror& mirror, const BlochRange& range, std::uint64_t terms,
                        const CosineNodes& nodes, const SmoothSensitivity& sensitivity,
                        BlochMemory& memory) {
    const Constants k = constants_of(mirror);
    const std::uint64_t repeat = mirror.repeat;
    const auto& rule = range.is_gap || terms == 0 ? nodes.curtis : nodes.trapezoid;
    const auto fill_with = [&](const auto& of) {
        fill(range, nodes, rule, sensitivity, memory, of);
    };
    if (range.is_gap) {
        fill_with([&](V omega) {
            return gap_transmittance(k, point(k, omega), range.is_odd, static_cast<double>(repeat));
        });
    } else if (terms == 0) {
        fill_with(
            [&](V omega) { return whole_transmittance(k, in_band(point(k, omega)), repeat); });
    } else if (terms == 1) {
        fill_with([&](V omega) { return average_transmittance(k, in_band(point(k, omega))); });
    } else {
        fill_with([&](V omega) {
            return some_transmittance(k, in_band(point(k, omega)), repeat, terms);
        });
    }
    return sum_of(nodes.n + 1, nodes.x.size(), memory, sensitivity.rows().data());
}

}  // namespace irido::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace irido {

namespace {

double plain_transmittance(const BlochMirror& mirror, const BlochRange& range, std::uint64_t terms,
                           double omega) {
    if (range.is_gap || terms == 0) return bloch_transmittance(mirror, omega);
    const BlochSeries series = bloch_series(mirror, omega);
    double sum = 1;
    Complex bounce = 1;
    for (std::uint64_t m = 1; m < terms; ++m) sum += 2 * (bounce *= series.bounce).real();
    return series.average * sum;
}

Triple plain_bloch_sum(const BlochMirror& mirror, const BlochRange& range, std::uint64_t terms,
                       const CosineNodes& nodes, const SmoothSensitivity& sensitivity) {
    const double middle = (range.low + range.high) / 2, half = (range.high - range.low) / 2;
    const auto& rule = range.is_gap || terms == 0 ? nodes.curtis : nodes.trapezoid;
    Triple sum{};
    for (std::size_t j = 0; j <= nodes.n; ++j) {
        const double omega = middle + half * nodes.x[j];
        const double T = plain_transmittance(mirror, range, terms, omega) * rule[j];
        const Triple s = sensitivity.at(omega / (2 * std::numbers::pi));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += T * s[c];
    }
    return sum;
}

}  // namespace

CosineNodes::CosineNodes(std::size_t count) : n(count), x(whole_vectors(n + 1), 0.0) {
    trapezoid = curtis = x;
    std::vector<double> moments(n + 1);  // of T_k over [-1, 1]
    for (std::size_t k = 0; k <= n; ++k) {
        const auto order = static_cast<double>(k);
        const double psi = std::numbers::pi * order / static_cast<double>(n);
        x[k] = std::cos(psi);
        trapezoid[k] = std::numbers::pi / static_cast<double>(n) * std::sin(psi);
        moments[k] = k % 2 == 0 ? 2 / (1 - order * order) : 0;
    }
    trapezoid[n] = 0;
    const ChebyshevTransform transform(n);
    transform(moments, std::span(curtis).first(n + 1));
}

Triple bloch_sum(const BlochMirror& mirror, const BlochRange& range, std::uint64_t terms,
                 const CosineNodes& nodes, const SmoothSensitivity& sensitivity,
                 BlochMemory& memory, SimdLevel level) {
    memory.place.resize(std::max(memory.place.size(), nodes.x.size()));
    memory.weight.resize(std::max(memory.weight.size(), 4 * nodes.x.size()));
    Triple sum = level == SimdLevel::plain
                     ? plain_bloch_sum(mirror, range, terms, nodes, sensitivity)
                     : IRIDO_DISPATCH(level, vector_bloch_sum)(mirror, range, terms, nodes,
                                                               sensitivity, memory);
    const double scale = (range.high - range.low) / (4 * std::numbers::pi);  // d nu / dx
    for (double& channel : sum) channel *= scale;
    return sum;
}

}  // namespace irido

#endif
