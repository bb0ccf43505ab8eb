#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/color/stack_color.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "tables/lut/lut_kind.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::tables;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const LutKind& kind(std::string_view name) {
    const auto kinds = lut_kinds();
    const auto found = std::ranges::find(kinds, name, [](const LutKind* k) { return k->name; });
    REQUIRE(found != kinds.end());
    return **found;
}

using List = std::vector<double>;

/// Options, a stack and what falls on it.
struct Request : LutRequest {
    explicit Request(const std::string& stack_text = "") {
        sensitivity = std::make_shared<Sensitivity>(irido::observer(2), irido::illuminant("D65"));
        space = &rgb_space("srgb");
        execution = Execution(1);
        if (!stack_text.empty()) document = read_stack({stack_text, {}});
    }
    Request(const Request&) = delete;
};

/// The whole table of a plan.
Lut table_of(const LutKind& of, const LutRequest& request) {
    const LutPlan plan = of.plan(request);
    Lut lut;
    lut.kind = of.name;
    for (const AxisPlan& axis : plan.axes) lut.axes.push_back(axis.axis);
    lut.channels = plan.channels;
    lut.facts = plan.facts;
    lut.type = LutType::f64;
    lut.values = plan.evaluate(lut.axes);
    return lut;
}

}  // namespace

TEST_CASE("lut falpha has the values of a 60-digit evaluation", "[lut]") {
    Request request;
    request.options["alpha"] = List{0.2};
    request.options["theta-i"] = List{20, 60};
    request.options["theta-d"] = List{15, 45, 75};
    const LutPlan plan = kind("falpha").plan(request);
    REQUIRE(plan.axes.size() == 3);
    CHECK(plan.axes[0].axis == LutAxis{"alpha", "", {0.2}});
    CHECK(plan.axes[1].axis == LutAxis{"theta_i_deg", "deg", {20, 60}});
    CHECK(plan.axes[2].axis == LutAxis{"theta_d_deg", "deg", {15, 45, 75}});
    CHECK(plan.channels == std::vector<std::string>{"F"});
    CHECK_FALSE((plan.axes[0].fixed || plan.axes[1].fixed || plan.axes[2].fixed));
    const Lut lut = table_of(kind("falpha"), request);
    // computed independently to 60 digits
    const List exact{1.8901438839298736,  0.2722569611850245, 0.023254638025755423,
                     0.07600163461048545, 0.7872043926777261, 0.33354570223087154};
    REQUIRE(lut.values.size() == exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i)
        CHECK_THAT(lut.values[i], WithinRel(exact[i], 1e-13));
    CHECK(kind("falpha").problems(lut).empty());
}

TEST_CASE("lut falpha's invariants hold and catch what breaks them", "[lut]") {
    Request request;
    request.options["alpha"] = List{0.05, 0.1, 0.7};
    for (const LutType type : {LutType::f16, LutType::f32, LutType::f64}) {
        Lut lut = table_of(kind("falpha"), request);
        CHECK(lut.values.size() == 3 * 360 * 360);
        lut.type = type;
        for (double& value : lut.values) value = rounded(value, type);
        CHECK(kind("falpha").problems(lut).empty());
    }
    const Lut good = table_of(kind("falpha"), request);
    const std::size_t row = (360 + 80) * 360;  // alpha 0.1, theta_i 20
    Lut negative = good, infinite = good, scaled = good;
    negative.values[row + 3] = -1e-3;
    infinite.values[row + 3] = std::nan("");
    for (std::size_t i = 0; i < 360; ++i) scaled.values[row + i] *= 1.01;
    for (const Lut* lut : {&negative, &infinite}) {
        const auto lines = kind("falpha").problems(*lut);
        REQUIRE(lines.size() == 1);
        CHECK_THAT(lines[0], Contains("alpha 0.1, theta_i_deg 20, theta_d_deg 0.75"));
    }
    const auto lines = kind("falpha").problems(scaled);
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines[0], Contains("must be G1 = ") && Contains("theta_i_deg 20"));
}

