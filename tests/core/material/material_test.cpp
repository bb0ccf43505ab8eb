#include "core/material/material.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/material/air.hpp"
#include "core/material/library.hpp"

using namespace irido;
using Catch::Matchers::Equals;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Material with_formula(int number, std::vector<double> coefficients,
                      WavelengthRange range = kAllWavelengths) {
    return {"x", RefractiveIndex{Formula{number, std::move(coefficients), range}, Constant{0}},
            Outside::refuse};
}

Material with_tables(Table n, Dispersion k = Constant{0}) {
    return {"x", RefractiveIndex{std::move(n), std::move(k)}, Outside::refuse};
}

double n_of(const Material& material, double nm) {
    return index_at(material, nm).real();
}

std::string error_of(const Material& material, double nm) {
    try {
        index_at(material, nm);
    } catch (const DomainError& error) {
        return error.what();
    }
    return "no error";
}

Material built_in(std::string_view name) {
    return find_material(name).value().material;
}

}  // namespace

// --- dispersion formulas ---------------------------------------------------------------------

// The right-hand sides are written out in long double, term by term; they differ from the
// evaluation by loops and std::pow only by a few roundings of double.
constexpr double kFewRoundings = 4e-15;

TEST_CASE("formula 1 is Sellmeier with the poles as wavelengths", "[material]") {
    const long double l2 = 0.6L * 0.6L;
    const long double n2 = 1 + 0.1L + 0.5L * l2 / (l2 - 0.2L * 0.2L) + 0.3L * l2 / (l2 - 9.0L);
    CHECK_THAT(n_of(with_formula(1, {0.1, 0.5, 0.2, 0.3, 3}), 600),
               WithinRel(static_cast<double>(std::sqrt(n2)), kFewRoundings));
}

TEST_CASE("formula 2 is Sellmeier with squared poles, which may be negative", "[material]") {
    const long double l2 = 0.6L * 0.6L;
    const long double n2 = 1 + 0.1L + 0.5L * l2 / (l2 - 0.04L) + 0.3L * l2 / (l2 + 2.0L);
    CHECK_THAT(n_of(with_formula(2, {0.1, 0.5, 0.04, 0.3, -2}), 600),
               WithinRel(static_cast<double>(std::sqrt(n2)), kFewRoundings));
}

TEST_CASE("formula 3 is a polynomial for n^2", "[material]") {
    const long double l2 = 0.8L * 0.8L;
    const long double n2 = 2.2L - 0.01L * l2 + 0.02L / l2 + 0.003L / (l2 * l2);
    CHECK_THAT(n_of(with_formula(3, {2.2, -0.01, 2, 0.02, -2, 0.003, -4}), 800),
               WithinRel(static_cast<double>(std::sqrt(n2)), kFewRoundings));
}

TEST_CASE("formula 4 has two rational terms and a polynomial", "[material]") {
    const long double l = 0.7L;
    const long double n2 = 2 + 0.8L * l * l / (l * l - 0.3L * 0.3L) +
                           0.05L / (l * l - std::pow(30.0L, 2.0L)) - 0.007L * l * l +
                           0.001L * l * l * l * l;
    CHECK_THAT(n_of(with_formula(4, {2, 0.8, 2, 0.3, 2, 0.05, 0, 30, 2, -0.007, 2, 0.001, 4}), 700),
               WithinRel(static_cast<double>(std::sqrt(n2)), kFewRoundings));
}

TEST_CASE("formula 4 with an unused second pole is finite at 1 um", "[material]") {
    // 0^0 = 1 would put the unused term's pole at exactly 1 um.
    const Material material = with_formula(4, {2, 0.8, 2, 0.01, 1, 0, 0, 0, 0, -0.01, 2});
    CHECK_THAT(n_of(material, 1000), WithinRel(std::sqrt(2 + 0.8 / 0.99 - 0.01), 1e-15));
}

TEST_CASE("formula 5 is Cauchy's series", "[material]") {
    // 1.5 + 0.004/0.25 + 0.0001/0.0625 = 1.5 + 0.016 + 0.0016
    CHECK_THAT(n_of(with_formula(5, {1.5, 0.004, -2, 0.0001, -4}), 500), WithinAbs(1.5176, 1e-15));
}

