#include <catch2/catch.hpp>
#include <cmath>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/math/angle_of_cosine.hpp"
#include "core/math/random.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "tables/lut/lut_maker.hpp"

using namespace irido;
using namespace irido::tables;

namespace {

struct VariedExpression {
    std::string stack, path;
};

LutRequest request_of(const VariedExpression& varied, double first, double last,
                      const char* space) {
    LutRequest request;
    request.source = schemas::load_stack({varied.stack, {}});
    request.document = schemas::read_stack({varied.stack, {}});
    request.sensitivity = std::make_shared<Sensitivity>(observer(2), illuminant("D65"));
    request.illuminant = "D65";
    request.observer = std::string("2");
    request.space = &rgb_space(space);
    request.options["cos"] = equally_spaced(0.05, 1, 4);
    request.vary = {{varied.path, equally_spaced(first, last, 5)}};
    return request;
}

const std::vector<VariedExpression>& expressions() {
    static const std::vector<VariedExpression> all{
        {"1 | 1.5@0 | 1.9+2.5i", "layers.0.thickness_nm"},
        {"1 | (2.3@60 | 1.46@94)^20 | 1.52", "layers.0.layers.0.thickness_nm"},
        {"1 | (2.3@60 | 1.46@94)^6 | 1.46@300 | (2.3@60 | 1.46@94)^6 | 1.52",
         "layers.1.thickness_nm"},
        {"1 | 1.38@90 | 2.1@60 | 1.6@80 | 2.3@50 | 1.4@120 | 1.9@70 | 2.2@90 | 1.52",
         "layers.3.thickness_nm"},
        {"1 | (2.3+0.01i@60 | 1.46+0.002i@94)^10 | 1.9+1.5i", "layers.0.layers.0.thickness_nm"},
        {"air | TiO2@35 | Ti", "layers.0.thickness_nm"},
        {"air | TiO2@38 | Ag@11 | TiO2@34 | BK7", "layers.0.thickness_nm"},
        {"air | MgF2@40 | TiO2@52 | MgF2@64 | TiO2@76 | BK7", "layers.1.thickness_nm"},
        {"air | (TiO2@58 | SiO2@94)^12 | BK7", "layers.0.layers.1.thickness_nm"}};
    return all;
}

}  // namespace

TEST_CASE("rows of tables of colours are the stack's colours within the stated tolerance",
          "[lut][slow]") {
    Random random(7);
    for (const VariedExpression& varied : expressions()) {
        const double first = 20 + random.uniform(0, 40), last = first + random.uniform(0, 60);
        CAPTURE(varied.stack, first, last);
        const LutRequest request = request_of(varied, first, last, "xyz");
        const LutKind& kind = *find_lut_kind("color");
        LutMaking making;
        making.type = LutType::f64;
        const Lut lut = make_lut(kind, kind.plan(request), making);
        const double tolerance = lut.facts["request"]["color_tolerance"];
        const ColorTables tables(*request.sensitivity);
        const schemas::VariedStack stacks(request.source, {varied.path});
        for (std::size_t v = 0; v < 5; ++v) {
            const Stack stack = stacks.at(std::span(&request.vary[0].values[v], 1));
            for (std::size_t i = 0; i < 4; ++i) {
                const double angle_deg = angle_of_cosine(request.list("cos")[i]);
                const StackColor exact = stack_color(tables, stack, color_method("quadrature"),
                                                     {.tolerance = 1e-9}, std::span(&angle_deg, 1))
                                             .front();
                const double* const value = lut.values.data() + (i * 5 + v) * 3;
                CHECK(largest_difference({value[0], value[1], value[2]}, exact.xyz) <=
                      tolerance + exact.error);
            }
        }
    }
}

TEST_CASE("rough colours of trials miss by no more than they may", "[lut]") {
    Random random(8);
    for (const VariedExpression& varied : expressions()) {
        const double first = 20 + random.uniform(0, 40), last = first + random.uniform(0, 60);
        CAPTURE(varied.stack, first, last);
        const LutRequest request = request_of(varied, first, last, "srgb");
        const LutPlan plan = find_lut_kind("color")->plan(request);
        const std::vector<LutAxis> axes{plan.axes[0].axis, plan.axes[1].axis};
        const std::vector<double> exact = plan.evaluate(axes);
        for (const double error : {0.5, 0.05, 0.005}) {
            const std::vector<double> rough = plan.roughly(error)(axes);
            for (const double d : plan.measure.differences(axes, exact, rough)) CHECK(d <= error);
        }
    }
}
