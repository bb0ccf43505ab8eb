#include "cli/queries/stack_tables.hpp"

#include "cli/options/list.hpp"
#include "core/error.hpp"
#include "schemas/input_error.hpp"

namespace irido::cli {

namespace {

/// Throws the error of the first material without an index at one of the wavelengths, with its JSON
/// pointer.
[[noreturn]] void throw_material_error(const schemas::StackDocument& document,
                                       const std::vector<double>& wavelengths_nm,
                                       const DomainError& fallback) {
    for (std::size_t m = 0; m < document.stack.materials.size(); ++m) {
        try {
            for (const double wavelength : wavelengths_nm)
                extraordinary_index_at(document.stack.materials[m], wavelength);
        } catch (const DomainError& error) {
            throw schemas::InputError(document.file, document.material_pointers[m], error.what());
        }
    }
    throw schemas::InputError(document.file, document.material_pointers[document.stack.incident],
                              fallback.what());
}

}  // namespace

std::string parse_polarizations(std::string_view text) {
    std::string letters;
    for (const std::string_view item : comma_separated(text)) {
        if (item != "s" && item != "p" && item != "u")
            throw UsageError("--polarization: must be s, p, u or several with commas (got '" +
                             std::string(text) + "')");
        letters += item;
    }
    return letters;
}

IndexTable index_table(const schemas::StackDocument& document,
                       const std::vector<double>& wavelengths_nm) {
    try {
        return {document.stack, wavelengths_nm};
    } catch (const DomainError& error) {
        throw_material_error(document, wavelengths_nm, error);
    }
}

StackPower stack_power(const schemas::StackDocument& document, const Stack& stack) {
    try {
        return StackPower(stack);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

}  // namespace irido::cli
