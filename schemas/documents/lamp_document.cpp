#include "schemas/documents/lamp_document.hpp"

#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"

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
    const std::size_t first = text_or_path.find_first_not_of(" \t\r\n");
    const bool is_text =
        first != std::string::npos && (text_or_path[first] == '{' || text_or_path[first] == '[');
    const std::string file = is_text ? "light" : shown_path(text_or_path);
    const nlohmann::json document =
        parse_json(is_text ? text_or_path : read_text(text_or_path), file);
    static const Schema schema(nlohmann::json::parse(lamp_schema_text()));
    for (const Problem& problem : check(schema, document))
        throw InputError(file, problem.pointer, problem.message);
    std::vector<LampDocument> lamps;
    const bool is_list = document.is_array();
    for (std::size_t i = 0; i < (is_list ? document.size() : 1); ++i) {
        const nlohmann::json& one = is_list ? document[i] : document;
        try {
            lamps.push_back({Lamp(lamp_from(one)), one.value("illuminant", ""), one});
        } catch (const DomainError& error) {
            throw InputError(file, is_list ? "/" + std::to_string(i) : "", error.what());
        }
    }
    return lamps;
}

}  // namespace irido::schemas