TEST_CASE("formula 6 is that of gases", "[material]") {
    const long double s = 1 / (0.5L * 0.5L);
    const long double n = 1 + 0.05792105L / (238.0185L - s) + 0.00167917L / (57.362L - s);
    CHECK_THAT(n_of(with_formula(6, {0, 0.05792105, 238.0185, 0.00167917, 57.362}), 500),
               WithinAbs(static_cast<double>(n), 1e-15));
}

TEST_CASE("formula 7 is Herzberger's", "[material]") {
    // D. F. Edwards and E. Ochoa, Appl. Opt. 19, 4130 (1980): silicon, at 10 um.
    const long double u = 1 / (100.0L - 0.028L);
    const long double n =
        3.41983L + 0.159906L * u - 0.123109L * u * u + 1.26878e-6L * 100 - 1.95104e-9L * 10000;
    CHECK_THAT(
        n_of(with_formula(7, {3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9}), 10000),
        WithinRel(static_cast<double>(n), 1e-15));
}

TEST_CASE("formula 8 is for (n^2-1)/(n^2+2)", "[material]") {
    // H. Schroeter, Z. Phys. 67, 24 (1931): silver bromide. The check inverts the definition.
    const double n = n_of(with_formula(8, {0.452505, 0.09939, 0.070537, -0.00015}), 600);
    const double r = 0.452505 + 0.09939 * 0.36 / (0.36 - 0.070537) - 0.00015 * 0.36;
    CHECK_THAT((n * n - 1) / (n * n + 2), WithinAbs(r, 1e-15));
}

TEST_CASE("formula 9 has a resonance beside its pole", "[material]") {
    // M. J. Rosker et al., IEEE J. Quantum Electron. 21, 1600 (1985): urea, extraordinary ray.
    const long double l = 0.5L;
    const long double n2 = 2.51527L + 0.024L / (l * l - 0.03L) +
                           0.02L * (l - 1.52L) / ((l - 1.52L) * (l - 1.52L) + 0.8771L);
    CHECK_THAT(n_of(with_formula(9, {2.51527, 0.024, 0.03, 0.02, 1.52, 0.8771}), 500),
               WithinRel(static_cast<double>(std::sqrt(n2)), kFewRoundings));
}

TEST_CASE("coefficients left out are 0", "[material]") {
    for (int number = 1; number <= 4; ++number)
        CHECK(n_of(with_formula(number, {3}), 500) == (number < 3 ? 2.0 : std::sqrt(3.0)));
    CHECK(n_of(with_formula(5, {3}), 500) == 3.0);
    CHECK(n_of(with_formula(6, {0.5}), 500) == 1.5);
    CHECK(n_of(with_formula(7, {3}), 500) == 3.0);
    CHECK(n_of(with_formula(8, {0.25}), 500) == std::sqrt(2.0));
    CHECK(n_of(with_formula(9, {4}), 500) == 2.0);
}

TEST_CASE("a formula that yields no index is refused, never NaN", "[material]") {
    CHECK(error_of(with_formula(3, {-4}), 500) ==
          "x: n^2 must be in [0, 1e+08] (got -4 at 500 nm)");
    CHECK_THROWS_AS(index_at(with_formula(2, {0, 1, 0.25}), 500), DomainError);  // on the pole
    CHECK_THROWS_AS(index_at(with_formula(2, {0, 1, 0.25, -1, 0.25}), 500), DomainError);
    CHECK(error_of(with_formula(5, {-1.2}), 1300) ==
          "x: n must be in [0, 10000] (got -1.2 at 1300 nm)");
    CHECK(error_of(with_formula(10, {1}), 500) == "x: formula number must be in [1, 9] (got 10)");
    CHECK(error_of(with_formula(0, {1}), 500) == "x: formula number must be in [1, 9] (got 0)");
}

// --- tables, models, ranges ------------------------------------------------------------------

