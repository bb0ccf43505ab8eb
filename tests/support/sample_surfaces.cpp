#include "tests/support/sample_surfaces.hpp"

#include "schemas/documents/surface_document.hpp"

namespace irido::test {

LayeredSurface surface_of(const std::string& json) {
    return std::get<LayeredSurface>(
        schemas::read_surface(nlohmann::json::parse(json), "test", "").surface);
}

LayeredSurface random_surface(Random& random, std::size_t most_layers) {
    const auto number = [&](double from, double to) {
        return std::to_string(random.uniform(from, to));
    };
    const std::string n = random.one_in(2) ? "1" : number(1.1, 1.6);
    std::string json =
        "{\"inside\": " + n + ", \"base\": {\"albedo\": " + number(0, 1) + "}, \"layers\": [";
    const std::size_t layers = 1 + random.below(most_layers);
    for (std::size_t l = 0; l < layers; ++l) {
        std::string index = number(1.2, 2.2);
        if (random.one_in(3)) index += "+" + number(0, 0.3) + "i";
        json += std::string(l > 0 ? "," : "") + R"({"alpha": )" + number(0.15, 0.9) +
                R"(, "stack": ")" + n + " | (" + index + "@" + number(50, 300) + " | 1.45@" +
                number(50, 300) + ")^" + std::to_string(1 + random.below(4)) + " | " + n + "\"}";
    }
    return surface_of(json + "]}");
}

}  // namespace irido::test
