#include <catch2/catch.hpp>
#include <cmath>

#include "core/design/design_model.hpp"
#include "core/design/problem_values.hpp"
#include "core/math/constants.hpp"
#include "tests/core/design/problems.hpp"

using namespace irido;

namespace {

/// The largest deviation of the Jacobian from central differences of exact values, relative to the
/// column's largest entry.
double jacobian_error(const DesignProblem& problem, const std::vector<double>& x) {
    DesignModel model(problem);
    REQUIRE(model.is_analytic());
    model.adapt_colors(x, 1e-9);
    std::vector<double> gradient(x.size());
    REQUIRE(std::isfinite(model.objective(x, gradient)));
    const DesignRows at = model.rows();
    double worst = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
        if (problem.free[p].is_integer) continue;
        const double h = 2e-5 * std::max(1e-2, std::abs(x[p]));
        std::vector<double> moved = x;
        DesignRows more, less;
        moved[p] = x[p] + h;
        compute_values(problem, stack_of(problem, moved), 1e-11, best_simd_level(), more);
        moved[p] = x[p] - h;
        compute_values(problem, stack_of(problem, moved), 1e-11, best_simd_level(), less);
        double largest = 1e-9, error = 0;
        for (std::size_t i = 0; i < at.residual.size(); ++i) {
            const double slope = at.jacobian[p * at.residual.size() + i];
            double change = more.residual[i] - less.residual[i];
            if (std::abs(change) > 180) change -= std::copysign(360, change);
            largest = std::max(largest, std::abs(slope));
            error = std::max(error, std::abs(slope - change / (2 * h)));
        }
        worst = std::max(worst, error / largest);
    }
    return worst;
}

/// An absorbing stack with a group, links, and numbers of every kind of material free.
DesignProblem mixed_problem() {
    DesignProblem problem;
    StackBuilder builder;
    const std::size_t film = builder.material(cauchy(1.6, 0.01));
    const std::size_t glass = builder.material(
        {"s",
         RefractiveIndex{Formula{2, {0, 1.2, 0.01, 0.3, 0.02}, kAllWavelengths}, Constant{0}}});
    const std::size_t metal = builder.material(
        {"m", LorentzDrude{1.5, 8, {{0.7, 0.1, 0}, {0.4, 1, 3}}, kAllWavelengths}});
    const std::size_t table =
        builder.material({"t", RefractiveIndex{Table{{300, 500, 600, 900}, {2, 2.1, 2.05, 1.9}},
                                               Table{{300, 500, 600, 900}, {0.1, 0.02, 0.05, 0}}}});
    const std::size_t constant = builder.material(Complex(1.8, 0.05));
    builder.add(StackBuilder::layer_of(film, 120));
    builder.add(StackBuilder::group(
        3, {StackBuilder::layer_of(constant, 60), StackBuilder::layer_of(film, 90)}));
    builder.add(StackBuilder::layer_of(metal, 12));
    builder.add(StackBuilder::layer_of(table, 70));
    problem.stack = builder.over_material(glass);
    using Part = MaterialNumber::Part;
    const auto add = [&](double start, std::vector<FreePlace> places) {
        problem.free.push_back({"x", start, -kInfinity, kInfinity, false, std::move(places)});
    };
    add(120, {ThicknessOf{{0}}, ThicknessOf{{1, 1}}});
    add(60, {ThicknessOf{{1, 0}}});
    add(12, {ThicknessOf{{2}}});
    add(1.8, {MaterialNumber{constant, Part::n, 0}});
    add(0.05, {MaterialNumber{constant, Part::k, 0}});
    add(1.6, {MaterialNumber{film, Part::coefficient, 0}});
    add(0.01, {MaterialNumber{film, Part::coefficient, 1}});
    add(1.2, {MaterialNumber{glass, Part::coefficient, 1}});
    add(0.01, {MaterialNumber{glass, Part::coefficient, 2}});
    add(1.5, {MaterialNumber{metal, Part::eps_infinity, 0}});
    add(8, {MaterialNumber{metal, Part::plasma, 0}});
    add(0.7, {MaterialNumber{metal, Part::strength, 0}});
    add(1, {MaterialNumber{metal, Part::damping, 1}});
    add(3, {MaterialNumber{metal, Part::resonance, 1}});
    add(2.1, {MaterialNumber{table, Part::n_row, 1}});
    add(0.05, {MaterialNumber{table, Part::k_row, 2}});
    problem.free.push_back({"N", 3, 1, 5, true, {RepeatOf{{1}}}});
    return problem;
}

