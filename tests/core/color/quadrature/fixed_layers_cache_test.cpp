#include "core/color/quadrature/fixed_layers_cache.hpp"

#include <catch2/catch.hpp>

using namespace irido;

namespace {

SpectralPoints points_of(std::size_t id) {
    SpectralPoints points{{500}, nullptr};
    points.id = id;
    return points;
}

FixedLayers layers_of(std::size_t numbers, double value) {
    return {1, std::vector<double>(numbers, value)};
}

}  // namespace

TEST_CASE("stored layers are found again until others need the room") {
    FixedLayersCache cache(100);
    const SpectralPoints first = points_of(0), second = points_of(5);
    const std::vector<const SpectralPoints*> both{&first, &second};
    std::vector<const FixedLayers*> found;

    const auto one = cache.at(0.5);
    cache.find(*one, both, found);
    CHECK(found == std::vector<const FixedLayers*>{nullptr, nullptr});
    const FixedLayers* kept = cache.add(*one, second, layers_of(60, 1));
    REQUIRE(kept);
    CHECK(kept->numbers == std::vector<double>(60, 1));
    // existing entries stay
    CHECK(cache.add(*one, second, layers_of(60, 2)) == kept);
    // an angle is not evicted to make room for itself
    CHECK(cache.add(*one, first, layers_of(41, 3)) == nullptr);
    CHECK(cache.add(*one, first, layers_of(10, 3)) != nullptr);
    cache.find(*cache.at(0.5), both, found);
    CHECK(found[1] == kept);
    CHECK(found[0]->numbers.size() == 10);

    // 70 are taken: the least recently used angle goes
    const auto two = cache.at(0.6);
    CHECK(cache.add(*two, first, layers_of(30, 4)) != nullptr);
    cache.at(0.5);
    const auto three = cache.at(0.7);
    CHECK(cache.add(*three, first, layers_of(30, 5)) != nullptr);
    CHECK_FALSE(two->is_kept);
    CHECK(one->is_kept);
    CHECK(cache.add(*two, second, layers_of(1, 6)) == nullptr);
    cache.find(*cache.at(0.6), both, found);
    CHECK(found[0] == nullptr);

    // entries in use stay
    CHECK(cache.add(*three, second, layers_of(70, 7)) != nullptr);
    CHECK_FALSE(one->is_kept);
    CHECK(kept->numbers == std::vector<double>(60, 1));
    CHECK(cache.add(*three, points_of(9), layers_of(1, 8)) == nullptr);
}
