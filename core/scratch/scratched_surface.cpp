#include "core/scratch/scratched_surface.hpp"

namespace irido {

std::vector<Scratch> scratches_near(const ScratchedSurface& surface, SurfacePoint at,
                                    double radius_um) {
    std::vector<Scratch> found;
    for (const Scratch& scratch : surface.scratches)
        if (distance_um(scratch, at) <= radius_um) found.push_back(scratch);
    for (std::size_t i = 0; i < surface.fields.size(); ++i) {
        const auto drawn = scratches_near(surface.fields[i], surface.seed,
                                          static_cast<std::uint32_t>(i), at, radius_um);
        found.insert(found.end(), drawn.begin(), drawn.end());
    }
    return found;
}

double expected_density(const ScratchField& field) {
    constexpr double kPerMm2 = 1e-6;
    const auto middle = [](const DrawnRange& range) { return (range.low + range.high) / 2; };
    return field.count_per_mm2 * kPerMm2 * middle(field.length_um) * middle(field.width_um);
}

}  // namespace irido
