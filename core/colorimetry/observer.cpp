#include "core/colorimetry/observer.hpp"

#include <array>
#include <string>

#include "core/error.hpp"

namespace irido {
namespace {

#include "core/colorimetry/data/cie1931.inc"
#include "core/colorimetry/data/cie1964.inc"

static_assert(kCie1931X.size() == kObserverRows && kCie1964X.size() == kObserverRows);

constexpr Observer kCie1931{"CIE 1931", kCie1931X, kCie1931Y, kCie1931Z};
constexpr Observer kCie1964{"CIE 1964", kCie1964X, kCie1964Y, kCie1964Z};

}  // namespace

const Observer& observer(int degrees) {
    if (degrees == 2) return kCie1931;
    if (degrees == 10) return kCie1964;
    throw DomainError("observer must be 2 or 10 (degrees; got " + std::to_string(degrees) + ")");
}

}  // namespace irido
