#pragma once

namespace irido {

constexpr double square(double x) {
    return x * x;
}

}  // namespace irido
