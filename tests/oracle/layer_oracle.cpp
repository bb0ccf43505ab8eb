#include "tests/oracle/layer_oracle.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_complex.hpp>

namespace irido::oracle {

namespace {

using Real = boost::multiprecision::cpp_bin_float_100;
using Wide = boost::multiprecision::cpp_complex_100;

struct Fields {
    Wide e, h;
};

Real flux(const Fields& f) {
    return Real(f.e.real() * f.h.real() + f.e.imag() * f.h.imag());
}

void write_out(const std::vector<Element>& elements, std::vector<Layer>& out) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            out.push_back(*layer);
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        for (std::uint64_t i = 0; i < group.repeat; ++i) write_out(group.elements, out);
    }
}

/// Fields at every interface, the lowest first, for an outgoing wave of unit tangential field.
struct Solution {
    std::vector<Layer> layers;
    std::vector<Fields> fields;
    Wide y0;

    Solution(const Stack& stack, const Query& query) {
        write_out(stack.elements, layers);
        const Real pi = boost::math::constants::pi<Real>();
        const Real k0 = 2 * pi / Real(query.wavelength_nm);
        const Real cosine = sin((90 - Real(query.angle_deg)) * pi / 180);
        const Real n0 = index_at(stack.materials[stack.incident], query.wavelength_nm).real();
        const Real s2 = n0 * n0 * (1 - cosine * cosine);
        const auto admittance = [&](const Wide& eps, const Wide& kz) {
            return query.polarization == Polarization::s ? kz : Wide(eps / kz);
        };
        const auto medium_of = [&](std::size_t material, Wide& kz) {
            const irido::Complex n = index_at(stack.materials[material], query.wavelength_nm);
            const Wide index(Real(n.real()), Real(n.imag()));
            const Wide eps = index * index;
            kz = sqrt(Wide(eps - s2));
            if (kz.imag() < 0) kz = -kz;
            return admittance(eps, kz);
        };
        Wide kz;
        y0 = admittance(Wide(n0 * n0), Wide(n0 * cosine));
        fields.push_back({Wide(1), medium_of(stack.substrate, kz)});
        for (std::size_t i = layers.size(); i-- > 0;) {
            const Wide y = medium_of(layers[i].material, kz);
            const auto [e, h] = fields.back();
            const Wide down = (e + h / y) / 2, up = (e - h / y) / 2;
            const Wide turn = exp(Wide(Real(0), Real(1)) * kz * k0 * Real(layers[i].thickness_nm));
            fields.push_back({down / turn + up * turn, y * (down / turn - up * turn)});
        }
    }

    Wide incident() const { return (fields.back().e + fields.back().h / y0) / 2; }
    Wide reflected() const { return (fields.back().e - fields.back().h / y0) / 2; }
};

irido::Complex narrow(const Wide& z) {
    return {static_cast<double>(z.real()), static_cast<double>(z.imag())};
}

}  // namespace

std::vector<double> layer_absorption(const Stack& stack, const Query& query) {
    const Solution solution(stack, query);
    const Wide incident = solution.incident();
    const Real power = Real(norm(incident).real()) * Real(solution.y0.real());
    std::vector<double> absorbed;
    for (std::size_t i = solution.layers.size(); i-- > 0;)
        absorbed.push_back(static_cast<double>(
            Real((flux(solution.fields[i + 1]) - flux(solution.fields[i])) / power)));
    return absorbed;
}

Amplitudes amplitudes(const Stack& stack, const Query& query) {
    const Solution solution(stack, query);
    const Wide incident = solution.incident();
    return {narrow(Wide(solution.reflected() / incident)), narrow(Wide(Real(1) / incident))};
}

}  // namespace irido::oracle
