#include "core/color/quadrature/fixed_layers_cache.hpp"

namespace irido {

std::shared_ptr<FixedLayersCache::Angle> FixedLayersCache::at(IncidentAngle incidence) {
    const std::scoped_lock guard(lock_);
    std::shared_ptr<Angle>& angle = angles_[{incidence.cos, incidence.sin}];
    if (!angle) angle = std::make_shared<Angle>();
    angle->last_use = ++uses_;
    return angle;
}

void FixedLayersCache::find(const Angle& angle, std::span<const SpectralPoints* const> points,
                            std::vector<const FixedLayers*>& found) {
    found.clear();
    const std::scoped_lock guard(lock_);
    for (const SpectralPoints* some : points)
        found.push_back(some->id < angle.layers.size() ? angle.layers[some->id].get() : nullptr);
}

const FixedLayers* FixedLayersCache::add(Angle& angle, const SpectralPoints& points,
                                         const FixedLayers& layers) {
    auto copy = std::make_unique<const FixedLayers>(layers);
    const std::size_t more = copy->numbers.size();
    const std::scoped_lock guard(lock_);
    if (!angle.is_kept) return nullptr;  // made room while in use: it would not be counted
    if (points.id >= angle.layers.size()) angle.layers.resize(points.id + 1);
    std::unique_ptr<const FixedLayers>& place = angle.layers[points.id];
    if (place) return place.get();
    make_room(angle, more);
    if (numbers_ + more > most_numbers_) return nullptr;
    angle.numbers += more;
    numbers_ += more;
    place = std::move(copy);
    return place.get();
}

void FixedLayersCache::make_room(const Angle& angle, std::size_t more) {
    while (numbers_ + more > most_numbers_ && angles_.size() > 1) {
        auto oldest = angles_.end();
        for (auto entry = angles_.begin(); entry != angles_.end(); ++entry)
            if (entry->second.get() != &angle &&
                (oldest == angles_.end() || entry->second->last_use < oldest->second->last_use))
                oldest = entry;
        oldest->second->is_kept = false;
        numbers_ -= oldest->second->numbers;
        angles_.erase(oldest);
    }
}

}  // namespace irido
