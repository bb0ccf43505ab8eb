#include "cli/bench/design_cases.hpp"

#include <array>

namespace irido::cli {

namespace {

// A dielectric pair and a crown glass shared by many of the problems: n = A + B/L^2, and the
// catalogue's Sellmeier terms of N-BK7. Stacks are expressions of these names; their thicknesses
// are only the starting point of a search.
#define IRIDO_PAIR                                                                           \
    R"("incident": 1, "substrate": "G", "materials": { "L": { "cauchy": [1.445, 0.0035] },)" \
    R"( "H": { "cauchy": [2.25, 0.03] }, "G": { "sellmeier": [[1.03961212, 0.00600069867],)" \
    R"( [0.231792344, 0.0200179144], [1.01046945, 103.560653]] } }, "layers": )"
#define IRIDO_L R"({ "material": "L", "thickness_nm": 94.4 })"
#define IRIDO_H R"({ "material": "H", "thickness_nm": 58.5 })"
#define IRIDO_LH IRIDO_L ", " IRIDO_H
#define IRIDO_LH4 IRIDO_LH ", " IRIDO_LH ", " IRIDO_LH ", " IRIDO_LH
#define IRIDO_FREE R"("free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 250] }], )"

constexpr std::array kDesignCases{
    DesignCase{"ar6", "no reflection, 400 to 700 nm, normal incidence, 6 layers", 0.0020439192,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH ", " IRIDO_LH ", " IRIDO_LH
               "] }, " IRIDO_FREE
               R"("targets": [{ "quantity": "R", "wavelengths_nm": "400:700:5", "target": 0 }] })"},
    DesignCase{"ar8", "the same, 8 layers", 0.0014310977,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH4 "] }, " IRIDO_FREE
               R"("targets": [{ "quantity": "R", "wavelengths_nm": "400:700:5", "target": 0 }] })"},
    DesignCase{"ar8-45", "the same at 0 and 45 degrees, unpolarized, 8 layers",
               0.005993925905931101,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH4 "] }, " IRIDO_FREE
               R"("targets": [{ "quantity": "R", "wavelengths_nm": "400:700:5",)"
               R"( "angles_deg": [0, 45], "target": 0 }] })"},
    DesignCase{"ar12-45", "the same at 0 and 45 degrees, 12 layers", 0.0057589532,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH4 ", " IRIDO_LH ", " IRIDO_LH
               "] }, " IRIDO_FREE R"("targets": [{ "quantity": "R", "wavelengths_nm": "400:700:5",)"
               R"( "angles_deg": [0, 45], "target": 0 }] })"},
    DesignCase{"splitter", "R = 1/2 at 45 degrees, s and p, 450 to 650 nm, 8 layers", 0.0895914914,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH4 "] }, " IRIDO_FREE
               R"("targets": [{ "quantity": "R", "wavelengths_nm": "450:650:5",)"
               R"( "angles_deg": 45, "polarization": "s,p", "target": 0.5 }] })"},
    DesignCase{"bragg10",
               "1 - R at 600 nm of n = 1.4 and 1.8 on 1.8, 10 layers; quarter waves are "
               "best (PyMoosh's problem)",
               0.16485577,
               R"({ "stack": "1 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 |)"
               R"( 1.4@90 | 1.8@90 | 1.4@90 | 1.8",)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 215] }],)"
               R"( "targets": [{ "quantity": "R", "wavelengths_nm": 600, "target": 1 }],)"
               R"( "merit": "mean_abs" })"},
    DesignCase{"bragg20", "the same, 20 layers", 0.01447894,
               R"({ "stack": "1 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 |)"
               R"( 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90)"
               R"( | 1.8@90 | 1.4@90 | 1.8@90 | 1.4@90 | 1.8",)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 215] }],)"
               R"( "targets": [{ "quantity": "R", "wavelengths_nm": 600, "target": 1 }],)"
               R"( "merit": "mean_abs" })"},
    DesignCase{"solar10", "mean R of silicon, 400 to 800 nm, 10 layers of n^2 = 2 and 3",
               0.0856230443,
               R"({ "stack": "1 | 1.4142@80 | 1.7321@80 | 1.4142@80 | 1.7321@80 | 1.4142@80 |)"
               R"( 1.7321@80 | 1.4142@80 | 1.7321@80 | 1.4142@80 | 1.7321@80 | Si",)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 300] }],)"
               R"( "targets": [{ "quantity": "R", "wavelengths_nm": "400:800:4", "target": 0 }],)"
               R"( "merit": "mean_abs" })"},
    DesignCase{"low-e", "T of the visible, R of the infrared: oxide, silver, oxide on glass",
               0.0516312413,
               R"({ "stack": "air | 2.3@30 | Ag@10 | 2.3@30 | Ag@10 | 2.3@30 | BK7",)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [1, 120] }],)"
               R"( "targets": [{ "quantity": "T", "wavelengths_nm": "420:680:10", "target": 0.9 },)"
               R"( { "quantity": "R", "wavelengths_nm": "800:1500:50", "target": 0.95 }] })"},
    DesignCase{"longpass", "R = 1 up to 580 nm, T = 1 from 620 nm, 31 layers", 7.7733e-05,
               R"({ "stack": { )" IRIDO_PAIR "[" IRIDO_LH4 ", " IRIDO_LH4 ", " IRIDO_LH4
               ", " IRIDO_LH ", " IRIDO_LH ", " IRIDO_LH ", " IRIDO_L "] }, " IRIDO_FREE
               R"("targets": [{ "quantity": "R", "wavelengths_nm": "500:580:2", "target": 1 },)"
               R"( { "quantity": "R", "wavelengths_nm": "620:730:2", "target": 0 }] })"},
    DesignCase{"oxide-color",
               "the blue violet Lab (40, 30, -45) of an oxide on titanium, "
               "CIEDE2000",
               6.1908603702,
               R"({ "stack": "air | TiO2@100 | Ti",)"
               R"( "free": [{ "path": "layers.0.thickness_nm", "bounds": [5, 250] }],)"
               R"( "targets": [{ "quantity": "lab", "target": [40, 30, -45] }],)"
               R"( "merit": "delta_e_2000" })"},
    DesignCase{"steady-green", "one green at 0, 20 and 40 degrees, 7 layers on silicon, CIE 1976",
               0.8920551232,
               R"({ "stack": "air | SiO2@80 | TiO2@60 | SiO2@80 | TiO2@60 | SiO2@80 | TiO2@60 |)"
               R"( SiO2@80 | Si",)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 200] }],)"
               R"( "targets": [{ "quantity": "lab", "angles_deg": [0, 20, 40],)"
               R"( "target": [60, -40, 30] }], "merit": "delta_e_76" })"},
    DesignCase{"mirror-gradient",
               "a mirror's N, thicknesses and index from its colours at nine "
               "angles, CIE 1976; exact (FPB24, future work)",
               0.0,
               R"({ "stack": "1 | (1@150 | 1.5@150)^10 | 1", "free": [)"
               R"( { "path": "layers.0.repeat", "bounds": [4, 24], "integer": true },)"
               R"( { "path": "layers.0.layers.*.thickness_nm", "bounds": [40, 500] },)"
               R"( { "path": "layers.0.layers.1.material.n", "bounds": [1.2, 2.2] }],)"
               R"( "targets": [{ "quantity": "lab", "angles_deg": "0:80:10", "target": [)"
               R"( [94.591987, -9.060041, 89.688112], [95.656066, -13.300683, 87.308827],)"
               R"( [97.432672, -21.934914, 75.690791], [96.65649, -33.589301, 41.804862],)"
               R"( [86.338209, -34.864989, -7.460684], [71.072225, -13.145748, -26.920717],)"
               R"( [64.235637, -18.170904, -21.565516], [66.084599, 3.811101, -23.361424],)"
               R"( [79.830161, -10.588934, -15.420119]] }], "merit": "delta_e_76" })"},
    DesignCase{"needle-ar",
               "no reflection, 400 to 700 nm, from one layer by needles, 12 layers at "
               "most",
               0.0009803392,
               R"({ "stack": { )" IRIDO_PAIR R"([{ "material": "L", "thickness_nm": 400 }] },)"
               R"( "free": [{ "path": "layers.*.thickness_nm", "bounds": [0, 500] }],)"
               R"( "targets": [{ "quantity": "R", "wavelengths_nm": "400:700:5", "target": 0 }],)"
               R"( "method": "needle", "materials": ["L", "H"], "max_layers": 12,)"
               R"( "min_thickness_nm": 3 })"},
};

}  // namespace

std::span<const DesignCase> design_cases() {
    return kDesignCases;
}

}  // namespace irido::cli
