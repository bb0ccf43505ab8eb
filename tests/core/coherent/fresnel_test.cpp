#include "core/coherent/fresnel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/math/constants.hpp"
#include "core/math/random.hpp"

using namespace irido;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Both {
    FresnelFace<Complex> s, p;
};

Both face(double n1, Complex n2, IncidentAngle incidence) {
    const Ray<double> a{n1 * n1, n1 * incidence.cos};
    const Ray<Complex> b = outgoing_ray(medium(n2, n1, incidence));
    const Complex difference = (n1 - n2) * (n1 + n2);
    const double S = n1 * incidence.sin;
    return {fresnel_s(a, b, difference), fresnel_p(a, b, difference, S * S)};
}

}  // namespace

TEST_CASE("faces of transparent media keep all power", "[fresnel]") {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double n1 = random.uniform(1, 4), n2 = random.uniform(1, 4);
        const Both both = face(n1, n2, incident_angle(random.uniform(0, 90)));
        CHECK_THAT(std::norm(both.s.r) + both.s.T, WithinAbs(1, 4e-15));
        CHECK_THAT(std::norm(both.p.r) + both.p.T, WithinAbs(1, 4e-15));
    }
}

TEST_CASE("faces at normal incidence, Brewster's angle and near grazing", "[fresnel]") {
    for (const double n2 : {1.2, 1.5, 3.0}) {
        const Both normal = face(1, n2, incident_angle(0));
        CHECK_THAT(std::norm(normal.s.r), WithinRel(normal_reflectance(1, n2), 1e-15));
        CHECK(std::abs(normal.s.r - normal.p.r) < 1e-16);
        const double brewster_deg = std::atan(n2) / kDegree;
        CHECK(std::norm(face(1, n2, incident_angle(brewster_deg)).p.r) < 1e-30);
        CHECK_THAT(std::norm(face(1, n2, incident_angle(89.9999)).s.r), WithinAbs(1, 1e-4));
    }
    const Both nearly = face(1.5, 1.5 * (1 + 1e-12), incident_angle(30));  // no loss of precision
    const double cosine = std::cos(30 * kDegree);
    CHECK_THAT(nearly.s.r.real(), WithinRel(-1e-12 / (2 * cosine * cosine), 1e-3));
}

TEST_CASE("both ways to write a face's amplitude agree", "[fresnel]") {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const double n1 = random.uniform(1, 2);
        const Complex n2{random.uniform(0.1, 4), random.uniform(0, 5)};
        const IncidentAngle incidence = incident_angle(random.uniform(0, 89));
        const Both both = face(n1, n2, incidence);
        const Medium above = medium(n1, n1, incidence), below = medium(n2, n1, incidence);
        CHECK(std::abs(face_amplitude(above, below, Polarization::s) - both.s.r) < 1e-13);
        CHECK(std::abs(std::abs(face_amplitude(above, below, Polarization::p)) -
                       std::abs(both.p.r)) < 1e-13);
    }
}

TEST_CASE("Schlick's reflectance ends where Fresnel's does", "[fresnel]") {
    const double R0 = normal_reflectance(1, 1.5);
    CHECK_THAT(R0, WithinRel(0.04, 1e-15));
    CHECK(schlick(R0, 1) == R0);
    CHECK(schlick(R0, 0) == 1);
    CHECK_THAT(schlick(R0, 0.5), WithinRel(0.04 + 0.96 / 32, 1e-15));
}
