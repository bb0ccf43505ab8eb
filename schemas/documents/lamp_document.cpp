#include "schemas/documents/lamp_document.hpp"

#include "schemas/documents/listed_lights.hpp"

namespace irido::schemas {

namespace {

Vector3 place_from(const nlohmann::json& value) {
    const auto at = value.get<std::array<double, 3>>();
    return {at[0], at[1], at[2]};
}

LampShape lamp_from(const nlohmann::json& document) {
    if (document.contains("direction"))
        return FarLamp{place_from(document["direction"]), document.value("irradiance", 1.0),
                       document.value("angle_deg", FarLamp::kSun_deg)};
    const double radiance = document.value("radiance", 1.0);
    if (!document.contains("vertices"))
        return BallLamp{place_from(document["center"]), document["radius"].get<double>(), radiance};
    FlatLamp flat{{}, radiance};
    for (const nlohmann::json& vertex : document["vertices"])
        flat.vertices.push_back(place_from(vertex));
    return flat;
}

}  // namespace

const char* lamp_schema_text() {
    return
#include "lamp_schema.inc"
        ;
}

std::vector<LampDocument> read_lamps(const std::string& text_or_path) {
    std::vector<LampDocument> lamps;
    each_light(text_or_path, lamp_schema_text(), [&](const nlohmann::json& document) {
        lamps.push_back({Lamp(lamp_from(document)), document.value("illuminant", ""), document});
    });
    return lamps;
}

}  // namespace irido::schemas
