#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/colorimetry/space.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"

using Catch::Contains;
using Catch::WithinAbs;
using namespace irido;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr ColorMatrix kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Triple times(const ColorMatrix& m, const Triple& v) {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    }
    return result;
}

ColorMatrix product(const ColorMatrix& a, const ColorMatrix& b) {
    ColorMatrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
        }
    }
    return result;
}

void check_close(const Triple& got, const Triple& expected, double tolerance) {
    for (std::size_t i = 0; i < 3; ++i) CHECK_THAT(got[i], WithinAbs(expected[i], tolerance));
}

void check_close(const ColorMatrix& got, const ColorMatrix& expected, double tolerance) {
    for (std::size_t i = 0; i < 3; ++i) check_close(got[i], expected[i], tolerance);
}

/// White from sums over the 5 nm rows from 380 to 780 nm, Y = 1.
Triple white(std::string_view name, int degrees) {
    const Table table = illuminant(name);
    const Observer& eye = observer(degrees);
    Triple sum{};
    for (std::size_t i = 0, row = 20; row <= 420; row += 5) {
        const double wavelength_nm = kFirstRow_nm + static_cast<double>(row);
        while (i + 1 < table.value.size() && table.wavelength_nm[i + 1] <= wavelength_nm) ++i;
        sum[0] += table.value[i] * eye.x[row];
        sum[1] += table.value[i] * eye.y[row];
        sum[2] += table.value[i] * eye.z[row];
    }
    return {sum[0] / sum[1], 1, sum[2] / sum[1]};
}

}  // namespace

