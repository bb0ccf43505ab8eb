#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/color/color_tables.hpp"
#include "core/comparison/compared_engine.hpp"
#include "core/comparison/given_film.hpp"

namespace irido {

/// An engine's result and the exact colour beside it.
struct EngineColor {
    std::optional<Triple> rgb;        ///< none where the engine cannot take the film
    std::optional<Triple> exact_xyz;  ///< none where the base is known at three wavelengths only
    double exact_error = 0;           ///< of exact_xyz
    std::optional<double> delta_e;    ///< CIEDE2000, where there are both
};

/// Engines and exact colours of stacks that differ in thicknesses only. Safe from many threads.
class StackComparison {
public:
    /// `tables` must outlive it. Throws DomainError as held_stack(), given_film() and
    /// color_algorithm() do.
    StackComparison(const ColorTables& tables, std::span<const ComparedEngine> engines,
                    const EngineDifference& difference, const Stack& stack,
                    const ColorRequest& request);
    /// The same with known engine inputs.
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

/// Largest error of X, Y, Z of exact colours that a comparison asks for.
inline constexpr double kComparisonTolerance = 1e-9;

}  // namespace irido
