#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/error.hpp"
#include "core/stack/builder.hpp"
#include "tests/support/d65_tables.hpp"

using namespace irido;
using Catch::Matchers::Contains;
using test::d65_tables;

namespace {

Stack mirror(double n1, double d1, double n2, double d2, std::uint64_t repeat = 20) {
    StackBuilder b(n1);
    b.add(StackBuilder::group(repeat, {b.layer(n1, d1), b.layer(n2, d2)}));
    return b.over(n1);
}

StackColor color(const Stack& stack, double angle_deg, std::size_t subdivisions,
                 const ColorRequest& request = {}) {
    return stack_color(d65_tables(), stack, color_method("landmarks", subdivisions), request,
                       std::span(&angle_deg, 1))
        .front();
}

/// FPB24 eq. 15 from the public list of landmarks and the sensitivity's own integrals, s = 1.
///   n1, d1        index and thickness in nm of the first layer
///   n2, d2        the same of the second
///   angle_deg     angle of incidence, degrees
///   polarization  s or p
Triple by_list(double n1, double d1, double n2, double d2, double angle_deg,
               Polarization polarization) {
    const double cos_theta = cos_of_incidence(angle_deg);
    const BraggPeriod period = bragg_period({n1, d1}, {n2, d2}, n1, cos_theta, polarization);
    const auto at = [&](double) { return period; };
    const double R12 = std::pow((n1 - n2) / (n1 + n2), 2), w0 = 0.735 * R12 + 0.532;
    const double weight = w0 + (1 - w0) * std::pow(1 - cos_theta, 5);
    const double turn = 2 * std::numbers::pi;
    std::vector<double> ends;
    for (const Landmark& mark : landmarks(at, {turn / 20000, turn / 150}))
        if (mark.kind != LandmarkKind::mode) ends.push_back(mark.omega_per_nm);
    Triple sum{};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = (ends[i] + ends[i + 1]) / 2;
        const double a = middle * period.path1_nm, b = middle * period.path2_nm;
        const double q = period.admittance_ratio;
        const double cosine =
            std::cos(a) * std::cos(b) - (q + 1 / q) / 2 * std::sin(a) * std::sin(b);
        const double C2 = std::pow((q - 1 / q) / 2 * std::sin(b), 2);
        const double height = std::abs(cosine) > 1 ? 1 : weight * C2 / (C2 + 1 - cosine * cosine);
        const double first = std::max(360.0, turn / ends[i + 1]);
        const double last = std::min(830.0, turn / ends[i]);
        if (!(first < last)) continue;
        const Triple part = d65_tables().sensitivity().integral({first, last});
        for (std::size_t c = 0; c < 3; ++c) sum[c] += height * part[c];
    }
    return sum;
}

}  // namespace

TEST_CASE("landmark colours are FPB24's sum over the list of landmarks", "[landmark_color]") {
    struct Case {
        double n1, d1, n2, d2, angle;
    };
    for (const auto& [n1, d1, n2, d2, angle] :
         {Case{1, 101, 1.5, 143, 0}, Case{1, 101, 1.5, 143, 65}, Case{1, 494, 1.5, 494, 30},
          Case{1.4, 80, 1.9, 200, 20}, Case{1, 315, 1.5, 315, 80}}) {
        const Stack stack = mirror(n1, d1, n2, d2);
        CAPTURE(d1, d2, angle);
        CHECK(largest_difference(color(stack, angle, 1, {.light = Light::s}).xyz,
                                 by_list(n1, d1, n2, d2, angle, Polarization::s)) < 1e-8);
        CHECK(largest_difference(color(stack, angle, 1, {.light = Light::p}).xyz,
                                 by_list(n1, d1, n2, d2, angle,
                                         angle == 0 ? Polarization::s : Polarization::p)) < 1e-8);
    }
}

TEST_CASE("s and p are averaged, T is the rest", "[landmark_color]") {
    const Stack stack = mirror(1, 120, 1.6, 130);
    const Triple s = color(stack, 50, 3, {.light = Light::s}).xyz;
    const Triple p = color(stack, 50, 3, {.light = Light::p}).xyz;
    const Triple u = color(stack, 50, 3).xyz;
    const Triple T = color(stack, 50, 3, {.sides = {Side::transmitted}}).xyz;
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(u[c] == Approx((s[c] + p[c]) / 2));
        CHECK(u[c] + T[c] == Approx(d65_tables().sensitivity().white()[c]));
    }
}

TEST_CASE("a gap wider than the visible range is white to landmarks", "[landmark_color]") {
    CHECK(largest_difference(color(mirror(1, 137, 60, 2.3), 0, 1).xyz,
                             d65_tables().sensitivity().white()) < 1e-14);
    CHECK(color(mirror(1, 100, 1.5, 100), 90, 1).xyz == d65_tables().sensitivity().white());
}

TEST_CASE("layers of one index have no boxes that reflect", "[landmark_color]") {
    for (const std::size_t s : {1U, 4U})
        CHECK(largest_difference(color(mirror(1.4, 100, 1.4, 150), 20, s).xyz, {}) < 1e-12);
}

TEST_CASE("subdivision adds boxes, most below the first gaps", "[landmark_color]") {
    const Stack stack = mirror(1, 122, 1.5, 122);
    std::size_t before = 0;
    for (std::size_t s = 2; s <= 5; ++s) {
        const StackColor got = color(stack, 0, s);
        CHECK(got.evaluations > before);
        CHECK(std::isinf(got.error));
        before = got.evaluations;
    }
    // very fine boxes give the envelope times one weight, independent of their number
    CHECK(largest_difference(color(stack, 0, 500).xyz, color(stack, 0, 1000).xyz) < 1e-5);
}

TEST_CASE("landmark colours do not see the number of periods", "[landmark_color]") {
    CHECK(color(mirror(1, 101, 1.5, 143, 2), 30, 3).xyz ==
          color(mirror(1, 101, 1.5, 143, 1000), 30, 3).xyz);
}

TEST_CASE("landmark colours refuse what is no mirror", "[landmark_color][refused]") {
    CHECK_THROWS_WITH(color(mirror(1, 100, 1.5, 100), 0, 0), Contains("subdivisions must be in"));
    StackBuilder b(1.0);
    b.add(b.layer(1.5, 300));
    CHECK_THROWS_WITH(color(b.over(1), 0, 1), Contains("method landmarks needs one group of two"));
    StackBuilder total(1.5);
    total.add(StackBuilder::group(4, {total.layer(1.5, 100), total.layer(1.2, 80)}));
    CHECK_THROWS_WITH(color(total.over(1.5), 60, 1), Contains("critical angle"));
}
