#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "core/stack/builder.hpp"
#include "core/truth/color_cases.hpp"
#include "tests/oracle/stack_oracle.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using Catch::Contains;
using Catch::WithinAbs;
using test::d65_tables;

namespace {

StackColor color(const Stack& stack, double angle_deg, const ColorMethod& method,
                 const ColorRequest& request = {}, const ColorTables& tables = d65_tables()) {
    StackColor result;
    (*color_algorithm(tables, stack, method, request))(stack, std::span(&angle_deg, 1),
                                                       std::span(&result, 1));
    return result;
}

Triple exact(const Stack& stack, double angle_deg, Side side = Side::reflected) {
    return stack_color(d65_tables(), stack, color_method("quadrature"),
                       {.sides = {side}, .tolerance = 1e-11}, std::span(&angle_deg, 1))
        .front()
        .xyz;
}

double largest_error(const Triple& a, const Triple& b) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
}

Stack film(Complex index, double thickness_nm, Complex substrate, Complex incident = 1) {
    StackBuilder b(incident);
    b.add(b.layer(index, thickness_nm));
    return b.over(substrate);
}

/// XYZ relative to the white.
Triple relative(const Triple& xyz, const Triple& white = d65_tables().sensitivity().white()) {
    return {xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]};
}

Triple linear_srgb(const Triple& xyz) {
    return RgbTransform(rgb_space("srgb"), d65_tables().sensitivity().white(),
                        Adaptation::bradford)(xyz);
}

constexpr std::array<const char*, 3> kFilmMethods{"gaussian", "gltf", "smits"};
constexpr std::array<const char*, 5> kAll{"equal", "naive", "gaussian", "gltf", "smits"};

}  // namespace

TEST_CASE("a perfect mirror is the white of every light") {
    // at 90 degrees everything is totally reflecting
    const Stack stack = film(1.5, 400, {0.5, 2});
    for (const std::string_view name : illuminant_names()) {
        const ColorTables tables(Sensitivity(observer(10), illuminant(name)));
        const Triple& white = tables.sensitivity().white();
        for (const std::string_view method : kAll) {
            CAPTURE(name, method);
            const StackColor result = color(stack, 90, color_method(method, 37), {}, tables);
            const bool is_sum = method == "equal" || method == "smits";
            if (is_sum) CHECK(result.xyz == white);
            CHECK(largest_error(result.xyz, white) < 1e-14);
            CHECK(std::isinf(result.error));
            CHECK(result.method == method);
        }
    }
    CHECK(color(stack, 90, color_method("naive")).evaluations == 3);
    CHECK(color(stack, 90, color_method("equal", 37)).evaluations == 37);
    CHECK(color(stack, 90, color_method("gltf")).evaluations == 0);
}

TEST_CASE("a film of no thickness leaves the bare substrate") {
    const Stack stack = film(1.6, 0, {1.2, 2});
    for (const double angle : {0.0, 40.0, 80.0}) {
        Triple bare{};
        for (const Polarization p : {Polarization::s, Polarization::p}) {
            const double R = oracle::coherent_fast(stack, {550, angle, p}).R;
            for (double& channel : bare) channel += R / 2;
        }
        CAPTURE(angle);
        for (const ColorMethod method :
             {color_method("equal", 9), color_method("naive"), color_method("gaussian", 200)})
            CHECK(largest_error(relative(color(stack, angle, method).xyz), bare) < 1e-13);
    }
    // its two beams: r12 + (1 - r12^2) r23
    const Complex r12 = (1 - 1.6) / (1 + 1.6);
    const Complex r23 = (1.6 - Complex(1.2, 2)) / (1.6 + Complex(1.2, 2));
    const double R = std::norm(r12 + (1.0 - r12 * r12) * r23);
    CHECK(largest_error(relative(color(stack, 0, color_method("smits")).xyz), {R, R, R}) < 1e-13);
}

TEST_CASE("equal wavelengths converge at second order") {
    const Stack stack = film(1.5, 525, {1.5, 3});
    const Triple truth = exact(stack, 30);
    // every row of the tables is a sample, so only the step changes
    const auto error = [&](std::size_t steps_per_nm) {
        return largest_error(color(stack, 30, color_method("equal", 470 * steps_per_nm + 1)).xyz,
                             truth);
    };
    for (const std::size_t steps : {2U, 4U, 8U})
        CHECK_THAT(error(steps) / error(2 * steps), WithinAbs(4, 0.05));
    CHECK(error(16) < 1e-7);
}