TEST_CASE("lut falpha measures against the size of a row", "[lut]") {
    const LutPlan plan = kind("falpha").plan(Request());
    CHECK_FALSE(plan.axes[1].fixed);
    CHECK(plan.axes[2].axis.count() == 360);
    const std::vector<LutAxis> axes{
        {"alpha", "", {0.1}}, {"theta_i_deg", "deg", {1, 2}}, {"theta_d_deg", "deg", {1, 2}}};
    const List exact{1, 4, 0, 0}, other{2, 4, 0, 0.5};
    const List got = plan.measure.differences(axes, exact, other);
    REQUIRE(got.size() == 4);
    const double unit0 = smith_masking(0.1, cos_of_incidence(1)) / 0.1;
    CHECK_THAT(got[0] * unit0, WithinRel(std::abs(exact[0] - other[0]), 1e-12));
    CHECK((got[1] == 0 && got[2] == 0));
    CHECK(got[3] > 0);
}

TEST_CASE("lut transmissivity is a table of integrated transmissivities", "[lut]") {
    Request request("1 | (1@250 | 1.5@250)^10 | 1");
    request.options["alpha"] = List{0.05, 0.3};
    request.options["theta-i"] = List{0, 30, 60, 85};
    request.options["wavelengths"] = List{450, 550, 650};
    const Lut lut = table_of(kind("transmissivity"), request);
    REQUIRE(lut.values.size() == 24);
    CHECK(lut.axes[0].name == "alpha");
    CHECK(lut.axes[1].name == "theta_i_deg");
    CHECK(lut.axes[2].name == "wavelength_nm");
    CHECK(lut.channels == std::vector<std::string>{"ft_cos"});
    CHECK(kind("transmissivity").problems(lut).empty());

    // one sample does not depend on the others
    const LutPlan plan = kind("transmissivity").plan(request);
    const std::vector<LutAxis> one{
        {"alpha", "", {0.3}}, {"theta_i_deg", "deg", {60}}, {"wavelength_nm", "nm", {550}}};
    CHECK(plan.evaluate(one) == List{lut.values[12 + 2 * 3 + 1]});

    Lut bad = lut;
    bad.values[4] = 1.01;
    const auto lines = kind("transmissivity").problems(bad);
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines[0], Contains("ft_cos") && Contains("theta_i_deg 30, wavelength_nm 550"));
}

TEST_CASE("lut transmissivity of an amplifying stack has no upper bound", "[lut]") {
    Request request("1 | 1.5-0.1i@2000 | 1");
    request.options["theta-i"] = List{0};
    request.options["wavelengths"] = List{550};
    const Lut lut = table_of(kind("transmissivity"), request);
    CHECK(lut.values[0] > 1);
    CHECK(kind("transmissivity").problems(lut).empty());
}

