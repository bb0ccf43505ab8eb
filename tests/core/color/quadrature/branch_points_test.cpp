#include "core/color/quadrature/branch_points.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/color/held_stack.hpp"
#include "core/material/library.hpp"
#include "core/stack/builder.hpp"

using namespace irido;

namespace {

constexpr WavelengthRange kSupport{360, 830};

Material clamped(std::string_view name) {
    Material material = find_material(name)->material;
    material.outside = Outside::clamp;
    return material;
}

Stack film_between(const Material& incident, const Material& substrate) {
    StackBuilder b;
    const std::size_t above = b.material(incident);
    b.add(b.layer(1.8, 100));
    Stack stack = b.over_material(b.material(substrate));
    stack.incident = above;
    return stack;
}

std::vector<BranchPoint> points_of(const Stack& stack, double sine) {
    const IndexTable rows(stack, smooth_pieces(stack, kSupport));
    std::vector<BranchPoint> points;
    BranchPoints(stack, rows).find({std::sqrt(1 - sine * sine), sine}, points);
    return points;
}

double ratio_at(const Stack& stack, double nm) {
    return index_at(stack.materials[stack.substrate], nm).real() /
           index_at(stack.materials[stack.incident], nm).real();
}

}  // namespace

TEST_CASE("branch points are where light meets the substrate at its critical angle") {
    const auto [incident, substrate] =
        GENERATE(table<const char*, const char*>({{"polycarbonate", "PMMA"}, {"BK7", "SiO2"}}));
    const Stack stack = film_between(clamped(incident), clamped(substrate));
    for (const double nm : {401.3, 463.7, 550.0, 621.9, 688.8}) {
        const std::vector<BranchPoint> points = points_of(stack, ratio_at(stack, nm));
        double closest = std::numeric_limits<double>::infinity();
        for (const BranchPoint& point : points)
            closest = std::min(closest, std::abs(1.0 / point.inverse_nm - nm));
        CAPTURE(incident, nm);
        CHECK(closest < 1e-5);
        CHECK(fall_rate(points, {nm - 1, nm + 1}) < 1e-3);
        CHECK(fall_rate(points, {nm - 1e-3, nm + 1e-3}) < 0.2);
        CHECK(fall_rate(points, {nm + 1, nm + 1.1}) > 2);
    }
}

TEST_CASE("branch points of an absorbing substrate are off the real axis") {
    Material glass = clamped("PMMA");
    const double nm = 550, k = 1e-3;
    std::get<RefractiveIndex>(glass.model).k = Constant{k};
    const Stack stack = film_between(clamped("polycarbonate"), glass);
    const std::vector<BranchPoint> points = points_of(stack, ratio_at(stack, nm));
    REQUIRE(!points.empty());
    const double step = 0.5;
    const double slope = (ratio_at(stack, nm + step) - ratio_at(stack, nm - step)) / (2 * step);
    const double away = k / index_at(stack.materials[stack.incident], nm).real() / std::abs(slope);
    for (const BranchPoint& point : points)
        CHECK(std::abs((1.0 / point.inverse_nm).imag()) > away / 3);
    CHECK(fall_rate(points, {nm - away / 10, nm + away / 10}) > 1);
    CHECK(fall_rate(points, {nm - away * 10, nm + away * 10}) < 0.3);
}

TEST_CASE("media that no light meets at a critical angle have no branch points") {
    const Stack glass = film_between({"air", RefractiveIndex{}, Outside::clamp}, clamped("BK7"));
    for (const double sine : {0.0, 0.5, 0.9, 1.0}) CHECK(points_of(glass, sine).empty());
    const Stack out = film_between(clamped("BK7"), {"air", RefractiveIndex{}, Outside::clamp});
    for (const double sine : {0.0, 0.5, 0.9}) CHECK(points_of(out, sine).empty());
    CHECK(!points_of(out, ratio_at(out, 500)).empty());
    CHECK(std::isinf(fall_rate({}, kSupport)));
}

TEST_CASE("incoherent layers and extraordinary waves have branch points of their own") {
    StackBuilder b;
    const std::size_t above = b.material(clamped("polycarbonate"));
    Element plate = StackBuilder::layer_of(b.material(clamped("PMMA")), 1e6);
    std::get<Layer>(plate.value).coherent = false;
    b.add(StackBuilder::group(2, {plate, b.layer(1.8, 100)}));
    Stack stack = b.over(2.5);
    stack.incident = above;
    const Stack alike = film_between(clamped("polycarbonate"), clamped("PMMA"));
    CHECK(!points_of(stack, ratio_at(alike, 550)).empty());

    const Material crystal{"crystal", Uniaxial{{clamped("Si"), clamped("PMMA")}}, Outside::clamp};
    const Stack birefringent = film_between(clamped("polycarbonate"), crystal);
    CHECK(!points_of(birefringent, ratio_at(alike, 550)).empty());
}

TEST_CASE("the effect of an index grows towards its branch point") {
    const Stack stack = film_between(clamped("polycarbonate"), clamped("PMMA"));
    const double nm = 550, sine = ratio_at(stack, nm);
    const std::vector<BranchPoint> points = points_of(stack, sine);
    for (const double from : {1.0, 5.0}) {
        const WavelengthRange panel{nm + from, nm + from + 3};
        const double at_end = ratio_at(stack, nm + from);
        // |n| / q^2 = 1 / (2 n0 (n/n0 - sin)) next to the point, in units of 1/n0
        const double exact = 1 / std::abs(at_end - sine);
        for (const std::size_t material : {stack.substrate, stack.incident}) {
            const double effect = effect_of_branch(points, material, panel);
            CHECK(effect > 0.4 * exact);
            CHECK(effect < 10 * exact);
        }
        CHECK(effect_of_branch(points, 2, panel) == 0);
    }
}
