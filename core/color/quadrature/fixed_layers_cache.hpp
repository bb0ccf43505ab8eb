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

/// FixedLayers at the angles requested most recently, as many as fit. Thread-safe.
class FixedLayersCache {
public:
    /// Entries for one angle; they stay valid as long as this is held.
    struct Angle {
        std::vector<std::unique_ptr<const FixedLayers>> layers;  ///< by SpectralPoints::id
        std::size_t numbers = 0;
        std::uint64_t last_use = 0;
        bool is_kept = true;
    };

    explicit FixedLayersCache(std::size_t most_numbers) : most_numbers_(most_numbers) {}

    std::shared_ptr<Angle> at(IncidentAngle incidence);

    /// Finds the layers for each of the points; nullptr for those not cached.
    void find(const Angle& angle, std::span<const SpectralPoints* const> points,
              std::vector<const FixedLayers*>& found);

    /// Stores a copy, evicting other angles to make room; nullptr if it still does not fit.
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
