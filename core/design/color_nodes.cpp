#include "core/design/color_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/color/held_stack.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/observer.hpp"

namespace irido {

namespace {

struct Level {
    bool with_rows;
    std::size_t parts, degree;  ///< per smooth piece
};
constexpr std::array<Level, kColorLevels> kLevels{{{false, 1, 32},
                                                   {false, 1, 64},
                                                   {false, 1, 128},
                                                   {false, 2, 128},
                                                   {true, 1, 16},
                                                   {true, 2, 16},
                                                   {true, 4, 32},
                                                   {true, 8, 64},
                                                   {true, 16, 128}}};

void append(const QuadratureRule& rule, QuadratureNodes& nodes) {
    for (std::size_t j = 0; j < rule.points; ++j) {
        nodes.wavelength_nm.push_back(rule.wavelength_nm[j]);
        for (std::size_t c = 0; c < 3; ++c)
            nodes.weight[c].push_back(rule.weights[c * rule.stride + j]);
    }
}

Triple numbers_of(const Triple& lab, const Triple& target) {
    const DifferenceParts parts = ciede2000_parts(target, lab);
    const double r = parts.rotation;
    return {parts.lightness, parts.chroma + r * parts.hue / 2,
            parts.hue * std::sqrt(std::max(0.0, 1 - r * r / 4))};
}

}  // namespace

QuadratureNodes color_nodes(const Stack& stack, const ColorTables& tables, std::size_t level) {
    const auto [with_rows, base_parts, base_degree] = kLevels.at(level);
    const std::vector<double> ends =
        smooth_pieces(stack, tables.sensitivity().support(), with_rows);
    // without kinks, the levels with table rows use a single piece with as many points
    std::size_t parts = base_parts, degree = base_degree;
    if (with_rows && ends.size() < 9) {
        degree = 128;
        parts = std::size_t{4} << (level - 4);
    }
    QuadratureNodes nodes;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        for (std::size_t p = 0; p < parts; ++p) {
            const double a = 1 / ends[i], b = 1 / ends[i + 1], n = static_cast<double>(parts);
            const auto at = [&](std::size_t k) {
                if (k == 0) return ends[i];
                if (k == parts) return ends[i + 1];
                return 1 / (a + (b - a) * static_cast<double>(k) / n);
            };
            append(*tables.rule({at(p), at(p + 1)}, degree), nodes);
        }
    return nodes;
}

std::shared_ptr<const ColorTables> color_tables_of(int observer_deg, const Table& illuminant) {
    constexpr std::size_t kMost = 8;
    struct Known {
        int observer_deg;
        Table illuminant;
        std::shared_ptr<const ColorTables> tables;
    };
    static std::mutex lock;
    static std::vector<Known> all;
    const std::scoped_lock hold(lock);
    for (const Known& known : all)
        if (known.observer_deg == observer_deg && known.illuminant == illuminant)
            return known.tables;
    if (all.size() == kMost) all.erase(all.begin());
    all.push_back(
        {observer_deg, illuminant,
         std::make_shared<const ColorTables>(Sensitivity(observer(observer_deg), illuminant))});
    return all.back().tables;
}

LabSlopes lab_slopes(const Triple& xyz, const Triple& white) {
    const double x = lab_slope(xyz[0] / white[0]) / white[0];
    const double y = lab_slope(xyz[1] / white[1]) / white[1];
    const double z = lab_slope(xyz[2] / white[2]) / white[2];
    return {lab(xyz, white), {{{0, 116 * y, 0}, {500 * x, -500 * y, 0}, {0, 200 * y, -200 * z}}}};
}

DifferenceSlopes difference_slopes(const Triple& lab, const Triple& target, bool ciede2000) {
    DifferenceSlopes result{};
    if (!ciede2000) {
        for (std::size_t c = 0; c < 3; ++c) {
            result.number[c] = lab[c] - target[c];
            result.by_lab[c][c] = 1;
        }
        return result;
    }
    result.number = numbers_of(lab, target);
    constexpr double kStep = 1e-4;
    for (std::size_t c = 0; c < 3; ++c) {
        Triple more = lab, less = lab;
        more[c] += kStep;
        less[c] -= kStep;
        const Triple above = numbers_of(more, target), below = numbers_of(less, target);
        for (std::size_t k = 0; k < 3; ++k)
            result.by_lab[k][c] = (above[k] - below[k]) / (2 * kStep);
    }
    return result;
}

}  // namespace irido
