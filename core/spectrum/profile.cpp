#include "core/spectrum/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/incoherent/chain.hpp"
#include "core/math/constants.hpp"

namespace irido {

FieldProfile::FieldProfile(const Stack& stack, std::span<const Medium> media, double k0,
                           IncidentAngle at, Polarization polarization)
    : incident_(media.back()),
      substrate_(media[stack.substrate]),
      out_(outgoing_wave(substrate_, polarization)),
      k0_(k0),
      across2_(incident_.eps.real() * at.sin * at.sin),
      polarization_(polarization) {
    const Wave in = outgoing_wave(incident_, polarization);
    if (in.flux == 0) throw DomainError("no light arrives at an angle of 90 degrees");
    const std::size_t count = count_layers(stack.elements);
    if (count > kMostLayers)
        throw DomainError("a profile needs at most " + std::to_string(kMostLayers) +
                          " layers, repetitions included (got " + std::to_string(count) + ")");
    const std::vector<Layer> layers = written_out(stack.elements);
    listed_ = listed_layers(stack.elements);
    long double depth = 0;  // so that sums of decimals are the double next to them
    faces_nm_.push_back(0);
    for (const Layer& layer : layers) {
        layers_.push_back(media[layer.material]);
        depth += layer.thickness_nm;
        faces_nm_.push_back(static_cast<double>(depth));
    }
    at_faces_.resize(count + 1);
    at_faces_[count] = {out_.b, out_.c, 0, out_.flux};
    for (std::size_t i = count; i-- > 0;)
        at_faces_[i] = above(at_faces_[i + 1], layers_[i], layers[i].thickness_nm);
    const Fields& top = at_faces_[0];
    const Complex incident = (top.b / in.b + top.c / in.c) / 2.0;  // amplitude of the wave `in`
    const double along = polarization == Polarization::s ? 1 : at.cos;
    amplitude2_ = along * along / std::norm(incident * in.b);
    power_ = 1 / (std::norm(incident) * in.flux);
    log_scale_ = top.log_scale;
}

FieldProfile::Fields FieldProfile::above(const Fields& below, const Medium& m,
                                         double depth_nm) const {
    const Slab slab = layer_slab(m, k0_ * depth_nm, polarization_);
    const Matrix& x = slab.matrix;
    const double identity = x.identity();
    Fields up{identity * below.b + (x.a * below.b + x.b * below.c),
              identity * below.c + (x.c * below.b + x.d * below.c), below.log_scale + x.log_scale,
              times_exp(below.flux, -2 * x.log_scale)};
    if (slab.absorbs)
        up.flux +=
            absorbed_flux(slab.absorbed, below.b, below.c) * std::exp(2 * slab.absorbed.log_scale);
    const double size = std::max(std::abs(up.b), std::abs(up.c));
    constexpr double kLarge = 1e60;
    if (size > kLarge || (size < 1 / kLarge && size > 0)) {
        const int exponent = std::ilogb(size);
        const double factor = std::ldexp(1.0, -exponent);
        up = {up.b * factor, up.c * factor, up.log_scale + exponent * std::log(2.0),
              up.flux * factor * factor};
    }
    return up;
}

std::size_t FieldProfile::listed(std::size_t number) const {
    if (number == 0) return 0;
    return number > layers_.size() ? layers() + 1 : listed_[number - 1] + 1;
}

const Medium& FieldProfile::medium(std::size_t number) const {
    if (number == 0) return incident_;
    return number > layers_.size() ? substrate_ : layers_[number - 1];
}

FieldPoint FieldProfile::point(std::size_t number, const Fields& at) const {
    const Medium& m = medium(number);
    const double exponent = 2 * (at.log_scale - log_scale_);
    const auto scaled = [&](double x) { return times_exp(x * amplitude2_, exponent); };
    FieldPoint result;
    result.medium = listed(number);
    if (polarization_ == Polarization::s) {
        result.Ey2 = scaled(std::norm(at.b));
    } else {
        result.Ex2 = scaled(std::norm(at.b));
        result.Ez2 = scaled(across2_ * std::norm(at.c / m.eps_z));
    }
    result.flux = times_exp(at.flux * power_, exponent);
    // k0 Im(eps) |E|^2 of the fields, whose power is that of flux
    result.absorbed_per_nm =
        k0_ * (m.eps.imag() * (result.Ex2 + result.Ey2) + m.eps_z.imag() * result.Ez2) * power_ /
        amplitude2_;
    return result;
}

FieldPoint FieldProfile::at(double z_nm) const {
    if (z_nm < 0) return point(0, above(at_faces_[0], incident_, -z_nm));
    const auto below = std::upper_bound(faces_nm_.begin(), faces_nm_.end(), z_nm);
    const auto number = static_cast<std::size_t>(below - faces_nm_.begin());
    if (below != faces_nm_.end())
        return point(number, above(at_faces_[number], medium(number), *below - z_nm));
    Complex kz = square_root(substrate_.q2);
    if (kz.imag() < 0) kz = -kz;
    Fields fields = at_faces_.back();
    fields.log_scale -= k0_ * (z_nm - faces_nm_.back()) * kz.imag();
    return point(number, fields);
}

/// |E|^2 in a layer at a height above its lower face, or at the top of the substrate.
double FieldProfile::intensity_in(std::size_t number, double up_nm) const {
    const bool is_last = number > layers_.size();
    return point(number, above(at_faces_[is_last ? number - 1 : number], medium(number), up_nm))
        .intensity();
}

double FieldProfile::absorbed_in(std::size_t number) const {
    const Medium& m = medium(number);
    if (!is_lossy(m)) return 0;
    if (number > layers_.size()) return at(faces_nm_.back()).flux;
    const Fields& bottom = at_faces_[number];
    const double k0_d = k0_ * (faces_nm_[number] - faces_nm_[number - 1]);
    const Slab slab = layer_slab(m, k0_d, polarization_);
    const double inside = absorbed_flux(slab.absorbed, bottom.b, bottom.c) * power_;
    return times_exp(inside, 2 * (slab.absorbed.log_scale + slab.matrix.log_scale +
                                  bottom.log_scale - log_scale_));
}

LayerProfile FieldProfile::layer(std::size_t number, const FieldProfile* other) const {
    if (number > layers()) return part(layers_.size() + 1, other);
    const auto [first, last] = std::equal_range(listed_.begin(), listed_.end(), number - 1);
    const auto begin = static_cast<std::size_t>(first - listed_.begin()) + 1;
    const auto end = static_cast<std::size_t>(last - listed_.begin()) + 1;
    LayerProfile whole = part(begin, other);
    for (std::size_t i = begin + 1; i < end; ++i) {
        const LayerProfile next = part(i, other);
        whole.absorbed += next.absorbed;
        whole.penetration_nm.reset();  // a wave has another one at every depth
        if (next.largest_E2 <= whole.largest_E2) continue;
        whole.largest_E2 = next.largest_E2;
        whole.largest_at_nm = next.largest_at_nm;
    }
    return whole;
}

LayerProfile FieldProfile::part(std::size_t number, const FieldProfile* other) const {
    const auto mean = [&](double own, const auto& of_other) {
        return other ? (own + of_other(*other)) / 2 : own;
    };
    const auto field = [&](double up_nm) {
        return mean(intensity_in(number, up_nm),
                    [&](const FieldProfile& p) { return p.intensity_in(number, up_nm); });
    };
    const Complex q = square_root(medium(number).q2);
    LayerProfile result;
    result.absorbed =
        mean(absorbed_in(number), [&](const FieldProfile& p) { return p.absorbed_in(number); });
    if (q.imag() != 0) result.penetration_nm = 1 / (2 * k0_ * std::abs(q.imag()));
    const double begin = faces_nm_[number - 1];
    const double thickness = number > layers_.size() ? 0 : faces_nm_[number] - begin;
    const auto take = [&](double up_nm) {
        const double value = field(up_nm);
        if (value <= result.largest_E2) return;
        result.largest_E2 = value;
        result.largest_at_nm = begin + (thickness - up_nm);
    };
    result.largest_E2 = field(thickness);  // 0 where no light arrives
    result.largest_at_nm = begin;
    if (thickness == 0) return result;
    // maxima stand half a wavelength of the layer apart
    constexpr double kSteps = 12, kMostSteps = 1e5;
    const double turns = thickness * k0_ * std::abs(q.real()) / kPi;
    const double steps = std::clamp(std::ceil(kSteps * turns), kSteps, kMostSteps);
    const double step = thickness / steps;
    for (double i = 0; i < steps; ++i) take(i * step);
    const double best = begin + thickness - result.largest_at_nm;
    double low = std::max(0.0, best - step), high = std::min(thickness, best + step);
    constexpr double kShare = 0.3819660112501051;  // golden section
    constexpr int kSections = 60;
    for (int i = 0; i < kSections; ++i) {
        const double a = low + kShare * (high - low), b = high - kShare * (high - low);
        const bool rises = field(a) < field(b);
        (rises ? low : high) = rises ? a : b;
    }
    take((low + high) / 2);
    return result;
}

}  // namespace irido
