#include "core/material/air.hpp"

#include <catch2/catch.hpp>

#include "core/material/library.hpp"

using namespace irido;
using Catch::Matchers::WithinAbs;

TEST_CASE("the index of air agrees with published values", "[air]") {
    // P. E. Ciddor, Appl. Opt. 35, 1566 (1996), table 1: dry air at 633 nm and 100 kPa; n - 1 is
    // proportional to the pressure to a few parts in 1e4.
    constexpr double kPressures = 101325.0 / 100000;
    CHECK_THAT(index_of_air(633, 20) - 1, WithinAbs(26824.4e-8 * kPressures, 5e-8));
    CHECK_THAT(index_of_air(633, 10) - 1, WithinAbs(27774.7e-8 * kPressures, 5e-8));
    CHECK_THAT(index_of_air(633, 30) - 1, WithinAbs(25937.2e-8 * kPressures, 5e-8));
    const Material air = find_material("air").value().material;
    for (const double nm : {200.0, 350.0, 589.3, 1064.0, 5000.0})
        CHECK_THAT(index_of_air(nm, 15), WithinAbs(index_at(air, nm).real(), 1e-15));
    CHECK_THROWS(index_of_air(500, 1000));
}

TEST_CASE("wavelengths in air and in vacuum are each other's", "[air]") {
    // The sodium lines in standard air and in vacuum, NIST: 588.9950 and 589.1583 nm.
    CHECK_THAT(vacuum_wavelength(588.9950, 15), WithinAbs(589.1583, 1e-4));
    for (const double nm : {150.0, 231.0, 400.0, 700.0, 2000.0, 1e5})
        CHECK_THAT(air_wavelength(vacuum_wavelength(nm, 22), 22), WithinAbs(nm, 1e-11 * nm));
}

TEST_CASE("a formula and a table in air are taken to vacuum alike", "[air]") {
    const Reference air{true, true, 20};
    const std::vector<double> cauchy{1.5, 0.004, -2};
    const Material formula{"f", RefractiveIndex{Formula{5, cauchy, {300, 900}, air}}, {}};
    const Material plain{"p", RefractiveIndex{Formula{5, cauchy, {300, 900}}}, {}};
    Table rows{{400, 587.5618, 700}, {}};
    for (const double nm : rows.wavelength_nm) rows.value.push_back(index_at(plain, nm).real());
    const Table table = in_vacuum(rows, air, true);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(table.wavelength_nm[i] == vacuum_wavelength(rows.wavelength_nm[i], 20));
        CHECK_THAT(index_at(formula, table.wavelength_nm[i]).real(),
                   WithinAbs(table.value[i], 1e-15));
        CHECK_THAT(table.value[i] / rows.value[i], WithinAbs(1.00027, 1.2e-5));
    }
    const Table k = in_vacuum(Table{{400, 700}, {1e-8, 2e-8}}, air, false);
    CHECK(k ==
          Table{{400, vacuum_wavelength(400, 20), vacuum_wavelength(700, 20)}, {1e-8, 1e-8, 2e-8}});
}

TEST_CASE("catalogue glasses among the built-in materials are converted", "[air]") {
    // n_d from SCHOTT's data sheets at the line's wavelength in air, times the index of air.
    const double d_line = vacuum_wavelength(587.5618, 20), air = index_of_air(d_line, 20);
    struct Glass {
        const char* name;
        double nd;
    };
    for (const auto& [name, nd] : {Glass{"BK7", 1.51680}, {"SF11", 1.78472}, {"N-SF11", 1.78472}}) {
        const LibraryMaterial glass = find_material(name).value();
        CHECK_THAT(index_at(glass.material, d_line).real(), WithinAbs(nd * air, 5e-6));
        CHECK(glass.source.find("converted to vacuum") != std::string::npos);
    }
}