TEST_CASE("matrices have the digits of their standards", "[color]") {
    SECTION("srgb: IEC 61966-2-1, four decimals") {
        check_close(
            xyz_from_rgb(rgb_space("srgb")),
            {{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, 5e-5);
    }
    SECTION("rec2020: ITU-R BT.2407 forward, BT.2124 annex 2 inverse") {
        check_close(xyz_from_rgb(rgb_space("rec2020")),
                    {{{0.6370, 0.1446, 0.1689}, {0.2627, 0.6780, 0.0593}, {0.0, 0.0281, 1.0610}}},
                    5e-5);
        check_close(rgb_from_xyz(rgb_space("rec2020")),
                    {{{1.716651187971268, -0.355670783776392, -0.253366281373660},
                      {-0.666684351832489, 1.616481236634939, 0.0157685458139111},
                      {0.017639857445311, -0.042770613257809, 0.942103121235474}}},
                    2e-15);
    }
    SECTION("display-p3: SMPTE EG 432-1, ten decimals") {
        check_close(xyz_from_rgb(rgb_space("display-p3")),
                    {{{0.4865709486, 0.2656676932, 0.1982172852},
                      {0.2289745641, 0.6917385218, 0.0792869141},
                      {0.0, 0.0451133819, 1.0439443689}}},
                    5.1e-11);
    }
    SECTION("acescg: Academy S-2014-004, ten decimals") {
        check_close(xyz_from_rgb(rgb_space("acescg")),
                    {{{0.6624541811, 0.1340042065, 0.1561876870},
                      {0.2722287168, 0.6740817658, 0.0536895174},
                      {-0.0055746495, 0.0040607335, 1.0103391003}}},
                    5.1e-11);
        check_close(rgb_from_xyz(rgb_space("acescg")),
                    {{{1.6410233797, -0.3248032942, -0.2364246952},
                      {-0.6636628587, 1.6153315917, 0.0167563477},
                      {0.0117218943, -0.0082844420, 0.9883948585}}},
                    5.1e-11);
    }
    SECTION("xyz is the identity, exactly") {
        CHECK(xyz_from_rgb(rgb_space("xyz")) == kIdentity);
        CHECK(rgb_from_xyz(rgb_space("xyz")) == kIdentity);
    }
}

TEST_CASE("matrices equal the exact fractions", "[color]") {
    // W3C, CSS Color Module Level 4, sample code for color conversions. All entries are below 4, so
    // the error is a few units of 2^-53 * 4.
    check_close(xyz_from_rgb(rgb_space("srgb")),
                {{{506752. / 1228815, 87881. / 245763, 12673. / 70218},
                  {87098. / 409605, 175762. / 245763, 12673. / 175545},
                  {7918. / 409605, 87881. / 737289, 1001167. / 1053270}}},
                2e-15);
    check_close(rgb_from_xyz(rgb_space("srgb")),
                {{{12831. / 3959, -329. / 214, -1974. / 3959},
                  {-851781. / 878810, 1648619. / 878810, 36519. / 878810},
                  {705. / 12673, -2585. / 12673, 705. / 667}}},
                2e-15);
    check_close(xyz_from_rgb(rgb_space("display-p3")),
                {{{608311. / 1250200, 189793. / 714400, 198249. / 1000160},
                  {35783. / 156275, 247089. / 357200, 198249. / 2500400},
                  {0, 32229. / 714400, 5220557. / 5000800}}},
                2e-15);
    check_close(rgb_from_xyz(rgb_space("display-p3")),
                {{{446124. / 178915, -333277. / 357830, -72051. / 178915},
                  {-14852. / 17905, 63121. / 35810, 423. / 17905},
                  {11844. / 330415, -50337. / 660830, 316169. / 330415}}},
                2e-15);
}

TEST_CASE("the two matrices of a space are inverse and map white to one", "[color]") {
    for (const std::string_view name : rgb_space_names()) {
        INFO(name);
        const RgbSpace& space = rgb_space(name);
        check_close(product(rgb_from_xyz(space), xyz_from_rgb(space)), kIdentity, 2e-15);
        check_close(times(xyz_from_rgb(space), {1, 1, 1}), space.white, 1e-15);
        check_close(times(rgb_from_xyz(space), space.white), {1, 1, 1}, 1e-15);
    }
}

TEST_CASE("Bradford adaptation between D65 and D50 as Lindbloom has it", "[color]") {
    // B. Lindbloom, "Chromatic Adaptation", seven decimals, with the whites of ASTM E308.
    const Triple d65{0.95047, 1, 1.08883};
    const Triple d50{0.96422, 1, 0.82521};
    check_close(bradford(d65, d50),
                {{{1.0478112, 0.0228866, -0.0501270},
                  {0.0295424, 0.9904844, -0.0170491},
                  {-0.0092345, 0.0150436, 0.7521316}}},
                5e-8);
    check_close(bradford(d50, d65),
                {{{0.9555766, -0.0230393, 0.0631636},
                  {-0.0282895, 1.0099416, 0.0210077},
                  {0.0122982, -0.0204830, 1.3299098}}},
                5e-8);
    check_close(times(bradford(d65, d50), d65), d50, 1e-15);
    check_close(bradford(d65, d65), kIdentity, 1e-15);
    check_close(product(bradford(d50, d65), bradford(d65, d50)), kIdentity, 1e-15);
}

TEST_CASE("the adapted white is exactly one, black exactly zero", "[color]") {
    for (const std::string_view space : rgb_space_names()) {
        for (const std::string_view light : illuminant_names()) {
            for (const int degrees : {2, 10}) {
                INFO(space << ", " << light << ", " << degrees << " degrees");
                const Triple under = white(light, degrees);
                const RgbTransform rgb(rgb_space(space), under, Adaptation::bradford);
                CHECK(rgb(under) == Triple{1, 1, 1});
                CHECK(rgb({0, 0, 0}) == Triple{0, 0, 0});
                CHECK(in_gamut(rgb(under)));
            }
        }
    }
}

TEST_CASE("the adapted transform is the product of its matrices", "[color]") {
    const Triple under = white("FL11", 10);
    const Triple xyz{0.31, 0.42, 0.17};
    for (const std::string_view name : rgb_space_names()) {
        INFO(name);
        const RgbSpace& space = rgb_space(name);
        const Triple adapted = times(bradford(under, space.white), xyz);
        // Values of order 1, with some ten roundings of 2^-53 * 4 each.
        check_close(RgbTransform(space, under, Adaptation::bradford)(xyz),
                    times(rgb_from_xyz(space), adapted), 4e-15);
        const Triple back = times(bradford(space.white, under),
                                  times(xyz_from_rgb(space), times(rgb_from_xyz(space), adapted)));
        check_close(back, xyz, 4e-15);
    }
}

TEST_CASE("without adaptation the matrix alone acts", "[color]") {
    const Triple xyz{0.31, 0.42, 0.17};
    for (const std::string_view name : rgb_space_names()) {
        INFO(name);
        const RgbSpace& space = rgb_space(name);
        const RgbTransform rgb(space, white("A", 2), Adaptation::none);
        check_close(rgb(xyz), times(rgb_from_xyz(space), xyz), 1e-15);
        check_close(times(xyz_from_rgb(space), rgb(xyz)), xyz, 1e-15);
    }
    const RgbTransform none(rgb_space("xyz"), white("A", 2), Adaptation::none);
    CHECK(none(xyz) == xyz);
}

TEST_CASE("encoding curves at known points", "[color]") {
    const RgbSpace& srgb = rgb_space("srgb");
    const RgbSpace& rec2020 = rgb_space("rec2020");
    SECTION("ends, line and linear spaces") {
        for (const std::string_view name : rgb_space_names()) {
            CHECK(encoded(rgb_space(name), 0) == 0);
            CHECK_THAT(encoded(rgb_space(name), 1), WithinAbs(1, 3e-16));
            CHECK(encoded(rgb_space(name), 1) <= 1);
        }
        CHECK(encoded(srgb, 0.001) == 12.92 * 0.001);
        CHECK(encoded(rec2020, 0.001) == 4.5 * 0.001);
        CHECK(encoded(rgb_space("acescg"), 0.18) == 0.18);
        CHECK(encoded(rgb_space("xyz"), 0.18) == 0.18);
        CHECK(encoded(rgb_space("display-p3"), 0.18) == encoded(srgb, 0.18));
    }
    SECTION("the standards' decoding functions bring the value back") {
        for (double v = 0.02; v <= 1; v += 0.07) {
            const double s = (encoded(srgb, v) + 0.055) / 1.055;
            CHECK_THAT(std::pow(s, 2.4), WithinAbs(v, 1e-15));
            const double r = (encoded(rec2020, v) + 0.0993) / 1.0993;
            CHECK_THAT(std::pow(r, 1 / 0.45), WithinAbs(v, 3e-6));  // constants to 4 decimals
        }
    }
    SECTION("value and slope join") {
        // IEC 61966-2-1 rounds its constants: the sRGB branches differ by 3e-8 where they join.
        const double up = std::nextafter(0.0031308, 1);
        CHECK_THAT(encoded(srgb, up), WithinAbs(encoded(srgb, 0.0031308), 4e-8));
        const double beta = 0.01805396851080781;
        CHECK_THAT(encoded(rec2020, beta), WithinAbs(4.5 * beta, 3e-16));
        CHECK_THAT((encoded(rec2020, beta + 1e-7) - encoded(rec2020, beta)) / 1e-7,
                   WithinAbs(4.5, 2e-5));  // second derivative -137 times half the step
    }
    SECTION("only [0, 1] is encoded") {
        for (const double v : {-1e-300, 1 + 1e-15, kNan, kInfinity}) {
            CHECK_THROWS_AS(encoded(srgb, v), DomainError);
        }
    }
}

TEST_CASE("hex is encoded, clipped and rounded", "[color]") {
    const RgbSpace& srgb = rgb_space("srgb");
    CHECK(hex(srgb, {0, 0, 0}) == "#000000");
    CHECK(hex(srgb, {1, 1, 1}) == "#ffffff");
    CHECK(hex(srgb, {-0.5, 2, -0.0}) == "#00ff00");
    CHECK(hex(srgb, {kInfinity, -kInfinity, 1}) == "#ff00ff");
    // 8-bit levels whose linear values are ((level / 255 + 0.055) / 1.055)^2.4.
    CHECK(hex(srgb, {0.21586050011389923, 0.18, 0.5}) == "#8076bc");
    CHECK(hex(rgb_space("rec2020"), {0.18, 0.5, 0.01}) == "#68b40b");
    // Linear: 0.5 * 255 = 127.5 rounds up; 0.4999 stays below.
    CHECK(hex(rgb_space("xyz"), {0.5, 0.4999, 10.0 / 255}) == "#807f0a");
    CHECK_THROWS_AS(hex(srgb, {0, kNan, 0}), DomainError);
}

TEST_CASE("every 8-bit sRGB level survives the round trip", "[color]") {
    const RgbSpace& srgb = rgb_space("srgb");
    for (int level = 0; level < 256; ++level) {
        const double v = level / 255.0;
        const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        const std::string text = hex(srgb, {linear, 0, 1});
        CHECK(std::stoi(text.substr(1, 2), nullptr, 16) == level);
        CHECK(text.substr(3) == "00ff");
    }
}

TEST_CASE("a hex colour is decoded, and found again", "[color]") {
    for (const std::string_view name : rgb_space_names()) {
        const RgbSpace& space = rgb_space(name);
        for (int level = 0; level < 256; ++level) {
            const double v = level / 255.0;
            CHECK_THAT(encoded(space, decoded(space, v)), WithinAbs(v, 1e-14));
        }
        CHECK(hex(space, rgb_of_hex(space, "#5F3383")) == "#5f3383");
        CHECK(decoded(space, 0) == 0);
        CHECK(decoded(space, 1) == 1);
        CHECK_THROWS_AS(decoded(space, 1.01), DomainError);
    }
    for (const std::string_view text : {"", "#", "5f3383", "#5f338", "#5f33833", "#5g3383", "#fff"})
        CHECK_THROWS_AS(rgb_of_hex(rgb_space("srgb"), text), DomainError);
}

TEST_CASE("the transform to RGB has an inverse", "[color]") {
    const Triple white{1.1, 1, 0.4};
    for (const std::string_view name : rgb_space_names())
        for (const Adaptation adaptation : {Adaptation::bradford, Adaptation::none}) {
            const RgbTransform transform(rgb_space(name), white, adaptation);
            const Triple xyz{0.3, 0.2, 0.5}, back = transform.xyz_of(transform(xyz));
            for (std::size_t i = 0; i < 3; ++i) CHECK_THAT(back[i], WithinAbs(xyz[i], 1e-14));
        }
}

TEST_CASE("gamut is the closed unit cube", "[color]") {
    CHECK(in_gamut({0, 0.5, 1}));
    CHECK(in_gamut({-0.0, 0, 0}));
    CHECK_FALSE(in_gamut({-1e-17, 0, 0}));
    CHECK_FALSE(in_gamut({0, 1 + 1e-15, 0}));
    CHECK_FALSE(in_gamut({0, 0, kNan}));
}

TEST_CASE("unknown spaces and impossible whites are refused", "[color]") {
    for (const char* name : {"", "sRGB", "adobe-rgb"}) {
        CHECK_THROWS_AS(rgb_space(name), DomainError);
        CHECK_THROWS_WITH(rgb_space(name), Contains("srgb, rec2020, display-p3, acescg, xyz") &&
                                               Contains("(got '" + std::string(name) + "')"));
    }
    const RgbSpace& srgb = rgb_space("srgb");
    const auto adapted = [&](const Triple& under) {
        return RgbTransform(srgb, under, Adaptation::bradford);
    };
    // A single line at 480 nm: its long-wave cone response is below 0 (CIE 1931: 0.0956, 0.139,
    // 0.813, divided by Y).
    CHECK_THROWS_WITH(adapted({0.69, 1, 5.84}), Contains("cone response of the white"));
    CHECK_THROWS_WITH(adapted({0, 1, 0.5}), Contains("white XYZ must be in [1e-06, 1e+06]"));
    CHECK_THROWS_AS(adapted({0.95, kNan, 1.09}), DomainError);
    CHECK_THROWS_AS(adapted({kInfinity, 1, 1.09}), DomainError);
    CHECK_NOTHROW(RgbTransform(srgb, {0.69, 1, 5.84}, Adaptation::none));
}
