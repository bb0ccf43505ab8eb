#include "tables/lut/light_facts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace irido::tables {

nlohmann::json light_facts(const LutRequest& request) {
    const Triple& white = request.sensitivity->white();
    return {{"color_space", "xyz"},
            {"request",
             {{"illuminant", request.illuminant},
              {"observer_deg", request.observer},
              {"white_xyz", {white[0], white[1], white[2]}}}}};
}

LutMeasure absolute_measure(std::size_t channels) {
    return {"absolute, white Y = 1",
            [channels](const std::vector<LutAxis>&, std::span<const double> exact,
                       std::span<const double> approximate) {
                std::vector<double> result(exact.size() / channels);
                for (std::size_t i = 0; i < exact.size(); ++i)
                    result[i / channels] =
                        std::max(result[i / channels], std::abs(exact[i] - approximate[i]));
                return result;
            }};
}

}  // namespace irido::tables
