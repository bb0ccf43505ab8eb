#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/comparison/compared_engine.hpp"
#include "core/comparison/given_film.hpp"

namespace irido {

/// An engine's result next to the exact colour.
struct EngineColor {
    std::optional<Triple> rgb;        ///< absent if the engine cannot represent the film
    std::optional<Triple> exact_xyz;  ///< absent if the base is known at three wavelengths only
    double exact_error = 0;           ///< error of exact_xyz
    std::optional<double> delta_e;    ///< CIEDE2000, if both are present
};

/// Engine results and exact colours of stacks that differ in thickness only. Thread-safe.
class StackComparison {
public:
    /// Throws DomainError as held_stack(), given_film() and color_algorithm() do.
    ///   tables      observer and illuminant; must outlive this object, as must the next two
    ///   engines     to compare
    ///   difference  how to compare them
    ///   stack       structure and materials
    ///   request     options of the exact colours
    StackComparison(const ColorTables& tables, std::span<const ComparedEngine> engines,
                    const EngineDifference& difference, const Stack& stack,
                    const ColorRequest& request);
    /// Throws DomainError as held_stack() and color_algorithm() do.
    ///   tables      observer and illuminant; must outlive this object, as must the next two
    ///   engines     to compare
    ///   difference  how to compare them
    ///   stack       structure and materials
    ///   request     options of the exact colours
    ///   given       inputs of the engines, if known
    StackComparison(const ColorTables& tables, std::span<const ComparedEngine> engines,
                    const EngineDifference& difference, const Stack& stack,
                    const ColorRequest& request, GivenFilm given);

    const GivenFilm& given() const { return given_; }

    /// [engine][angle]; angles in [0, 90] degrees.
    std::vector<EngineColor> operator()(const Stack& stack,
                                        std::span<const double> angles_deg) const;

private:
    std::span<const ComparedEngine> engines_;
    const EngineDifference& difference_;
    GivenFilm given_;
    RgbTransform rgb_;
    std::unique_ptr<ColorAlgorithm> exact_;
    std::vector<std::unique_ptr<ColorAlgorithm>> methods_;  ///< null for formulas
};

/// Tolerance of X, Y, Z that a comparison sets for exact colours.
inline constexpr double kComparisonTolerance = 1e-9;

}  // namespace irido
