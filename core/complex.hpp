#pragma once

#include <complex>

namespace irido {

using Complex = std::complex<double>;

}  // namespace irido
