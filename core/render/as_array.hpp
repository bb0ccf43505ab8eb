#pragma once

#include <Eigen/Core>
#include <span>

namespace irido {

/// A spectrum or a colour as an array to compute with. For sources only, as it reads Eigen.
inline Eigen::Map<Eigen::ArrayXf> as_array(std::span<float> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}
inline Eigen::Map<const Eigen::ArrayXf> as_array(std::span<const float> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace irido
