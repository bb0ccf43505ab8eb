#include "core/coherent/fresnel.hpp"

#include <cmath>

namespace irido {

double normal_reflectance(double n1, double n2) {
    return std::pow((n1 - n2) / (n1 + n2), 2);
}

double schlick(double R0, double cos_theta) {
    return R0 + (1 - R0) * std::pow(1 - cos_theta, 5);
}

Complex face_amplitude(const Medium& above, const Medium& below, Polarization polarization) {
    const Complex q1 = std::sqrt(above.q2), q2 = std::sqrt(below.q2);
    const bool is_s = polarization == Polarization::s;
    const Complex a = is_s ? q1 : above.eps * q2, b = is_s ? q2 : below.eps * q1;
    return a + b == Complex(0) ? 0 : (a - b) / (a + b);
}

Ray<double> real_ray(double index, const Medium& medium) {
    return {index * index, std::sqrt(medium.q2.real())};
}

Ray<Complex> outgoing_ray(const Medium& medium) {
    const Complex kz = square_root(medium.q2);
    return {medium.eps, kz.imag() < 0 ? -kz : kz};
}

}  // namespace irido
