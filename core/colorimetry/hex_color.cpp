#include "core/colorimetry/hex_color.hpp"

#include <charconv>
#include <cmath>

#include "core/error.hpp"

namespace irido {

namespace {

double decoded_srgb(double level) {
    return level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
}

Triple times(const ColorMatrix& matrix, const Triple& vector) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result[i] += matrix[i][j] * vector[j];
    return result;
}

}  // namespace

Triple xyz_of_hex(std::string_view text, const Triple& white) {
    Triple rgb{};
    bool is_hex = text.size() == 7 && text[0] == '#';
    for (std::size_t c = 0; is_hex && c < 3; ++c) {
        const char* const first = text.data() + 1 + 2 * c;
        unsigned level = 0;
        const auto [end, error] = std::from_chars(first, first + 2, level, 16);
        is_hex = error == std::errc() && end == first + 2;
        rgb[c] = decoded_srgb(level / 255.0);
    }
    if (!is_hex) throw DomainError("a colour must be #rrggbb (got " + std::string(text) + ")");
    const RgbSpace& srgb = rgb_space("srgb");
    return times(bradford(srgb.white, white), times(xyz_from_rgb(srgb), rgb));
}

}  // namespace irido