TEST_CASE("equal wavelengths serve every side, light and angle at once") {
    StackBuilder b;
    b.add(StackBuilder::group(4, {b.layer(2.2, 60), b.layer(1.4, 100)}));
    const Stack stack = b.over(1.5);
    const std::vector<double> angles{0, 33, 71};
    ColorRequest request;
    request.sides = {Side::transmitted, Side::reflected};
    const auto colors = [&](Light light) {
        request.light = light;
        std::vector<StackColor> result(angles.size() * 2);
        (*color_algorithm(d65_tables(), stack, color_method("equal", 3000), request))(stack, angles,
                                                                                      result);
        return result;
    };
    const auto s = colors(Light::s), p = colors(Light::p), u = colors(Light::unpolarized);
    for (std::size_t a = 0; a < angles.size(); ++a) {
        const Triple &T = u[2 * a].xyz, &R = u[2 * a + 1].xyz;
        CHECK(largest_error(T, exact(stack, angles[a], Side::transmitted)) < 1e-5);
        CHECK(largest_error(R, exact(stack, angles[a])) < 1e-5);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK_THAT(R[c] + T[c], WithinAbs(d65_tables().sensitivity().white()[c], 1e-14));
            CHECK_THAT((s[2 * a].xyz[c] + p[2 * a].xyz[c]) / 2, WithinAbs(T[c], 1e-15));
        }
        CHECK((a == 0) == (largest_error(s[2 * a].xyz, p[2 * a].xyz) < 1e-14));
    }
}

TEST_CASE("the naive colour is R at three wavelengths") {
    const Stack stack = film(1.5, 525, {1.5, 3});
    const Triple rgb = linear_srgb(color(stack, 50, color_method("naive")).xyz);
    constexpr std::array kWavelengths{650.0, 510.0, 475.0};
    for (std::size_t c = 0; c < 3; ++c) {
        double R = 0;
        for (const Polarization p : {Polarization::s, Polarization::p})
            R += oracle::coherent_fast(stack, {kWavelengths[c], 50, p}).R / 2;
        CHECK_THAT(rgb[c], WithinAbs(R, 1e-13));
    }
}

TEST_CASE("Gaussian fits with the phases of BB17's Fresnel formulas") {
    // BB17's series to order 3 with the reflectances and phases of its supplemental code (after
    // Born and Wolf), which uses different formulas from core; evaluated separately, X, Y, Z
    // relative to a mirror
    struct Golden {
        Stack stack;
        double angle_deg;
        Triple xyz;
    };
    const std::vector<Golden> goldens{
        {film(1.5, 525, 1.09), 0, {0.088635044655, 0.051972110744, 0.093738630049}},
        {film(1.5, 525, 1.09), 70, {0.119593950855, 0.185274888491, 0.231721794863}},
        {film(1.33, 600, {1.5, 3}), 0, {0.547463856844, 0.572294175367, 0.502997413402}},
        {film(1.33, 600, {1.5, 3}), 60, {0.582438508465, 0.547574662930, 0.543581603340}},
        {film(1.33, 550, {1.9, 1.5}), 45, {0.255428975371, 0.193633914320, 0.262372767694}},
    };
    for (const Golden& golden : goldens) {
        const StackColor got = color(golden.stack, golden.angle_deg, color_method("gaussian"));
        CHECK(largest_error(relative(got.xyz), golden.xyz) < 1e-11);
    }
}

TEST_CASE("glTF's formulas give what its extension prints") {
    // KHR_materials_iridescence evaluated separately, linear sRGB; its XYZ_TO_REC709 is rounded
    const Triple dielectric = linear_srgb(color(film(1.5, 525, 1.09), 0, color_method("gltf")).xyz);
    CHECK(largest_error(dielectric, {0.146803804189, 0.018704725455, 0.098654213775}) < 5e-5);
    const Triple metal =
        linear_srgb(color(film(1.33, 600, {1.5, 3}), 60, color_method("gltf")).xyz);
    CHECK(largest_error(metal, {0.769013609716, 0.517782146708, 0.475215339168}) < 5e-5);
}