TEST_CASE("a table is met at its rows and linear between them", "[material]") {
    const Table n{{400, 500, 800}, {1.7, 1.5, 1.4}};
    const Table k{{300, 450, 900}, {0.3, 0.1, 0.2}};
    const Material material = with_tables(n, k);
    CHECK(index_at(material, 400).real() == 1.7);
    CHECK(index_at(material, 500).real() == 1.5);
    CHECK(index_at(material, 800).real() == 1.4);
    CHECK(index_at(material, 450).imag() == 0.1);
    CHECK_THAT(index_at(material, 425).real(), WithinAbs(1.65, 1e-15));
    CHECK_THAT(index_at(material, 600).imag(), WithinAbs(0.1 + 0.1 / 3, 1e-15));
    CHECK(range_of(material) == WavelengthRange{400, 800});
}

TEST_CASE("a single row is known at its wavelength only", "[material]") {
    Material material = with_tables({{587.6}, {1.473}});
    CHECK(n_of(material, 587.6) == 1.473);
    CHECK(error_of(material, 588) == "x is known from 587.6 to 587.6 nm (asked for 588)");
    material.outside = Outside::clamp;
    CHECK(n_of(material, 400) == 1.473);
    CHECK(n_of(material, 900) == 1.473);
}

TEST_CASE("outside the rows of k the material is not known, or holds its end value", "[material]") {
    Material apart = with_tables({{400, 800}, {1.5, 1.7}}, Table{{600, 700}, {0.1, 0.2}});
    CHECK(range_of(apart) == WavelengthRange{600, 700});
    CHECK(index_at(apart, 600).imag() == 0.1);
    CHECK(error_of(apart, 599.9) == "k of x is known from 600 to 700 nm (asked for 599.9)");
    CHECK(error_of(apart, 700.1) == "k of x is known from 600 to 700 nm (asked for 700.1)");
    CHECK(error_of(apart, 399) == "x is known from 400 to 800 nm (asked for 399)");
    apart.outside = Outside::clamp;
    CHECK(index_at(apart, 500) == Complex(1.55, 0.1));
    CHECK(index_at(apart, 900) == Complex(1.7, 0.2));
    CHECK(kinks(apart, {300, 1000}) == std::vector<double>{400, 600, 700, 800});
}

TEST_CASE("k of built-in materials is known wherever n is", "[library]") {
    for (const std::string_view name : library_names()) {
        CAPTURE(name);
        const Material material = built_in(name);
        const auto* index = std::get_if<RefractiveIndex>(&material.model);
        if (index == nullptr) continue;
        const Material n_alone{"n", RefractiveIndex{index->n, Constant{0}}, Outside::refuse};
        CHECK(range_of(material) == range_of(n_alone));
    }
}

TEST_CASE("tables without rows are refused", "[material]") {
    CHECK_THROWS_AS(range_of(with_tables({})), DomainError);
    CHECK_THROWS_AS(range_of(with_tables({{400, 500}, {1.5}})), DomainError);
}

TEST_CASE("the error outside a range names material, range and wavelength", "[material]") {
    CHECK(error_of(built_in("TiO2-rutile"), 380) ==
          "TiO2-rutile is known from 430 to 1530 nm (asked for 380)");
    Material unnamed = with_formula(5, {1.5}, {400, 700});
    unnamed.name.clear();
    CHECK(error_of(unnamed, 399) == "material is known from 400 to 700 nm (asked for 399)");
    unnamed.outside = Outside::clamp;
    CHECK(n_of(unnamed, 399) == 1.5);
}

