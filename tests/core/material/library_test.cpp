#include "core/material/library.hpp"

#include <catch2/catch.hpp>

#include "core/material/air.hpp"

using namespace irido;
using Catch::Matchers::WithinAbs;

namespace {

Material material_of_library(std::string_view name) {
    return find_material(name).value().material;
}

double index_of_library(std::string_view name, double nm) {
    return index_at(material_of_library(name), nm).real();
}

}  // namespace

TEST_CASE("glasses have the n_d and the Abbe number of their catalogue", "[library]") {
    struct Glass {
        const char* name;
        double n_d, abbe;
    };
    const auto glass = GENERATE(Glass{"N-FK51A", 1.48656, 84.47}, Glass{"N-K5", 1.52249, 59.48},
                                Glass{"N-ZK7", 1.50847, 61.19}, Glass{"N-BAK1", 1.57250, 57.55},
                                Glass{"N-BAK4", 1.56883, 55.98}, Glass{"N-PSK53A", 1.61800, 63.39},
                                Glass{"N-SK2", 1.60738, 56.65}, Glass{"N-SK16", 1.62041, 60.32},
                                Glass{"N-LAK9", 1.69100, 54.71}, Glass{"N-LAK22", 1.65113, 55.89},
                                Glass{"N-BAF10", 1.67003, 47.11}, Glass{"N-LAF2", 1.74397, 44.85},
                                Glass{"F2", 1.62004, 36.37}, Glass{"N-F2", 1.62005, 36.43},
                                Glass{"N-SF5", 1.67271, 32.25}, Glass{"SF10", 1.72825, 28.41},
                                Glass{"N-SF10", 1.72828, 28.53}, Glass{"N-SF6", 1.80518, 25.36},
                                Glass{"N-SF57", 1.84666, 23.78}, Glass{"N-SF66", 1.92286, 20.88},
                                Glass{"N-LASF9", 1.85025, 32.17}, Glass{"LASF35", 2.02204, 29.06});
    CAPTURE(glass.name);
    const auto in_air = [&](double nm) {
        const double vacuum_nm = vacuum_wavelength(nm, 20);
        return index_of_library(glass.name, vacuum_nm) / index_of_air(vacuum_nm, 20);
    };
    const double n_d = in_air(587.5618);
    CHECK_THAT(n_d, WithinAbs(glass.n_d, 6e-6));
    CHECK_THAT((n_d - 1) / (in_air(486.1327) - in_air(656.2725)), WithinAbs(glass.abbe, 6e-3));
}

TEST_CASE("formulas of crystals and semiconductors give the n that their sources imply",
          "[library]") {
    // computed separately from the printed coefficients, rounded to 6 decimals
    struct Spot {
        const char* name;
        double nm, n;
    };
    const auto spot = GENERATE(
        Spot{"GeO2", 587.5618, 1.608459}, Spot{"KCl", 587.5618, 1.490372},
        Spot{"KBr", 587.5618, 1.559950}, Spot{"SrF2", 587.5618, 1.438106},
        Spot{"PbF2", 587.5618, 1.766520}, Spot{"AgCl", 587.5618, 2.066859},
        Spot{"spinel", 587.5618, 1.716210}, Spot{"YAG", 587.5618, 1.832787},
        Spot{"LiNbO3", 587.5618, 2.300268}, Spot{"LiNbO3-e", 587.5618, 2.214020},
        Spot{"KDP", 587.5618, 1.509439}, Spot{"KDP-e", 587.5618, 1.468272},
        Spot{"BBO", 587.5618, 1.670737}, Spot{"BBO-e", 587.5618, 1.552518},
        Spot{"TeO2", 587.5618, 2.274935}, Spot{"TeO2-e", 587.5618, 2.430453},
        Spot{"ZnS-crystal", 587.5618, 2.367694}, Spot{"ZnSe-crystal", 587.5618, 2.624397},
        Spot{"ZnTe", 587.5618, 3.063192}, Spot{"CdTe", 1000, 2.844864},
        Spot{"LaF3", 587.5618, 1.512584}, Spot{"Si-IR", 2500, 3.439437},
        Spot{"Ge-IR", 10000, 4.004003}, Spot{"GaAs-IR", 1550, 3.370169},
        Spot{"AlAs", 1000, 2.947395}, Spot{"InP", 1550, 3.164929}, Spot{"GaN", 587.5618, 2.399085},
        Spot{"AlN", 587.5618, 2.154294}, Spot{"AlN-e", 587.5618, 2.200116});
    CAPTURE(spot.name);
    CHECK_THAT(index_of_library(spot.name, spot.nm), WithinAbs(spot.n, 0.6e-6));
}

TEST_CASE("Lorentz-Drude metals have the indices that their parameters imply", "[library]") {
    struct Spot {
        const char* name;
        double nm, n, k;
    };
    // from a table made with the same model, rounded to 4 decimals
    const auto spot =
        GENERATE(Spot{"Ag-LD", 400, 0.1579, 1.8274}, Spot{"Ag-LD", 700, 0.1543, 4.3047},
                 Spot{"Au-LD", 500, 0.7864, 1.8964}, Spot{"Au-LD", 700, 0.2570, 3.7176},
                 Spot{"Cu-LD", 450, 1.2374, 2.1900}, Spot{"Cu-LD", 600, 0.3982, 3.2371});
    CAPTURE(spot.name, spot.nm);
    const Complex index = index_at(material_of_library(spot.name), spot.nm);
    CHECK_THAT(index.real(), WithinAbs(spot.n, 2e-4));
    CHECK_THAT(index.imag(), WithinAbs(spot.k, 4e-4));
    CHECK(index_at(material_of_library("Al-LD"), 2500).imag() > 20);
}

TEST_CASE("films are marked as such", "[library]") {
    for (const char* name : {"TiO2", "Ta2O5", "Ag", "MgF2-film", "SiO2-film"})
        CHECK(find_material(name)->is_film);
    for (const char* name : {"BK7", "MgF2", "W", "water", "TiO2-rutile"})
        CHECK_FALSE(find_material(name)->is_film);
}