TEST_CASE("glTF's base colour is that of the bare base") {
    const auto over = [](std::string_view metal) {
        StackBuilder b;
        b.add(b.layer(1.3, 250));
        return b.over_material(b.material(find_material(metal).value().material));
    };
    const auto with_base = [](const Stack& stack, const std::optional<Triple>& base) {
        const double angle_deg = 30;
        StackColor result;
        ColorMethod method = color_method("gltf");
        method.base_color = base;
        (*color_algorithm(d65_tables(), stack, method, {}))(stack, {&angle_deg, 1}, {&result, 1});
        return result.xyz;
    };
    for (const char* const metal : {"Au", "Cu", "Ag"}) {
        StackBuilder b;
        const Stack bare = b.over_material(b.material(find_material(metal).value().material));
        Triple base = linear_srgb(exact(bare, 0));
        for (double& component : base) component = std::clamp(component, 0.0, 1.0);
        CAPTURE(metal);
        CHECK(largest_error(with_base(over(metal), {}), with_base(over(metal), base)) < 1e-5);
    }
    // a grey one: F0 of 1.5 + 3i
    const Stack boar = film(1.33, 600, {1.5, 3});
    const double F0 = std::norm((Complex(1.5, 3) - 1.0) / (Complex(1.5, 3) + 1.0));
    CHECK(largest_error(with_base(boar, {}), with_base(boar, Triple{F0, F0, F0})) < 1e-14);

    // over gold, whose red is 1, which flips the phase
    double sum = 0, count = 0;
    const Triple& white = d65_tables().sensitivity().white();
    for (double nm = 100; nm <= 400; nm += 50) {
        Stack stack = over("Au");
        std::get<Layer>(stack.elements.front().value).thickness_nm = nm;
        for (const double angle : {0.0, 20.0, 40.0, 60.0, 85.0}) {
            sum += ciede2000(lab(color(stack, angle, color_method("gltf")).xyz, white),
                             lab(exact(stack, angle), white));
            ++count;
        }
    }
    CHECK_THAT(sum / count, WithinAbs(11.6, 1.5));

    for (const Triple& bad : {Triple{-0.1, 0, 0}, Triple{0, 1.1, 0}, Triple{0, 0, NAN}})
        CHECK_THROWS_WITH(with_base(boar, bad), Contains("base colour must be in [0, 1]"));
    ColorMethod naive = color_method("naive");
    naive.base_color = Triple{1, 1, 1};
    CHECK_THROWS_WITH(color_algorithm(d65_tables(), boar, naive, {}),
                      "method naive takes no base colour");
}

TEST_CASE("approximations err as much as they are known to") {
    const auto mean_difference = [](std::string_view name, const ColorMethod& method) {
        double sum = 0, count = 0;
        for (const ColorCase& one : color_cases()) {
            if (one.name != name) continue;
            for (const ColorFamily& family : color_families(one, 100, 5)) {
                const Stack& stack = family.variants.front();
                const double angle = family.angles_deg.front();
                const Triple& white = d65_tables().sensitivity().white();
                sum += ciede2000(lab(color(stack, angle, method).xyz, white),
                                 lab(exact(stack, angle), white));
                ++count;
            }
        }
        REQUIRE(count == 100);
        return sum / count;
    };
    // mean CIEDE2000
    CHECK_THAT(mean_difference("dielectric", color_method("gaussian")), WithinAbs(1, 0.4));
    CHECK_THAT(mean_difference("conductor", color_method("gaussian")), WithinAbs(1, 0.4));
    CHECK_THAT(mean_difference("dielectric", color_method("gltf")), WithinAbs(2.7, 1));
    CHECK_THAT(mean_difference("conductor", color_method("gltf")), WithinAbs(7, 2));
    CHECK_THAT(mean_difference("dielectric", color_method("smits")), WithinAbs(0.5, 0.3));
    CHECK_THAT(mean_difference("conductor", color_method("smits")), WithinAbs(7, 2));
    CHECK_THAT(mean_difference("conductor", color_method("naive")), WithinAbs(11, 3));
}

