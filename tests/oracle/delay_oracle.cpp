#include "tests/oracle/delay_oracle.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "core/truth/textbook.hpp"

namespace irido::oracle {

namespace {

using Real = textbook::Digits<100>;
using Cx = textbook::Cx<Real>;

const Real kPi100 = boost::math::constants::pi<Real>();

Real value_of(const Dispersion& dispersion, const Real& nm) {
    if (const auto* constant = std::get_if<Constant>(&dispersion)) return constant->value;
    const auto& formula = std::get<Formula>(dispersion);
    const Real um = nm / 1000;
    const auto& c = formula.coefficients;
    Real sum = c[0];
    if (formula.number == 2) {
        sum += 1;
        for (std::size_t j = 1; j + 1 < c.size(); j += 2)
            sum += Real(c[j]) * um * um / (um * um - Real(c[j + 1]));
        return sqrt(sum);
    }
    for (std::size_t j = 1; j + 1 < c.size(); j += 2) sum += Real(c[j]) * pow(um, Real(c[j + 1]));
    return sum;
}

Cx index_of(const Material& material, const Real& nm) {
    const auto& index = std::get<RefractiveIndex>(material.model);
    return {value_of(index.n, nm), value_of(index.k, nm)};
}

Cx one() {
    return {Real(1), Real(0)};
}

/// exp(i delta)
Cx wave_of(const Cx& delta) {
    const Real size = exp(-delta.im);
    return {size * cos(delta.re), size * sin(delta.re)};
}

struct Amplitudes {
    Cx r, t;
};

/// Computes r and t by adding one layer at a time on top.
class AiryStack {
public:
    AiryStack(const Stack& stack, double wavelength_nm, double angle_deg, Polarization polarization,
              const Real& shift)
        : polarization_(polarization) {
        const Real nm = Real(wavelength_nm) / (1 + shift);
        k0_ = 2 * kPi100 / nm;
        const Cx n0{index_of(stack.materials[stack.incident], nm).re, Real(0)};
        const Real across = n0.re * sin(Real(angle_deg) * kPi100 / 180);
        for (const Material& material : stack.materials)
            media_.push_back(medium(index_of(material, nm), across));
        below_ = media_[stack.substrate];
        total_ = {{Real(0), Real(0)}, one()};
        add(stack.elements);
        put_face_under(medium(n0, across));
    }

    const Amplitudes& amplitudes() const { return total_; }

private:
    struct Medium {
        Cx kz, y;
    };

    Medium medium(const Cx& n, const Real& across) const {
        const Cx eps = n * n;
        const Cx kz = textbook::outgoing_root(eps - Cx{across * across, Real(0)});
        return {kz, polarization_ == Polarization::s ? kz : eps / kz};
    }

    /// Adds the interface between `above` and the current topmost medium, and everything below it.
    void put_face_under(const Medium& above) {
        const Cx f = (above.y - below_.y) / (above.y + below_.y);
        const Cx bounces = one() + f * total_.r;
        total_ = {(f + total_.r) / bounces, (one() + f) * total_.t / bounces};
        below_ = above;
    }

    void add(const std::vector<Element>& elements) {
        for (std::size_t i = elements.size(); i-- > 0;) {
            if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
                put_face_under(media_[layer->material]);
                const Cx e = wave_of(textbook::scaled(below_.kz, Real(k0_ * layer->thickness_nm)));
                total_ = {total_.r * e * e, total_.t * e};
                continue;
            }
            const Group& group = std::get<Group>(elements[i].value);
            for (std::uint64_t n = 0; n < group.repeat; ++n) add(group.elements);
        }
    }

    Polarization polarization_;
    Real k0_;
    std::vector<Medium> media_;
    Medium below_;
    Amplitudes total_;
};

Real phase_between(const Cx& a, const Cx& from) {
    const Cx ratio = a / from;
    return atan2(ratio.im, ratio.re);
}

Delay differenced(const std::array<Cx, 5>& a, const Real& step, const Real& w0) {
    std::array<Real, 5> phase;
    for (std::size_t i = 0; i < a.size(); ++i) phase[i] = phase_between(a[i], a[2]);
    const Real h = step * w0;
    const Real first = (phase[0] - 8 * phase[1] + 8 * phase[3] - phase[4]) / (12 * h);
    const Real second = (-phase[0] + 16 * phase[1] + 16 * phase[3] - phase[4]) / (12 * h * h);
    const Real third = (-phase[0] + 2 * phase[1] - 2 * phase[3] + phase[4]) / (2 * h * h * h);
    return {static_cast<double>(Real(atan2(a[2].im, a[2].re) * 180 / kPi100)),
            static_cast<double>(first), static_cast<double>(second), static_cast<double>(third)};
}

}  // namespace

Delays differenced_delays(const Stack& stack, double wavelength_nm, double angle_deg,
                          Polarization polarization) {
    const Real step("1e-24"), light("299.792458");
    const Real w0 = 2 * kPi100 * light / Real(wavelength_nm);
    std::array<Cx, 5> r, t;
    for (std::size_t i = 0; i < r.size(); ++i) {
        const AiryStack at(stack, wavelength_nm, angle_deg, polarization,
                           (Real(static_cast<double>(i)) - 2) * step);
        r[i] = at.amplitudes().r;
        t[i] = at.amplitudes().t;
    }
    return {differenced(r, step, w0), differenced(t, step, w0)};
}

Moduli moduli(const Stack& stack, double wavelength_nm, double angle_deg,
              Polarization polarization) {
    const AiryStack at(stack, wavelength_nm, angle_deg, polarization, Real(0));
    const Real r = sqrt(norm(at.amplitudes().r)), t = sqrt(norm(at.amplitudes().t));
    return {static_cast<double>(r), static_cast<double>(t)};
}

}  // namespace irido::oracle
