#include "schemas/documents/light_document.hpp"

#include <nlohmann/json.hpp>

#include "schemas/documents/listed_lights.hpp"

namespace irido::schemas {

namespace {

AreaLight light_from(const nlohmann::json& document) {
    using Place = std::array<double, 3>;
    if (document.contains("vertices_mm"))
        return PolygonLight{document["vertices_mm"].get<std::vector<Place>>()};
    return SphereLight{document["center_mm"].get<Place>(), document["radius_mm"].get<double>()};
}

}  // namespace

const char* light_schema_text() {
    return
#include "light_schema.inc"
        ;
}

std::vector<AreaLight> read_lights(const std::string& text_or_path) {
    std::vector<AreaLight> lights;
    each_light(text_or_path, light_schema_text(), [&](const nlohmann::json& document) {
        lights.push_back(light_from(document));
        LightCone checked(lights.back());
    });
    return lights;
}

}  // namespace irido::schemas
