#include <array>

#include "core/engines/engine.hpp"

namespace irido {

std::span<const Engine* const> engines() {
    static constexpr std::array kAll{&kGltfEngine,    &kThreeEngine,     &kBabylonEngine,
                                     &kUnityEngine,   &kMaterialXEngine, &kMaterialXGltfEngine,
                                     &kOpenPbrEngine, &kCyclesEngine,    &kCyclesPrincipledEngine};
    return kAll;
}

}  // namespace irido
