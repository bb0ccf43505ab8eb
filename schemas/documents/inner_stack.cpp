#include "schemas/documents/inner_stack.hpp"

#include <filesystem>

#include "schemas/input_error.hpp"

namespace irido::schemas {

StackSource inner_stack(const nlohmann::json& stack, const std::string& pointer,
                        const std::string& folder) {
    if (stack.is_object()) return {stack, pointer, folder};
    const std::string text = stack.get<std::string>();
    if (text.empty() || text == "-")
        throw InputError("", pointer,
                         "must be a stack, a file or an expression (got \"" + text + "\")");
    const bool is_expression = text.find('|') != std::string::npos;
    const std::string path = is_expression ? text : (std::filesystem::path(folder) / text).string();
    try {
        StackSource loaded = load_stack({path, {}});
        if (!is_expression) loaded.file = text;
        if (is_expression) loaded.folder = folder;  // for the material files that it names
        return loaded;
    } catch (const InputError& error) {
        const std::string file = error.file == path ? text : error.file;
        throw InputError("", pointer, InputError(file, error.where, error.message).what());
    }
}

}  // namespace irido::schemas
