#include "core/color/baselines/adapted_srgb.hpp"

namespace irido {

ColorMatrix xyz_from_srgb(const Triple& white) {
    const RgbSpace& srgb = rgb_space("srgb");
    const ColorMatrix adapted = bradford(srgb.white, white), plain = xyz_from_rgb(srgb);
    ColorMatrix result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) result[i][j] += adapted[i][k] * plain[k][j];
    return result;
}

}  // namespace irido
