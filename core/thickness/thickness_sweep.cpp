#include "core/thickness/thickness_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/imaginary.hpp"

namespace irido {

namespace {

/// Below this |delta|^2 the differences of absorbed() lose digits.
constexpr double kThin = 0.25;

/// Below this |q2| sines over kz do.
constexpr double kNearCritical = 1e-6;

}  // namespace

SweptLayer::SweptLayer(const Medium& medium, double k0, Polarization polarization)
    : medium_(medium),
      k0_(k0),
      polarization_(polarization),
      kz_(square_root(medium.q2)),
      coupling_(coupling(medium, polarization)) {
    if (kz_.imag() < 0) kz_ = -kz_;
}

SweptLayer::State SweptLayer::operator()(double thickness_nm, double phase) const {
    const double k0_d = k0_ * thickness_nm;
    const bool absorbs = is_lossy(medium_);
    const bool thin = absorbs && std::norm(k0_d * kz_) < kThin;
    if (phase == 0 && (thin || std::norm(kz_) < kNearCritical))
        return {layer_turn(medium_.q2, k0_d),
                absorbs ? absorbed_power(medium_, k0_d, polarization_) : AbsorbedPower{}};
    const double a = k0_d * kz_.real() + phase / 2, b = k0_d * kz_.imag();
    const double cos_a = std::cos(a), sin_a = std::sin(a);
    if (b == 0) return {{cos_a, sin_a / kz_, 0}, {}};
    const double exp_less = std::expm1(-2 * b), less = -exp_less / 2, more = 1 - less;
    const Complex sine{sin_a * more, cos_a * less};
    return {{{cos_a * more, -sin_a * less}, sine / kz_, b},
            absorbs ? absorbed(cos_a, sin_a, exp_less) : AbsorbedPower{}};
}

/// The depth integrals of absorbed_power() divided by exp(2b), exp_less = exp(-2b) - 1.
AbsorbedPower SweptLayer::absorbed(double cos_a, double sin_a, double exp_less) const {
    const double kr = kz_.real(), ki = kz_.imag();
    const double hyperbolic = -exp_less * (2 + exp_less) / (8 * ki);
    const double circular = sin_a * cos_a * (1 + exp_less) / (2 * kr);
    const double cc = hyperbolic + circular, ss = (hyperbolic - circular) / std::norm(kz_);
    const Complex squares{sin_a * sin_a * (1 + exp_less) / (2 * kr),
                          -exp_less * exp_less / (8 * ki)};
    const Complex cs = squares / std::conj(kz_);
    const auto [w, v] = coupling_;
    const double loss = medium_.eps.imag();
    AbsorbedPower q{loss * cc, loss * std::norm(w) * ss, loss * (-kI * w) * std::conj(cs)};
    if (polarization_ == Polarization::p) {
        q.bb += w.imag() * std::norm(v) * ss;
        q.cc += w.imag() * cc;
        q.bc += w.imag() * std::conj(-kI * v) * cs;
    }
    return q;
}

ThicknessSweep::ThicknessSweep(const Wave& in, const Slab& above, const Medium& layer,
                               const Slab& below, const Wave& out, double k0,
                               Polarization polarization)
    : in_(in),
      above_(above),
      layer_(layer, k0, polarization),
      layer_absorbs_(is_lossy(layer)),
      absorbs_(above.absorbs || below.absorbs || layer_absorbs_),
      k0_(k0),
      unit_(4 * std::norm(in.b) * std::norm(in.c) / in.flux),
      below_log_scale_(below.matrix.log_scale),
      out_flux_(out.flux),
      below_absorbed_(below.absorbed),
      below_flux_(below.absorbs ? absorbed_flux(below.absorbed, out.b, out.c) : 0) {
    const Matrix& m = below.matrix;
    const Complex b = m.identity() * out.b + (m.a * out.b + m.b * out.c);
    const Complex c = m.identity() * out.c + (m.c * out.b + m.d * out.c);
    const auto [w, v] = coupling(layer, polarization);
    cos_ = column(b, c);
    sd_ = column(-kI * w * c, -kI * v * b);
}

ThicknessSweep::Column ThicknessSweep::column(Complex b, Complex c) const {
    const Matrix& m = above_.matrix;
    const Complex top_b = m.identity() * b + (m.a * b + m.b * c);
    const Complex top_c = m.identity() * c + (m.c * b + m.d * c);
    return {b, c, in_.c * top_b + in_.b * top_c, in_.c * top_b - in_.b * top_c};
}

double ThicknessSweep::absorbed(const SweptLayer::State& at, double unit) const {
    const auto& [turn, layer] = at;
    const double above_log_scale = above_.matrix.log_scale;
    double power = 0;
    if (below_flux_ != 0)
        power += times_exp(unit * below_flux_,
                           2 * (below_absorbed_.log_scale - above_log_scale - turn.log_scale));
    if (layer_absorbs_)
        power += times_exp(unit * absorbed_flux(layer, cos_.b, cos_.c), -2 * above_log_scale);
    if (above_.absorbs)
        power +=
            times_exp(unit * absorbed_flux(above_.absorbed, turn.cos * cos_.b + turn.sd * sd_.b,
                                           turn.cos * cos_.c + turn.sd * sd_.c),
                      2 * above_.absorbed.log_scale);
    return power;
}

Response ThicknessSweep::operator()(double thickness_nm, double phase) const {
    const SweptLayer::State at = layer_(thickness_nm, phase);
    const LayerTurn& turn = at.turn;
    const Complex sum = turn.cos * cos_.sum + turn.sd * sd_.sum;
    const Complex difference = turn.cos * cos_.difference + turn.sd * sd_.difference;
    const Complex divisor = divisor_of(sum, difference);
    const double log_scale = above_.matrix.log_scale + turn.log_scale + below_log_scale_;
    const double unit = unit_ / std::norm(divisor);
    Response response{{}, difference / divisor, 0, divisor, log_scale};
    const Power power{std::norm(difference) / std::norm(divisor),
                      times_exp(unit * out_flux_, -2 * log_scale),
                      absorbs_ ? absorbed(at, unit) : 0};
    response.power =
        balanced(power, mixed_power(in_, response.r), {absorbs_, divisor != sum, out_flux_});
    return response;
}

/// With E the round trip, cos = (1 + E) / (2 sqrt(E)) and sd = i (1 - E) / (2 kz sqrt(E)), where
/// |sqrt(E)| is the layer's log_scale.
Fringes ThicknessSweep::fringes() const {
    const Complex kz = layer_.kz();
    const auto parts = [&](Complex cos, Complex sd) {
        const Complex sine = kI * sd / kz;
        return std::pair{(cos + sine) / 2.0, (cos - sine) / 2.0};
    };
    const auto [once, again] = parts(cos_.sum, sd_.sum);
    const auto [near, far] = parts(cos_.difference, sd_.difference);
    const double log_scale = above_.matrix.log_scale + below_log_scale_;
    return {near / once, far / once, again / once,
            times_exp(unit_ / std::norm(once) * out_flux_, -2 * log_scale), 2 * k0_ * kz};
}

}  // namespace irido
