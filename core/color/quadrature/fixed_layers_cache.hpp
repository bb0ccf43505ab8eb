#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/color/quadrature/integration.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

/// FixedLayers at the angles that were asked for last, as many as have room. Safe from many
/// threads.
class FixedLayersCache {
public:
    /// At one angle; what is in it stays as long as it is held.
    struct Angle {
        std::vector<std::unique_ptr<const FixedLayers>> layers;  ///< by SpectralPoints::id
        std::size_t numbers = 0;
        std::uint64_t last_use = 0;
        bool is_kept = true;
    };

    explicit FixedLayersCache(std::size_t most_numbers) : most_numbers_(most_numbers) {}

    std::shared_ptr<Angle> at(IncidentAngle incidence);

    /// One for each of the points, nullptr if it is not there.
    void find(const Angle& angle, std::span<const SpectralPoints* const> points,
              std::vector<const FixedLayers*>& found);

    /// Keeps a copy, for which other angles make room; nullptr if that is not enough.
    const FixedLayers* add(Angle& angle, const SpectralPoints& points, const FixedLayers& layers);

private:
    void make_room(const Angle& angle, std::size_t more);

    const std::size_t most_numbers_;
    std::mutex lock_;
    std::map<std::pair<double, double>, std::shared_ptr<Angle>> angles_;  ///< by cosine and sine
    std::size_t numbers_ = 0;                                             ///< of these
    std::uint64_t uses_ = 0;
};

}  // namespace irido
