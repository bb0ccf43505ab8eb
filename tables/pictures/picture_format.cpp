#include "tables/pictures/picture_format.hpp"

#include <algorithm>
#include <array>

#define IRIDO_DECLARE(name) extern const PictureFormat name;
namespace irido::tables {
#include "picture_formats.inc"

namespace {

constexpr std::array kPictureFormats{IRIDO_ALL};
#undef IRIDO_DECLARE
#undef IRIDO_ALL

}  // namespace

std::span<const PictureFormat* const> picture_formats() {
    return kPictureFormats;
}

const PictureFormat* find_picture_format(std::string_view name) {
    const auto* found = std::ranges::find(kPictureFormats, name, &PictureFormat::name);
    return found == kPictureFormats.end() ? nullptr : *found;
}

}  // namespace irido::tables
