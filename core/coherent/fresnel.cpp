#include "core/coherent/fresnel.hpp"

#include <cmath>

namespace irido {

double normal_reflectance(double n1, double n2) {
    return std::pow((n1 - n2) / (n1 + n2), 2);
}

double schlick(double R0, double cos_theta) {
    return R0 + (1 - R0) * std::pow(1 - cos_theta, 5);
}

}  // namespace irido
