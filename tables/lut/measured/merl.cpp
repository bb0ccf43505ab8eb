#include "tables/lut/measured/merl.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/math/parallel.hpp"

namespace irido::tables {

namespace {

constexpr std::size_t kHalf = 90, kDifference = 90, kAzimuth = 180;
constexpr std::array kMerlScale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

template <class Number>
void append_bytes(std::string& out, Number value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    out.append(bytes.data(), bytes.size());
}

}  // namespace

std::string merl_file(const std::function<Triple(const TablePair&)>& rgb, unsigned threads,
                      MerlReport& report) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::size_t cells = kHalf * kDifference * kAzimuth;
    std::vector<double> values(3 * cells);
    std::vector<MerlReport> counts(kHalf);
    parallel_for(kHalf, threads, [&](std::size_t h) {
        const auto theta_h = [&](double part) {
            const double root = static_cast<double>(h) + part;
            return root * root / 90;
        };
        for (std::size_t d = 0; d < kDifference; ++d)
            for (std::size_t p = 0; p < kAzimuth; ++p) {
                const std::size_t cell = (h * kDifference + d) * kAzimuth + p;
                const auto at = [&](double part_h, double part_d, double part_p) {
                    return directions_of({theta_h(part_h), static_cast<double>(d) + part_d,
                                          static_cast<double>(p) + part_p});
                };
                HalfAnglePair one = at(0.5, 0.5, 0.5);
                // a cell whose centre is below may have corners above
                for (std::size_t corner = 0; corner < 8 && !one.is_above; ++corner)
                    one = at(corner & 1 ? 0.98 : 0.02, corner & 2 ? 0.98 : 0.02,
                             corner & 4 ? 0.98 : 0.02);
                ++counts[h].cells;
                if (!one.is_above) {
                    ++counts[h].below;
                    for (std::size_t c = 0; c < 3; ++c) values[c * cells + cell] = -1;
                    continue;
                }
                const Triple color = rgb(one.pair);
                bool is_clamped = false;
                for (std::size_t c = 0; c < 3; ++c) {
                    is_clamped = is_clamped || color[c] < 0;
                    values[c * cells + cell] = std::max(0.0, color[c]) / kMerlScale[c];
                }
                if (is_clamped) ++counts[h].clamped;
            }
    });
    for (const MerlReport& count : counts) {
        report.cells += count.cells;
        report.below += count.below;
        report.clamped += count.clamped;
    }
    std::string bytes;
    bytes.reserve(12 + 8 * values.size());
    for (const std::size_t count : {kHalf, kDifference, kAzimuth})
        append_bytes(bytes, static_cast<std::int32_t>(count));
    for (const double value : values) append_bytes(bytes, value);
    return bytes;
}

}  // namespace irido::tables
