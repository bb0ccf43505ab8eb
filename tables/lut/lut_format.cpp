#include "tables/lut/lut_format.hpp"

#include <algorithm>
#include <array>

#define IRIDO_DECLARE(name) extern const LutFormat name;
namespace irido::tables {
#include "lut_formats.inc"

namespace {

constexpr std::array kFormats{IRIDO_ALL};
#undef IRIDO_DECLARE
#undef IRIDO_ALL

}  // namespace

std::span<const LutFormat* const> lut_formats() {
    return kFormats;
}

const LutFormat* find_lut_format(std::string_view name) {
    const auto* found = std::ranges::find(kFormats, name, &LutFormat::name);
    return found == kFormats.end() ? nullptr : *found;
}

}  // namespace irido::tables
