#include "core/color/color_method.hpp"

#include <algorithm>
#include <array>

#include "core/color/fourier/one_film.hpp"
#include "core/error.hpp"

#define IRIDO_DECLARE(name) extern const ColorMethodKind name;
namespace irido {
#include "color_methods.inc"

std::span<const ColorMethodKind* const> color_methods() {
    static const auto sorted = [] {
        std::array methods{IRIDO_ALL};
        std::ranges::sort(methods, {}, &ColorMethodKind::place);
        return methods;
    }();
    return sorted;
}
#undef IRIDO_DECLARE
#undef IRIDO_ALL

std::string ColorMethodKind::fault_in(const Stack& stack, const ColorRequest& request) const {
    if (needs_reflected_film) return reflected_film_fault(name, stack, request);
    return fault ? fault(stack, request) : "";
}

const ColorMethodKind* find_color_method(std::string_view name) {
    const auto found = std::ranges::find(color_methods(), name, &ColorMethodKind::name);
    return found == color_methods().end() ? nullptr : *found;
}

ColorMethod color_method(std::string_view name, std::size_t count) {
    const ColorMethodKind* kind = find_color_method(name);
    if (!kind) throw DomainError("unknown colour method " + std::string(name));
    return {kind, count};
}

}  // namespace irido
