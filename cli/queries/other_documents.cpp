#include "cli/queries/other_documents.hpp"

#include "schemas/documents/document_kind.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

void refuse_other_documents(const schemas::StackSource& source, const std::string& done) {
    const auto refuse = [&](const std::string& kind) {
        throw schemas::InputError(
            source.file, "",
            "is a " + kind + " document, which cannot be " + done + " yet: give its stack");
    };
    const schemas::DocumentKind kind = schemas::kind_of(source.document);
    if (kind == schemas::DocumentKind::surface) refuse("surface");
    if (kind == schemas::DocumentKind::scene) refuse("scene");
}

}  // namespace irido::cli
