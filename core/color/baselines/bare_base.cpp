#include "core/color/baselines/bare_base.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/color/color_request.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/quadrature_color.hpp"
#include "core/engines/engine_film.hpp"

namespace irido {

Triple bare_base_color(const ColorTables& tables, const Stack& held, const Material& above,
                       double cos_theta) {
    const Material& base = held.materials[held.substrate];
    if (is_real(base) || (is_constant(base) && is_constant(above))) {
        const Complex n = index_at(base, kMiddle_nm) / index_at(above, kMiddle_nm).real();
        const double gray = std::min(1.0, bare_reflectance(n.real(), n.imag(), cos_theta));
        return {gray, gray, gray};
    }
    const Stack bare{{above, base}, 0, {}, 1};
    const double angle_deg = cos_theta == 1 ? 0 : std::acos(cos_theta) * 180 / std::numbers::pi;
    StackColor color;
    (*quadrature_color(tables, bare, {}))(bare, {&angle_deg, 1}, {&color, 1});
    const RgbTransform transform(rgb_space("srgb"), tables.sensitivity().white(),
                                 Adaptation::bradford);
    Triple rgb = transform(color.xyz);
    for (double& component : rgb) component = std::clamp(component, 0.0, 1.0);
    return rgb;
}

}  // namespace irido