DesignTarget plain_target(DesignQuantity quantity, std::vector<Light> lights, double value) {
    DesignTarget target{.quantity = quantity,
                        .wavelength_nm = {410, 520, 555, 700},
                        .angle_deg = {0, 50},
                        .polarizations = std::move(lights)};
    target.target.assign(entry_count(target), value);
    target.weight.assign(entry_count(target), 1);
    target.sigma.assign(entry_count(target), 1);
    return target;
}

std::vector<double> start_of(const DesignProblem& problem) {
    std::vector<double> x;
    for (const FreeValue& value : problem.free) x.push_back(value.start);
    return x;
}

}  // namespace

TEST_CASE("derivatives of every quantity by every kind of value are those of differences",
          "[design]") {
    using enum DesignQuantity;
    for (const DesignQuantity quantity :
         {R, T, A, psi_deg, delta_deg, delta_nebraska_deg, phase_r_deg, phase_t_deg}) {
        DesignProblem problem = mixed_problem();
        const bool is_phase = quantity == phase_r_deg || quantity == phase_t_deg;
        problem.targets = {plain_target(
            quantity,
            is_phase ? std::vector{Light::s, Light::p} : std::vector{Light::unpolarized, Light::p},
            0.3)};
        if (quantity == psi_deg || quantity == delta_deg || quantity == delta_nebraska_deg)
            problem.targets[0].angle_deg = {55};
        problem.targets[0].target.resize(entry_count(problem.targets[0]));
        INFO("quantity " << static_cast<int>(quantity));
        CHECK(jacobian_error(problem, start_of(problem)) < 1e-6);  // limited by the differences
    }
}

TEST_CASE("derivatives of colours go through the quadrature", "[design][slow]") {
    for (const MeritKind merit : {MeritKind::delta_e_76, MeritKind::delta_e_2000}) {
        DesignProblem problem = mixed_problem();
        problem.merit = merit;
        problem.targets = {color_target({0, 60}, {{{50, 20, 10}, {40, -10, 5}}})};
        CHECK(jacobian_error(problem, start_of(problem)) < 1e-4);
    }
}

TEST_CASE("the model's values are those of the spectra, and its objective that of the merit",
          "[design]") {
    const DesignProblem problem = antireflection({94.4, 58.5, 94.4, 58.5, 94.4, 58.5, 94.4, 58.5});
    DesignModel model(problem);
    const std::vector<double> x = model.start();
    std::vector<double> gradient(x.size());
    const double merit = model.merit(model.objective(x, gradient));
    CHECK(merit == Approx(0.6989627560347718).epsilon(1e-12));  // an independent transfer matrix
    CHECK(exact_merit(problem, x) == Approx(merit).epsilon(1e-12));
}

TEST_CASE("the gradient of a scalar merit by thicknesses", "[design]") {
    // derivatives of merit^2 from an independent program with complex transfer matrices and
    // differences of 1e-7 nm
    const DesignProblem problem = coating(
        {92, 60, 35, 14},
        {.quantity = DesignQuantity::R, .wavelength_nm = steps(400, 700, 10), .angle_deg = {45}});
    DesignModel model(problem);
    std::vector<double> gradient(4);
    CHECK(model.merit(model.objective(model.start(), gradient)) ==
          Approx(0.057838220744613984).epsilon(1e-12));
    const std::vector<double> exact{-0.00015778527331376766, -4.738009936856137e-05,
                                    4.5488966767340453e-05, -0.000345210350148268};
    for (std::size_t i = 0; i < 4; ++i) CHECK(gradient[i] == Approx(exact[i]).epsilon(1e-10));
}

