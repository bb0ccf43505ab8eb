#include "core/render/spectral_table.hpp"

#include <algorithm>

#include "core/render/as_array.hpp"
#include "core/render/reflected_colors.hpp"
#include "core/render/stack_spectra.hpp"

namespace irido {

GridTable::Distance spectral_distance(const PictureNodes& nodes) {
    return [&nodes](std::span<const float> a, std::span<const float> b) {
        return srgb_difference(nodes.rgb(a), nodes.rgb(b));
    };
}

void add_table(const GridTable& table, ColorReport& report) {
    report.cosines = std::max(report.cosines, table.cosines());
    report.thicknesses = std::max(report.thicknesses, table.thicknesses());
    report.evaluations += table.evaluations();
    report.error = std::max(report.error, table.error());
}

GridTable::Function mean_reflectance(const StackSpectra& spectra) {
    return [&spectra](double nm, std::span<const double> cosines, std::span<float> values) {
        const std::size_t count = spectra.count();
        StackSpectra::Memory memory;
        std::vector<float> powers(4 * count);
        for (std::size_t i = 0; i < cosines.size(); ++i) {
            spectra({cosines[i], nm}, powers, memory);
            as_array(values.subspan(i * count, count)) =
                0.5F * (as_array(std::span(powers).first(count)) +
                        as_array(std::span(powers).subspan(count, count)));
        }
    };
}

}  // namespace irido