TEST_CASE("lut albedo is a table of colours", "[lut]") {
    Request request("1 | 1.33@380 | 1.5+3i");
    request.options["cos-theta"] = List{0, 0.5, 1};
    request.options["alpha"] = List{0, 0.2};
    const Lut lut = table_of(kind("albedo"), request);
    REQUIRE(lut.values.size() == 18);
    CHECK(lut.axes[0].name == "cos_theta");
    CHECK(lut.axes[1].name == "alpha");
    CHECK(lut.channels == std::vector<std::string>{"R", "G", "B"});
    CHECK(lut.facts.at("color_space") == "srgb");
    CHECK(kind("albedo").problems(lut).empty());
    // alpha 0 is the stack's colour
    const ColorTables tables(*request.sensitivity);
    const RgbTransform to_rgb(rgb_space("srgb"), request.sensitivity->white(),
                              Adaptation::bradford);
    for (const auto& [theta, place] : {std::pair{90.0, 0}, {60.0, 6}, {0.0, 12}}) {
        const Triple rgb =
            to_rgb(stack_color(tables, request.document.stack, {}, {}, {&theta, 1})[0].xyz);
        for (int c = 0; c < 3; ++c)
            CHECK_THAT(lut.values[static_cast<std::size_t>(place + c)],
                       WithinAbs(rgb[static_cast<std::size_t>(c)], 1e-5));
    }

    Request xyz("1 | 1.33@380 | 1.5+3i");
    xyz.options = request.options;
    xyz.space = &rgb_space("xyz");
    xyz.adaptation = Adaptation::none;
    const Lut as_xyz = table_of(kind("albedo"), xyz);
    CHECK(as_xyz.channels == std::vector<std::string>{"X", "Y", "Z"});
    CHECK(kind("albedo").problems(as_xyz).empty());
    const RgbTransform none(rgb_space("srgb"), request.sensitivity->white(), Adaptation::bradford);
    const Triple again = none({as_xyz.values[9], as_xyz.values[10], as_xyz.values[11]});
    for (std::size_t c = 0; c < 3; ++c) CHECK_THAT(again[c], WithinAbs(lut.values[9 + c], 1e-12));

    Lut bad = lut;
    bad.values[7] = 3;
    CHECK_THAT(kind("albedo").problems(bad).at(0), Contains("cos_theta 0.5, alpha 0"));
}

TEST_CASE("lut albedo measures in CIEDE2000 under the white", "[lut]") {
    const Request request("1 | 1.5");
    const LutPlan plan = kind("albedo").plan(request);
    CHECK(plan.measure.name == "delta_e_2000");
    CHECK(plan.axes[0].axis.count() == 32);
    CHECK(plan.axes[1].axis.values.front() == 0);
    const std::vector<LutAxis> axes{{"cos_theta", "", {1}}, {"alpha", "", {0.1, 0.2}}};
    const List exact{1, 1, 1, 0.18, 0.18, 0.18}, other{1, 1, 1, 0.2, 0.18, 0.18};
    const List differences = plan.measure.differences(axes, exact, other);
    REQUIRE(differences.size() == 2);
    CHECK(differences[0] == 0);
    CHECK((differences[1] > 1 && differences[1] < 5));
}

TEST_CASE("tables of rough layers refuse what cannot be made", "[lut][refused]") {
    const auto refused = [](const LutKind& of, const std::string& option, List values) {
        Request request("1 | 1.33@380 | 1");
        request.options[option] = std::move(values);
        of.plan(request);
    };
    CHECK_THROWS_WITH(refused(kind("falpha"), "alpha", {0}),
                      Contains("alpha must be in [1e-04, 1]"));
    CHECK_THROWS_WITH(refused(kind("falpha"), "theta-i", {91}), Contains("theta-i must be in"));
    CHECK_THROWS_WITH(refused(kind("falpha"), "theta-d", {10, 20, 15}),
                      "theta-d must ascend or descend strictly (got 20, 15)");
    CHECK_THROWS_WITH(refused(kind("falpha"), "theta-d", {10, 10}), Contains("strictly"));
    CHECK_THROWS_AS(refused(kind("transmissivity"), "alpha", {2}), DomainError);
    CHECK_THROWS_WITH(refused(kind("transmissivity"), "wavelengths", {0.5}),
                      Contains("wavelength_nm"));
    CHECK_THROWS_WITH(refused(kind("albedo"), "cos-theta", {0.5, 1.5}), Contains("cos_theta"));
    CHECK_THROWS_WITH(refused(kind("albedo"), "alpha", {1e-6}), Contains("alpha must be"));
    Request transmitted("1 | 1.33@380 | 1"), varied("1 | 1.33@380 | 1");
    transmitted.color.sides = {Side::transmitted};
    varied.vary = {{"layers.0.thickness_nm", {1, 2}}};
    CHECK_THROWS_WITH(kind("albedo").plan(transmitted), "side must be R for albedo (got T)");
    CHECK_THROWS_WITH(kind("albedo").plan(varied), Contains("albedo has no varied value"));
}
