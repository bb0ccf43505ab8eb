#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/error.hpp"

using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;
using namespace irido;

namespace {

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double power_at(const Table& table, double wavelength_nm) {
    const auto& rows = table.wavelength_nm;
    if (wavelength_nm < rows.front() || wavelength_nm > rows.back()) return 0;
    const auto after = std::lower_bound(rows.begin(), rows.end(), wavelength_nm);
    const auto i = static_cast<std::size_t>(after - rows.begin());
    if (*after == wavelength_nm) return table.value[i];
    const double t = (wavelength_nm - rows[i - 1]) / (rows[i] - rows[i - 1]);
    return std::lerp(table.value[i - 1], table.value[i], t);
}

struct Sum {
    int first_nm, last_nm, step_nm;
};
constexpr Sum kFine{360, 830, 1};
constexpr Sum kPublished{380, 780, 5};

std::array<double, 2> chromaticity(std::string_view name, int degrees, const Sum& range) {
    const Table table = illuminant(name);
    const Observer& eye = observer(degrees);
    double x = 0, y = 0, z = 0;
    for (int l = range.first_nm; l <= range.last_nm; l += range.step_nm) {
        const auto row = static_cast<std::size_t>(l - 360);
        const double power = power_at(table, l);
        x += power * eye.x[row];
        y += power * eye.y[row];
        z += power * eye.z[row];
    }
    return {x / (x + y + z), y / (x + y + z)};
}

void check_observer(const Observer& eye, std::array<double, 3> sums, double peak_nm) {
    INFO(eye.name);
    CHECK(eye.x.size() == kObserverRows);
    CHECK(eye.y.size() == kObserverRows);
    CHECK(eye.z.size() == kObserverRows);
    // Sums of the printed digits; 471 additions lose at most 471 * 107 * 2^-53 = 6e-12.
    CHECK_THAT(sum(eye.x), WithinAbs(sums[0], 1e-11));
    CHECK_THAT(sum(eye.y), WithinAbs(sums[1], 1e-11));
    CHECK_THAT(sum(eye.z), WithinAbs(sums[2], 1e-11));
    for (const auto& curve : {eye.x, eye.y, eye.z}) CHECK(std::ranges::min(curve) >= 0);
    const auto peak = std::ranges::max_element(eye.y) - eye.y.begin();
    CHECK(kFirstRow_nm + static_cast<double>(peak) == peak_nm);
}

}  // namespace

TEST_CASE("observers hold the tables of CIE 15 and ISO/CIE 11664-1", "[color]") {
    // Sums over the rows in exact decimal arithmetic.
    check_observer(observer(2), {106.865469489595, 106.856917101172, 106.892251278636}, 555);
    check_observer(observer(10), {116.648519508908, 116.661877102312, 116.673980514647}, 557);
    CHECK(std::ranges::max(observer(2).y) == 1);
    CHECK(observer(2).name == "CIE 1931");
    CHECK(observer(10).name == "CIE 1964");
    // First, last and one inner row as printed.
    CHECK(observer(2).x.front() == 0.0001299);
    CHECK(observer(2).y[460 - 360] == 0.06);
    CHECK(observer(2).z[460 - 360] == 1.6692);
    CHECK(observer(10).z.front() == 0.000000535027);
    CHECK(observer(10).z.back() == 0);
}

TEST_CASE("observer curves are smooth: a mistyped row would stand out", "[color]") {
    // Fourth differences amplify an error in one row by a factor of 6. The largest one is the kink
    // of the published 10-degree ybar near 490 nm.
    for (const int degrees : {2, 10}) {
        const Observer& eye = observer(degrees);
        for (const auto& c : {eye.x, eye.y, eye.z}) {
            double largest = 0;
            for (std::size_t i = 2; i + 2 < c.size(); ++i) {
                const double d = c[i - 2] - 4 * c[i - 1] + 6 * c[i] - 4 * c[i + 1] + c[i + 2];
                largest = std::max(largest, std::abs(d));
            }
            CHECK(largest < 4e-3);
        }
    }
}

TEST_CASE("only two observers are known", "[color]") {
    for (const int degrees : {0, -2, 5, 1931}) {
        CHECK_THROWS_AS(observer(degrees), DomainError);
        CHECK_THROWS_WITH(observer(degrees), Contains("observer must be 2 or 10") &&
                                                 Contains(std::to_string(degrees)));
    }
}