TEST_CASE("targets of inequality count where they are violated", "[design]") {
    DesignProblem problem = antireflection({90, 60, 90, 20});
    problem.targets[0].side = TargetSide::at_most;
    problem.targets[0].target.assign(entry_count(problem.targets[0]), 0.2);
    DesignModel model(problem);
    std::vector<double> gradient(4);
    model.objective(model.start(), gradient);
    const DesignRows& rows = model.rows();
    bool some = false, none = false;
    for (std::size_t i = 0; i < rows.residual.size(); ++i) {
        CHECK(rows.residual[i] == Approx(std::max(0.0, rows.value[i] - 0.2)).margin(1e-15));
        (rows.residual[i] > 0 ? some : none) = true;
        if (rows.residual[i] == 0)
            for (std::size_t p = 0; p < 4; ++p)
                CHECK(rows.jacobian[p * rows.residual.size() + i] == 0);
    }
    CHECK(some);
    CHECK(none);
}

TEST_CASE("the total thickness may be bounded", "[design]") {
    DesignProblem problem = mixed_problem();
    DesignTarget total{.quantity = DesignQuantity::total_thickness_nm, .angle_deg = {0}};
    total.target = {500};
    total.weight = {1e-4};
    total.sigma = {1};
    problem.targets = {plain_target(DesignQuantity::R, {Light::s}, 0.3), total};
    CHECK(jacobian_error(problem, start_of(problem)) < 1e-6);
    DesignRows rows;
    exact_merit(problem, start_of(problem), &rows);
    CHECK(rows.value.back() == 120 + 3 * (60 + 120) + 12 + 70);  // with linked layers
    problem.targets[1].side = TargetSide::at_most;
    problem.targets[1].target = {1000};
    exact_merit(problem, start_of(problem), &rows);
    CHECK(rows.residual.back() == 0);
}

TEST_CASE("derivatives across incoherent plates", "[design]") {
    using enum DesignQuantity;
    for (const DesignQuantity quantity : {R, T, A}) {
        DesignProblem problem = mixed_problem();
        // a plate between the group and the metal
        problem.stack.materials.push_back(crown_glass());
        const std::size_t crown = problem.stack.materials.size() - 1;
        auto& elements = problem.stack.elements;
        elements.insert(elements.begin() + 2, {Layer{crown, 1e6, 0, false}});
        problem.free[2].places = {ThicknessOf{{3}}};
        problem.targets = {plain_target(quantity, {Light::unpolarized, Light::p}, 0.3)};
        INFO("quantity " << static_cast<int>(quantity));
        CHECK(jacobian_error(problem, start_of(problem)) < 1e-6);
        DesignModel model(problem);
        std::vector<double> gradient(problem.free.size());
        model.objective(start_of(problem), gradient);
        DesignRows rows;
        exact_merit(problem, start_of(problem), &rows);
        for (std::size_t i = 0; i < rows.value.size(); ++i)
            CHECK(rows.value[i] == Approx(model.rows().value[i]).margin(1e-12));
    }
}

TEST_CASE("absorbing plates and delays are differenced", "[design]") {
    DesignProblem problem = antireflection({90, 60});
    std::get<Layer>(problem.stack.elements[1].value).coherent = false;
    const std::size_t plate = std::get<Layer>(problem.stack.elements[1].value).material;
    std::get<RefractiveIndex>(problem.stack.materials[plate].model).k = Constant{1e-4};
    problem.free.pop_back();
    DesignModel model(problem);
    CHECK_FALSE(model.is_analytic());
    std::vector<double> gradient(1), at{90};
    model.objective(at, gradient);
    const auto objective = [&](double d) { return model.objective(std::vector{d}); };
    CHECK(gradient[0] == Approx((objective(90.01) - objective(89.99)) / 0.02).epsilon(1e-5));

    DesignProblem delay = antireflection({90, 60, 90, 20});
    delay.targets = {plain_target(DesignQuantity::gdd_r_fs2, {Light::s}, 10)};
    DesignModel of_delay(delay);
    std::vector<double> slopes(4);
    CHECK(std::isfinite(of_delay.objective(of_delay.start(), slopes)));
    CHECK(slopes[0] != 0);
}
