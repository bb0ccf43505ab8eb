#include "cli/queries/other_documents.hpp"

#include "schemas/input_error.hpp"

namespace irido::cli {

void refuse_other_documents(const schemas::StackSource& source, const std::string& done) {
    const nlohmann::json& document = source.document;
    if (!document.is_object()) return;
    const auto refuse = [&](const std::string& kind) {
        throw schemas::InputError(
            source.file, "",
            "is a " + kind + " document, which cannot be " + done + " yet: give its stack");
    };
    const auto layers = document.find("layers");
    const bool has_facets = layers != document.end() && layers->is_array() && !layers->empty() &&
                            layers->front().is_object() && layers->front().contains("stack");
    if (has_facets || document.contains("scratches") || document.contains("fields") ||
        document.contains("base"))
        refuse("surface");
    if (document.contains("materials") && !document.contains("incident")) refuse("scene");
}

}  // namespace irido::cli