TEST_CASE("wavelengths outside [1, 1e7] and NaN are refused, also for constants", "[material]") {
    const Material glass{"glass", RefractiveIndex{Constant{1.5}, Constant{0}}, Outside::clamp};
    CHECK(range_of(glass) == kAllWavelengths);
    CHECK(n_of(glass, 1) == 1.5);
    CHECK(n_of(glass, 1e7) == 1.5);
    for (const double nm :
         {0.0, -500.0, 0.999, 1.0001e7, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(index_at(glass, nm), DomainError);
}

TEST_CASE("an index that cannot be computed with is refused by name and value", "[material]") {
    const auto constant = [](double n, double k) {
        return Material{"odd", RefractiveIndex{Constant{n}, Constant{k}}, Outside::refuse};
    };
    CHECK(error_of(constant(-1.2, 0), 1300) ==
          "odd: n must be in [0, 10000] (got -1.2 at 1300 nm)");
    CHECK(error_of(constant(1e5, 0), 500) == "odd: n must be in [0, 10000] (got 1e+05 at 500 nm)");
    CHECK(error_of(constant(1, 1e5), 500) ==
          "odd: k must be in [-10000, 10000] (got 1e+05 at 500 nm)");
    CHECK_THROWS_AS(index_at(constant(0, 0), 500), DomainError);
    CHECK_THROWS_AS(index_at(constant(std::nan(""), 0), 500), DomainError);
    CHECK_THROWS_AS(index_at(constant(1, std::nan("")), 500), DomainError);
    CHECK(index_at(constant(0, 1e-6), 500) == Complex(0, 1e-6));
    CHECK(index_at(constant(1.5, -0.1), 500) == Complex(1.5, -0.1));
}

TEST_CASE("the Lorentz-Drude model gives the index of silver of Rakic et al.", "[material]") {
    // A. D. Rakic et al., Appl. Opt. 37, 5271 (1998), and its table at 550 nm: 0.1342 + 3.1723i.
    LorentzDrude silver{1,
                        9.01,
                        {{0.845, 0.048, 0},
                         {0.065, 3.886, 0.816},
                         {0.124, 0.452, 4.481},
                         {0.011, 0.065, 8.185},
                         {0.84, 0.916, 9.083},
                         {5.646, 2.419, 20.29}},
                        {247.97, 12398}};
    const Material material{"Ag-LD", silver, Outside::refuse};
    const Complex index = index_at(material, 550);
    CHECK_THAT(index.real(), WithinAbs(0.1342, 1e-4));
    CHECK_THAT(index.imag(), WithinAbs(3.1723, 2e-4));
    CHECK(range_of(material) == WavelengthRange{247.97, 12398});
    CHECK(error_of(material, 200) == "Ag-LD is known from 247.97 to 12398 nm (asked for 200)");
    CHECK_FALSE(is_constant(material));
    CHECK(kinks(material, kAllWavelengths).empty());
    CHECK(table_rows(material, kAllWavelengths).empty());
}

TEST_CASE("a Drude metal without losses has n = 0 and k > 0 below its plasma energy",
          "[material]") {
    const Material metal{"drude", LorentzDrude{1, 4, {{1, 0, 0}}, kAllWavelengths},
                         Outside::refuse};
    // E = 2 eV: eps = 1 - 16/4 = -3
    const Complex index = index_at(metal, 1239.841984332 / 2);
    CHECK_THAT(index.real(), WithinAbs(0, 1e-9));
    CHECK_THAT(index.imag(), WithinAbs(std::numbers::sqrt3, 1e-9));
}

TEST_CASE("only a number for n and for k makes a constant", "[material]") {
    CHECK(is_constant(Material{"x", RefractiveIndex{}, Outside::refuse}));
    CHECK(is_constant(built_in("vacuum")));
    CHECK_FALSE(is_constant(with_formula(5, {1.5})));
    CHECK_FALSE(is_constant(with_tables({{500}, {1.5}})));
}

TEST_CASE("kinks are the rows of both tables inside the interval", "[material]") {
    const Table n{{400, 500, 800}, {1.7, 1.5, 1.4}};
    Material material = with_tables(n, Table{{300, 500, 600, 900}, {0, 0, 0, 0}});
    CHECK_THAT(kinks(material, {400, 800}), Equals(std::vector<double>{500, 600}));
    CHECK_THAT(kinks(material, {500, 600}), Equals(std::vector<double>{}));
    CHECK_THAT(table_rows(material, {400, 800}), Equals(kinks(material, {400, 800})));
    CHECK_THAT(kinks(material, {350, 850}), Equals(std::vector<double>{400, 500, 600, 800}));
    CHECK(kinks(with_formula(5, {1.5}, {400, 700}), {300, 800}).empty());
    material = with_formula(5, {1.5}, {400, 700});
    material.outside = Outside::clamp;
    CHECK_THAT(kinks(material, {300, 800}), Equals(std::vector<double>{400, 700}));
}

// --- the built-in library --------------------------------------------------------------------

TEST_CASE("every built-in material is an index all over its range", "[library]") {
    CHECK(library_names().size() >= 140);
    for (const std::string_view name : library_names()) {
        CAPTURE(name);
        const auto found = find_material(name);
        REQUIRE(found);
        CHECK(found->material.name == name);
        CHECK_FALSE(found->source.empty());
        if (name != "vacuum") {
            CHECK((found->year >= 1900 && found->year <= 2026));
        }
        const WavelengthRange range = range_of(found->material);
        constexpr int kSteps = 997;
        for (int i = 0; i <= kSteps; ++i) {
            const double nm = i == kSteps
                                  ? range.last_nm
                                  : range.first_nm * std::pow(range.last_nm / range.first_nm,
                                                              static_cast<double>(i) / kSteps);
            const Complex index = index_at(found->material, nm);
            const bool good = std::isfinite(index.real()) && index.real() > 0 &&
                              index.imag() >= 0 && index.imag() < 100;
            if (!good) FAIL_CHECK("index " << index << " at " << nm << " nm");
        }
    }
}

TEST_CASE("built-in tables increase strictly and have no negative absorption", "[library]") {
    for (const std::string_view name : library_names()) {
        CAPTURE(name);
        const Material material = built_in(name);
        const auto* index = std::get_if<RefractiveIndex>(&material.model);
        if (index == nullptr) continue;
        for (const Dispersion* dispersion : {&index->n, &index->k}) {
            const auto* table = std::get_if<Table>(dispersion);
            if (table == nullptr) continue;
            REQUIRE(table->wavelength_nm.size() == table->value.size());
            for (std::size_t i = 1; i < table->wavelength_nm.size(); ++i)
                if (!(table->wavelength_nm[i] > table->wavelength_nm[i - 1])) FAIL_CHECK(i);
            for (const double value : table->value)
                if (!(value >= 0)) FAIL_CHECK(value);
        }
    }
}

TEST_CASE("built-in materials that do not cover 380 to 780 nm are these", "[library]") {
    const std::set<std::string_view> expected = {
        "butanol",       "glycerol",  "acetone",   "SF11",   "TiO2-rutile", "TiO2-rutile-e",
        "ZnO",           "diamond",   "ZnS",       "ZnSe",   "PMMA",        "polystyrene",
        "polycarbonate", "PET",       "cellulose", "N-SF66", "AgCl",        "YAG",
        "LiNbO3",        "LiNbO3-e",  "TeO2",      "TeO2-e", "ZnS-crystal", "ZnSe-crystal",
        "ZnTe",          "CdTe",      "LaF3",      "Si-IR",  "Ge-IR",       "GaAs-IR",
        "AlAs",          "AlGaAs-30", "AlGaAs-90", "InP"};
    std::set<std::string_view> partial;
    for (const std::string_view name : library_names()) {
        const WavelengthRange range = range_of(built_in(name));
        if (range.first_nm > 380 || range.last_nm < 780) partial.insert(name);
    }
    CHECK(partial == expected);
}

TEST_CASE("names and aliases are unique, exact and case-sensitive", "[library]") {
    std::set<std::string> seen;
    for (const std::string_view name : library_names()) {
        CHECK(seen.insert(std::string(name)).second);
        const auto found = find_material(name).value();
        for (const std::string& alias : found.aliases) {
            CAPTURE(alias);
            CHECK(seen.insert(alias).second);
            CHECK(built_in(alias) == found.material);
        }
    }
    CHECK(find_material("N-BK7")->material.name == "BK7");
    CHECK(find_material("SiO2")->material.name == "fused-silica");
    CHECK(find_material("sapphire")->material.name == "Al2O3");
    for (const char* unknown : {"", "bk7", "BK7 ", "AG", "unobtainium"})
        CHECK_FALSE(find_material(unknown).has_value());
}

TEST_CASE("every name that is promised is there", "[library]") {
    for (const char* name : {"vacuum",
                             "air",
                             "water",
                             "BK7",
                             "N-BK7",
                             "SF11",
                             "N-SF11",
                             "fused-silica",
                             "SiO2",
                             "SiO2-film",
                             "soda-lime",
                             "borosilicate",
                             "MgF2",
                             "CaF2",
                             "BaF2",
                             "LiF",
                             "Al2O3",
                             "TiO2",
                             "TiO2-anatase",
                             "TiO2-rutile",
                             "TiO2-rutile-e",
                             "Ta2O5",
                             "Nb2O5",
                             "HfO2",
                             "ZrO2",
                             "ZnS",
                             "ZnO",
                             "ZnSe",
                             "Si3N4",
                             "Si3N4-LPCVD",
                             "MgO",
                             "Y2O3",
                             "SiO",
                             "TiN",
                             "ITO",
                             "Fe2O3",
                             "diamond",
                             "quartz",
                             "calcite",
                             "Si",
                             "Si-Aspnes",
                             "Ge",
                             "GaAs",
                             "Ag",
                             "Au",
                             "Cu",
                             "Al",
                             "Cr",
                             "Ni",
                             "Ti",
                             "Fe",
                             "Pd",
                             "W",
                             "Pt",
                             "Hg",
                             "brass",
                             "PMMA",
                             "polystyrene",
                             "polycarbonate",
                             "PET",
                             "cellulose",
                             "ethanol",
                             "butanol",
                             "glycerol",
                             "acetone",
                             "oil",
                             "chitin",
                             "keratin",
                             "silk"})
        CHECK(find_material(name).has_value());
}

TEST_CASE("closed formulas give the n of the lines F, d and C that their sources imply",
          "[library]") {
    // Computed separately from the printed coefficients, rounded to 6 decimals. For catalogue
    // glasses the indices are relative to air, and the lines' wavelengths are those in air.
    struct Lines {
        const char* name;
        double n_f, n_d, n_c;
    };
    const auto line = GENERATE(
        Lines{"fused-silica", 1.463126, 1.458464, 1.456367},
        Lines{"MgF2", 1.380199, 1.377744, 1.376643}, Lines{"MgF2-e", 1.392121, 1.389557, 1.388405},
        Lines{"CaF2", 1.437025, 1.433849, 1.432458}, Lines{"BaF2", 1.478620, 1.474559, 1.472817},
        Lines{"LiF", 1.394907, 1.392146, 1.390877}, Lines{"Al2O3", 1.775508, 1.768172, 1.764884},
        Lines{"Al2O3-e", 1.767284, 1.760096, 1.756870},
        Lines{"Si3N4", 2.038203, 2.016735, 2.007783},
        Lines{"Si3N4-LPCVD", 2.067089, 2.045809, 2.036656},
        Lines{"Y2O3", 1.950561, 1.930687, 1.922319}, Lines{"diamond", 2.435538, 2.417486, 2.409906},
        Lines{"BK7", 1.522376, 1.516800, 1.514322}, Lines{"SF11", 1.806454, 1.784720, 1.775988},
        Lines{"N-SF11", 1.806513, 1.784720, 1.775955}, Lines{"water", 1.337492, 1.333403, 1.331513},
        Lines{"quartz", 1.549664, 1.544276, 1.541854},
        Lines{"quartz-e", 1.558950, 1.553379, 1.550872},
        Lines{"calcite", 1.667648, 1.658461, 1.654456},
        Lines{"calcite-e", 1.490491, 1.486185, 1.484349},
        Lines{"ZnS", 2.430689, 2.368069, 2.344936},
        Lines{"cellulose", 1.476254, 1.470134, 1.467549},
        Lines{"TiO2-rutile", 2.734500, 2.614265, 2.570923},
        Lines{"TiO2-rutile-e", 3.063032, 2.910351, 2.855875},
        Lines{"ZnO", 2.063569, 2.003385, 1.982807}, Lines{"MgO", 1.747209, 1.737539, 1.733353},
        Lines{"HfO2", 1.911959, 1.898057, 1.892708}, Lines{"butanol", 1.405706, 1.399084, 1.396233},
        Lines{"glycerol", 1.476434, 1.471331, 1.469114});
    CAPTURE(line.name);
    const Material material = built_in(line.name);
    constexpr double kPrinted = 0.6e-6;  // half a unit of the last printed decimal
    const std::string name = line.name;
    const bool in_air = name == "BK7" || name == "SF11" || name == "N-SF11";
    const auto printed = [&](double nm) {
        if (!in_air) return n_of(material, nm);
        const double vacuum_nm = vacuum_wavelength(nm, 20);
        return n_of(material, vacuum_nm) / index_of_air(vacuum_nm, 20);
    };
    CHECK_THAT(printed(486.1327), WithinAbs(line.n_f, kPrinted));
    CHECK_THAT(printed(587.5618), WithinAbs(line.n_d, kPrinted));
    CHECK_THAT(printed(656.2725), WithinAbs(line.n_c, kPrinted));
}

TEST_CASE("catalogue and printed values of single materials", "[library]") {
    CHECK_THAT(n_of(built_in("borosilicate"), 587.5618), WithinAbs(1.471, 1e-3));
    // P. E. Ciddor, Appl. Opt. 35, 1566 (1996): n - 1 = 2.7717e-4 at the d line.
    CHECK_THAT(n_of(built_in("air"), 587.6) - 1, WithinAbs(2.7717e-4, 1e-8));
    CHECK(n_of(built_in("air"), 5000) == n_of(built_in("air"), 1690));
    // H. L. Leertouwer et al., Opt. Express 19, 24061 (2011), abstract, 3 decimals.
    for (const auto& [nm, chitin, keratin] :
         {std::array{400.0, 1.572, 1.569}, {500.0, 1.552, 1.556}, {600.0, 1.541, 1.548}}) {
        CHECK_THAT(n_of(built_in("chitin"), nm), WithinAbs(chitin, 5e-4));
        CHECK_THAT(n_of(built_in("keratin"), nm), WithinAbs(keratin, 5e-4));
    }
    CHECK(n_of(built_in("vacuum"), 500) == 1.0);
}

TEST_CASE("tables keep the rows of their sources", "[library]") {
    const auto at = [](const char* name, double nm) { return index_at(built_in(name), nm); };
    // P. B. Johnson and R. W. Christy (1972), rows at 2.26, 2.01 and 3.37 eV.
    CHECK(at("Ag", 548.6) == Complex(0.06, 3.586));
    CHECK(at("Au", 548.6) == Complex(0.43, 2.455));
    CHECK(at("Cu", 548.6) == Complex(1.02, 2.577));
    // M. A. Green (2008) at 500 nm; D. E. Aspnes and A. A. Studna (1983) near it.
    CHECK_THAT(at("Si", 500).real(), WithinAbs(4.294, 1e-12));
    CHECK_THAT(at("Si", 500).imag(), WithinAbs(0.0442, 2e-4));
    CHECK_THAT(at("Si-Aspnes", 500).real(), WithinAbs(4.2992, 1e-4));
    // A. Tselin et al. (2024): a row that is kept, and one that is not.
    CHECK(at("Pt", 547.659) == Complex(1.921, 4.482));
    CHECK_THAT(at("Pt", 550.97).real(), WithinAbs(1.930, 1e-3));
    CHECK_THAT(at("Pt", 550.97).imag(), WithinAbs(4.506, 1e-3));
}

TEST_CASE("Johnson and Christy between their rows", "[library]") {
    // Linear interpolation, 4 decimals.
    struct Spot {
        const char* name;
        double nm, n, k;
    };
    const auto spot = GENERATE(Spot{"Ag", 400, 0.0500, 2.1035}, Spot{"Ag", 450, 0.0400, 2.6484},
                               Spot{"Ag", 550, 0.0596, 3.5974}, Spot{"Ag", 650, 0.0522, 4.4094},
                               Spot{"Ag", 750, 0.0312, 5.1949}, Spot{"Au", 400, 1.4684, 1.9530},
                               Spot{"Au", 500, 0.9711, 1.8737}, Spot{"Au", 550, 0.4241, 2.4721},
                               Spot{"Au", 600, 0.2487, 3.0740}, Spot{"Au", 700, 0.1310, 4.0624},
                               Spot{"Cu", 400, 1.3135, 2.1309}, Spot{"Cu", 500, 1.2134, 2.5712},
                               Spot{"Cu", 550, 1.0066, 2.5823}, Spot{"Cu", 600, 0.4937, 2.9624},
                               Spot{"Cu", 750, 0.2365, 4.6114});
    CAPTURE(spot.name, spot.nm);
    const Complex index = index_at(built_in(spot.name), spot.nm);
    CHECK_THAT(index.real(), WithinAbs(spot.n, 0.6e-4));
    CHECK_THAT(index.imag(), WithinAbs(spot.k, 0.6e-4));
}
