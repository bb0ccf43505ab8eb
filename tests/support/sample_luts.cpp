#include "tests/support/sample_luts.hpp"

#include <array>
#include <cmath>

#include "tables/lut/lut_values.hpp"

namespace irido::test {

Lut sample_lut(LutType type, std::size_t channels, const std::vector<std::size_t>& counts,
               bool mips) {
    constexpr std::array names{"a", "b_nm", "c"};
    constexpr std::array units{"", "nm", ""};
    Lut lut;
    lut.kind = "sample";
    lut.type = type;
    lut.mips = mips;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        LutAxis axis;
        axis.name = names[i];
        axis.unit = units[i];
        axis.values = equally_spaced(0.1, 0.1 + static_cast<double>(i + 1) / 3, counts[i]);
        lut.axes.push_back(axis);
    }
    for (std::size_t c = 0; c < channels; ++c) lut.channels.push_back("v" + std::to_string(c));
    const std::size_t count = values_of(lut);
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(i);
        const double exponent = type == LutType::f16 ? std::fmod(x, 38) - 23 : 40 * std::sin(x);
        lut.values.push_back(rounded(std::sin(1 + x) * std::exp2(exponent), type));
    }
    lut.values[0] = -0.0;
    if (count > 2) {
        lut.values[1] = 0;
        lut.values[2] = rounded(std::exp2(-24), type);  // the smallest half
    }
    lut.facts["color_space"] = "display-p3";
    lut.facts["error"] = {{"measure", "delta_e_2000"}, {"value", 0.05}};
    lut.facts["notes"] = {"made by a test", "\xC3\xA9 is two bytes"};
    return lut;
}

Files files_of(const Lut& lut, const LutFormat& format, const LutLayout& layout) {
    Files files;
    for (const LutFile& file : format.write(lut, layout))
        (file.suffix.empty() ? files.bytes : files.companion) = file.bytes;
    return files;
}

Files files_of(const Lut& lut, const std::string& format, const LutLayout& layout) {
    return files_of(lut, *find_lut_format(format), layout);
}

}  // namespace irido::test
