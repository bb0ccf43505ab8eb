#include "schemas/documents/light_document.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"

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
    const std::size_t first = text_or_path.find_first_not_of(" \t\r\n");
    const bool is_text =
        first != std::string::npos && (text_or_path[first] == '{' || text_or_path[first] == '[');
    const std::string file = is_text ? "light" : shown_path(text_or_path);
    const nlohmann::json document =
        parse_json(is_text ? text_or_path : read_text(text_or_path), file);
    static const Schema schema(nlohmann::json::parse(light_schema_text()));
    for (const Problem& problem : check(schema, document))
        throw InputError(file, problem.pointer, problem.message);
    std::vector<AreaLight> lights;
    const bool is_list = document.is_array();
    for (std::size_t i = 0; i < (is_list ? document.size() : 1); ++i) {
        lights.push_back(light_from(is_list ? document[i] : document));
        try {
            LightCone checked(lights.back());
        } catch (const DomainError& error) {
            throw InputError(file, is_list ? "/" + std::to_string(i) : "", error.what());
        }
    }
    return lights;
}

}  // namespace irido::schemas