TEST_CASE("illuminants are valid tables", "[color]") {
    CHECK(illuminant_names().size() == 6);
    for (const std::string_view name : illuminant_names()) {
        INFO(name);
        const Table table = illuminant(name);
        REQUIRE(table.wavelength_nm.size() == table.value.size());
        CHECK(std::ranges::adjacent_find(table.wavelength_nm, std::greater_equal{}) ==
              table.wavelength_nm.end());
        CHECK(std::ranges::min(table.value) > 0);
        const bool fluorescent = name.starts_with("FL");
        CHECK(table.wavelength_nm.front() == (fluorescent ? 380 : 300));
        CHECK(table.wavelength_nm.back() == (fluorescent ? 780 : 830));
        if (!fluorescent) CHECK_THAT(power_at(table, 560), WithinRel(100.0, 1e-15));
    }
}

TEST_CASE("illuminant A follows its formula in full precision", "[color]") {
    const Table a = illuminant("A");
    CHECK(a.value.size() == 531);
    // 17 digits from 30-digit arithmetic. The exponent, up to 17, carries two roundings of 2^-53,
    // which exp turns into a relative 17 * 2 * 1.1e-16 = 4e-15.
    CHECK_THAT(power_at(a, 300), WithinRel(0.93048270561648393, 4e-15));
    CHECK_THAT(power_at(a, 400), WithinRel(14.708038449875502, 4e-15));
    CHECK_THAT(power_at(a, 700), WithinRel(198.261223231287, 4e-15));
    CHECK_THAT(power_at(a, 830), WithinRel(261.60233976557685, 4e-15));
}

TEST_CASE("5 nm sums give the chromaticities of CIE 15", "[color]") {
    struct Published {
        std::string_view name;
        int degrees;
        double x, y;
        double rounding;
    };
    // CIE 15, Colorimetry: sums over 380 to 780 nm in steps of 5 nm, printed to 5 or 4 decimals.
    const Published rows[] = {
        {"D65", 2, 0.31272, 0.32903, 5e-6},  {"D50", 2, 0.34567, 0.35851, 5e-6},
        {"A", 2, 0.44758, 0.40745, 5e-6},    {"E", 2, 0.33333, 0.33333, 5e-6},
        {"FL2", 2, 0.3721, 0.3751, 5e-5},    {"FL11", 2, 0.3805, 0.3769, 5e-5},
        {"D65", 10, 0.31381, 0.33098, 5e-6}, {"D50", 10, 0.34773, 0.35952, 5e-6},
        {"A", 10, 0.45117, 0.40594, 5e-6},   {"E", 10, 0.3333, 0.3333, 5e-5},
    };
    for (const Published& row : rows) {
        INFO(row.name << ", " << row.degrees << " degrees");
        const auto [x, y] = chromaticity(row.name, row.degrees, kPublished);
        CHECK_THAT(x, WithinAbs(row.x, row.rounding));
        CHECK_THAT(y, WithinAbs(row.y, row.rounding));
    }
}

TEST_CASE("1 nm sums agree with 30-digit arithmetic", "[color]") {
    struct Reference {
        std::string_view name;
        int degrees;
        double x, y;
    };
    const Reference rows[] = {
        {"D65", 2, 0.3127269319, 0.3290232210},  {"D65", 10, 0.3138237048, 0.3309989948},
        {"D50", 2, 0.3456842005, 0.3585041001},  {"D50", 10, 0.3477476667, 0.3595360964},
        {"A", 2, 0.4475735486, 0.4074393927},    {"A", 10, 0.4511739639, 0.4059365611},
        {"E", 2, 0.3333143808, 0.3332877058},    {"E", 10, 0.3332963616, 0.3333345278},
        {"FL2", 2, 0.3720848891, 0.3752895998},  {"FL2", 10, 0.3792515323, 0.3673346623},
        {"FL11", 2, 0.3805179603, 0.3771258732}, {"FL11", 10, 0.3854092841, 0.3712251224},
    };
    for (const Reference& row : rows) {
        INFO(row.name << ", " << row.degrees << " degrees");
        const auto [x, y] = chromaticity(row.name, row.degrees, kFine);
        CHECK_THAT(x, WithinAbs(row.x, 6e-11));  // rounding of the figures above
        CHECK_THAT(y, WithinAbs(row.y, 6e-11));
    }
}

TEST_CASE("an unknown illuminant is refused with the names", "[color]") {
    for (const char* name : {"", "d65", "D55", "D65 "}) {
        CHECK_THROWS_AS(illuminant(name), DomainError);
        CHECK_THROWS_WITH(illuminant(name), Contains("D65, D50, A, E, FL2, FL11") &&
                                                Contains("(got '" + std::string(name) + "')"));
    }
}