TEST_CASE("total reflection at the film and polarized light") {
    const Stack stack = film(1.2, 300, 1.5, 1.6);
    for (const std::string_view method : {"gaussian", "gltf"})
        CHECK(color(stack, 60, color_method(method)).xyz == d65_tables().sensitivity().white());
    // not all beams of a thin gap are totally reflected
    CHECK(color(film(1.2, 20, 1.6, 1.6), 60, color_method("smits")).xyz[1] < 0.5);
    for (const std::string_view method : {"gaussian", "smits"}) {
        ColorRequest s, p;
        s.light = Light::s;
        p.light = Light::p;
        const Stack boar = film(1.33, 600, {1.5, 3});
        const Triple of_s = color(boar, 70, color_method(method), s).xyz,
                     of_p = color(boar, 70, color_method(method), p).xyz;
        CHECK(of_s[1] > of_p[1] + 0.2);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK_THAT(color(boar, 70, color_method(method)).xyz[c],
                       WithinAbs((of_s[c] + of_p[c]) / 2, 1e-6));
    }
}

TEST_CASE("materials hold their end values") {
    Material coarse;
    coarse.name = "coarse";
    coarse.model = RefractiveIndex{Table{{400, 700}, {1.4, 1.6}}, Constant{0}};
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(coarse), 300));
    const Stack stack = b.over(1.8);
    CHECK(largest_error(color(stack, 20, color_method("equal", 4701)).xyz, exact(stack, 20)) <
          1e-7);
    for (const std::string_view method : kFilmMethods)
        CHECK(largest_error(color(stack, 20, color_method(method)).xyz, exact(stack, 20)) < 0.05);
}

TEST_CASE("approximations refuse stacks that they do not suit", "[refused]") {
    const auto error = [](const Stack& stack, const ColorMethod& method,
                          ColorRequest request = {}) {
        try {
            color_algorithm(d65_tables(), stack, method, request);
        } catch (const DomainError& e) {
            return std::string(e.what());
        }
        return std::string("taken");
    };
    StackBuilder b;
    b.add(b.layer(1.5, 100));
    b.add(b.layer(1.7, 100));
    const Stack two = b.over(1.3), one = film(1.5, 300, 1.3);
    Stack thick = one, spread = one, grouped = one;
    std::get<Layer>(thick.elements[0].value).coherent = false;
    std::get<Layer>(spread.elements[0].value).thickness_sigma_nm = 3;
    grouped.elements = {StackBuilder::group(2, one.elements)};
    ColorRequest through, s;
    through.sides = {Side::reflected, Side::transmitted};
    s.light = Light::s;
    for (const std::string_view method : kFilmMethods) {
        CHECK(error(one, color_method(method)) == "taken");
        for (const Stack& stack : {two, thick, spread, grouped})
            CHECK_THAT(error(stack, color_method(method)), Contains("must have one coherent film"));
        CHECK_THAT(error(one, color_method(method), through),
                   Contains("must have reflected light only"));
    }
    CHECK(error(two, color_method("equal", 2), through) == "taken");
    CHECK(error(film({1.5, 0.1}, 300, 1.3), color_method("gltf")) ==
          "method gltf must have a film that does not absorb (got k = 0.1 at 550 nm)");
    CHECK(error(film({1.5, 0.1}, 300, 1.3), color_method("smits")) == "taken");
    CHECK(error(one, color_method("gltf"), s) == "method gltf must have unpolarized light (got s)");
    CHECK(error(one, color_method("equal", 1)) ==
          "equal wavelengths must be in [2, 1e+06] (got 1)");
    CHECK(error(one, color_method("equal", 1000001)) ==
          "equal wavelengths must be in [2, 1e+06] (got 1000001)");
    Material narrow;
    narrow.name = "narrow";
    narrow.model = RefractiveIndex{Table{{500, 600}, {1.4, 1.5}}, Constant{0}};
    StackBuilder n;
    n.add(StackBuilder::layer_of(n.material(narrow), 300));
    for (const std::string_view method : kAll)
        CHECK(error(n.over(1.5), color_method(method, 8)) ==
              "narrow must be known from 400 to 700 nm (got 500 to 600 nm)");
    // an illuminant that is dark at the few wavelengths
    const ColorTables dark(Sensitivity(observer(2), Table{{380, 500, 600, 780}, {0, 1, 1, 0}}));
    CHECK_THROWS_WITH(color_algorithm(dark, one, color_method("equal", 2), {}),
                      "equal/N: N must be larger for this illuminant (got 2)");
}
