#include "schemas/documents/listed_lights.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/schema_check.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::schemas {

void each_light(const std::string& text_or_path, const char* schema,
                const std::function<void(const nlohmann::json&)>& use) {
    const std::size_t first = text_or_path.find_first_not_of(" \t\r\n");
    const bool is_text =
        first != std::string::npos && (text_or_path[first] == '{' || text_or_path[first] == '[');
    const std::string file = is_text ? "light" : shown_path(text_or_path);
    const nlohmann::json document =
        parse_json(is_text ? text_or_path : read_text(text_or_path), file);
    const std::vector<Problem> problems = check(Schema(nlohmann::json::parse(schema)), document);
    if (!problems.empty()) {
        // a misspelt key may make a light look like one of another kind, which lacks keys
        const auto misspelt = std::ranges::find_if(problems, [](const Problem& problem) {
            return problem.message.find("did you mean") != std::string::npos;
        });
        const Problem& problem = misspelt == problems.end() ? problems.front() : *misspelt;
        throw InputError(file, problem.pointer, problem.message);
    }
    const bool is_list = document.is_array();
    for (std::size_t i = 0; i < (is_list ? document.size() : 1); ++i) {
        try {
            use(is_list ? document[i] : document);
        } catch (const DomainError& error) {
            throw InputError(file, is_list ? "/" + std::to_string(i) : "", error.what());
        }
    }
}

}  // namespace irido::schemas
