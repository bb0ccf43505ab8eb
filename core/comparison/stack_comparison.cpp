#include "core/comparison/stack_comparison.hpp"

#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"

namespace irido {

StackComparison::StackComparison(const ColorTables& tables, std::span<const ComparedEngine> engines,
                                 const EngineDifference& difference, const Stack& stack,
                                 const ColorRequest& request)
    : StackComparison(tables, engines, difference, stack, request,
                      given_film(tables, held_stack(stack, tables.sensitivity()))) {}

StackComparison::StackComparison(const ColorTables& tables, std::span<const ComparedEngine> engines,
                                 const EngineDifference& difference, const Stack& stack,
                                 const ColorRequest& request, GivenFilm given)
    : engines_(engines),
      difference_(difference),
      given_(std::move(given)),
      rgb_(rgb_space("srgb"), tables.sensitivity().white(), Adaptation::bradford),
      exact_(color_algorithm(tables, stack, {}, request)) {
    for (const ComparedEngine& engine : engines_)
        methods_.push_back(
            engine.engine ? nullptr
                          : color_algorithm(tables, engine.takes_film() ? given_.reduced : stack,
                                            engine.method, request));
}

std::vector<EngineColor> StackComparison::operator()(const Stack& stack,
                                                     std::span<const double> angles_deg) const {
    const std::size_t angles = angles_deg.size();
    std::vector<StackColor> exact(angles), approximate(angles);
    (*exact_)(stack, angles_deg, exact);
    std::vector<EngineColor> result(engines_.size() * angles);
    EngineFilm film = given_.with_thickness_of(stack);
    for (std::size_t e = 0; e < engines_.size(); ++e) {
        if (methods_[e])
            (*methods_[e])(engines_[e].takes_film() ? given_.reduced_of(stack) : stack, angles_deg,
                           approximate);
        for (std::size_t a = 0; a < angles; ++a) {
            EngineColor& color = result[e * angles + a];
            film.cos_theta = cos_of_incidence(angles_deg[a]);
            color.rgb =
                methods_[e] ? rgb_(approximate[a].xyz) : engines_[e].engine->reflectance(film);
            color.exact_xyz = exact[a].xyz;
            color.exact_error = exact[a].error;
            color.delta_e = difference_(engines_[e], *color.rgb, exact[a].xyz);
        }
    }
    return result;
}

}  // namespace irido
