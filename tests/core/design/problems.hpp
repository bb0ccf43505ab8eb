#pragma once

#include <vector>

#include "core/colorimetry/illuminant.hpp"
#include "core/design/design_problem.hpp"
#include "core/stack/builder.hpp"

namespace irido {

inline Material cauchy(double a, double b) {
    return {"cauchy", RefractiveIndex{Formula{5, {a, b, -2}, kAllWavelengths}, Constant{0}}};
}

/// Borosilicate crown glass, n^2 = 1 + sum B L^2/(L^2 - C), from Schott's catalogue: N-BK7.
inline Material crown_glass() {
    return {"crown", RefractiveIndex{Formula{2,
                                             {0, 1.03961212, 0.00600069867, 0.231792344,
                                              0.0200179144, 1.01046945, 103.560653},
                                             kAllWavelengths},
                                     Constant{0}}};
}

inline std::vector<double> steps(double first, double last, double step) {
    std::vector<double> values;
    for (double x = first; x <= last + 1e-9; x += step) values.push_back(x);
    return values;
}

/// Alternating low and high indices on glass, all thicknesses free in [0, 250] nm.
inline DesignProblem coating(const std::vector<double>& thickness_nm, DesignTarget target) {
    DesignProblem problem;
    StackBuilder builder;
    const std::size_t low = builder.material(cauchy(1.445, 0.0035));
    const std::size_t high = builder.material(cauchy(2.25, 0.03));
    const std::size_t glass = builder.material(crown_glass());
    for (std::size_t i = 0; i < thickness_nm.size(); ++i) {
        builder.add(StackBuilder::layer_of(i % 2 == 0 ? low : high, thickness_nm[i]));
        problem.free.push_back({"layer", thickness_nm[i], 0, 250, false, {ThicknessOf{{i}}}});
    }
    problem.stack = builder.over_material(glass);
    target.weight.assign(entry_count(target), 1);
    target.sigma.assign(entry_count(target), 1);
    if (target.target.empty()) target.target.assign(entry_count(target), 0);
    problem.targets = {std::move(target)};
    return problem;
}

/// No reflection from 400 to 700 nm at 0 and 45 degrees.
inline DesignProblem antireflection(const std::vector<double>& thickness_nm) {
    return coating(
        thickness_nm,
        {.quantity = DesignQuantity::R, .wavelength_nm = steps(400, 700, 5), .angle_deg = {0, 45}});
}

inline DesignTarget color_target(std::vector<double> angles_deg, std::vector<Triple> labs) {
    DesignTarget target{.quantity = DesignQuantity::lab, .angle_deg = std::move(angles_deg)};
    target.lab = std::move(labs);
    target.weight.assign(entry_count(target), 1);
    target.sigma.assign(entry_count(target), 1);
    target.light.illuminant = illuminant("D65");
    return target;
}

}  // namespace irido
