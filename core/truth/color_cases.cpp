#include "core/truth/color_cases.hpp"

#include <array>

#include "core/material/library.hpp"
#include "core/stack/builder.hpp"

namespace irido {

namespace {

/// Equally spaced values from 0 to 1, both included.
std::vector<double> steps(int count) {
    std::vector<double> values(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        values[static_cast<std::size_t>(i)] = static_cast<double>(i) / (count - 1);
    return values;
}

/// Angles of incidence from 0 to `last`.
std::vector<double> angles_to(double last, int count) {
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) angles.push_back(last * i / (count - 1));
    return angles;
}

Material built_in(std::string_view name) {
    return find_material(name).value().material;
}

ColorFamily at_18_angles(Stack stack) {
    return {{std::move(stack)}, angles_to(85, 18)};
}

Stack film_stack(Complex incident, Complex film, double thickness_nm, Complex substrate) {
    StackBuilder b(incident);
    b.add(b.layer(film, thickness_nm));
    return b.over(substrate);
}

Stack butanol_on(std::string_view substrate) {
    StackBuilder b;
    b.add(StackBuilder::layer_of(b.material(built_in("butanol")), 666));
    return b.over_material(b.material(built_in(substrate)));
}

/// Periods of indices 1 and 1.5 in a host of index 1.
Stack fpb24_mirror(std::uint64_t repeat, double first_nm, double second_nm) {
    StackBuilder b;
    b.add(StackBuilder::group(repeat, {b.layer(1, first_nm), b.layer(1.5, second_nm)}));
    return b.over(1);
}

ColorFamily bb17_fig7(Random&) {
    return at_18_angles(film_stack(1, 1.5, 525, 1.09));
}
ColorFamily butanol_glass(Random&) {
    return at_18_angles(butanol_on("BK7"));
}
ColorFamily butanol_mercury(Random&) {
    return at_18_angles(butanol_on("Hg"));
}
ColorFamily butanol_copper(Random&) {
    return at_18_angles(butanol_on("Cu"));
}
ColorFamily soap_bubble(Random&) {
    return at_18_angles(film_stack(1, 1.7, 400, 1));
}
ColorFamily boar(Random&) {
    return at_18_angles(film_stack(1, 1.33, 600, {1.5, 3}));
}
ColorFamily beetle(Random&) {
    return at_18_angles(film_stack(1.2, 1.39, 505, {1.2, 0.5}));
}
ColorFamily mat_preview(Random&) {
    return at_18_angles(film_stack(1, 1.33, 550, {1.9, 1.5}));
}
ColorFamily leather(Random&) {
    return at_18_angles(film_stack(1, 1.3, 290, 1));
}
ColorFamily fpb24_fig3(Random&) {
    return at_18_angles(fpb24_mirror(10, 315, 315));
}
ColorFamily fpb24_fig1(Random&) {
    return at_18_angles(fpb24_mirror(20, 101, 143));
}

/// FPB24's table 1: d1 = d2 = period / 2.
template <std::uint64_t repeat, int period_nm>
ColorFamily fpb24_table1(Random&) {
    return at_18_angles(fpb24_mirror(repeat, period_nm / 2.0, period_nm / 2.0));
}

/// Stacks whose parameter runs from 0 to 1: many of them at 0 degrees, four at 0 to 80.
template <class StackAt>
ColorFamily at_normal(int count, const StackAt& stack_at) {
    ColorFamily family{{}, {0}};
    for (const double t : steps(count)) family.variants.push_back(stack_at(t));
    return family;
}
template <class StackAt>
ColorFamily up_to_80(const StackAt& stack_at) {
    ColorFamily family{{}, angles_to(80, 41)};
    for (const double t : {0.2, 0.4, 0.6, 0.8}) family.variants.push_back(stack_at(t));
    return family;
}

Stack soap(double t) {
    return film_stack(1, 1.33, 1500 * t, 1);
}

Stack on_copper(double t) {
    StackBuilder b;
    b.add(b.layer(1.5, 1500 * t));
    return b.over_material(b.material(built_in("Cu")));
}

Stack six_layers(double t) {
    Random random(6);
    StackBuilder b;
    for (int i = 0; i < 6; ++i) {
        const double n = random.uniform(1.3, 2.5), d = random.uniform(30, 250);
        b.add(b.layer(n, d * (0.5 + t)));
    }
    return b.over(1.52);
}

Stack mirror(double t) {
    StackBuilder b;
    const double scale = 0.9 + 0.2 * t;
    b.add(StackBuilder::group(20, {b.layer(2.3, 60 * scale), b.layer(1.46, 94 * scale)}));
    return b.over(1.52);
}

ColorFamily film_normal(Random&) {
    return at_normal(256, soap);
}
ColorFamily film_80(Random&) {
    return up_to_80(soap);
}
ColorFamily copper_normal(Random&) {
    return at_normal(256, on_copper);
}
ColorFamily copper_80(Random&) {
    return up_to_80(on_copper);
}
ColorFamily six_normal(Random&) {
    return at_normal(64, six_layers);
}
ColorFamily six_80(Random&) {
    return up_to_80(six_layers);
}
ColorFamily mirror_normal(Random&) {
    return at_normal(32, mirror);
}
ColorFamily mirror_80(Random&) {
    return up_to_80(mirror);
}

/// One stack at a random angle.
ColorFamily at_some_angle(Random& random, Stack stack) {
    return {{std::move(stack)}, {random.uniform(0, 85)}};
}

double transparent(Random& random) {
    return random.uniform(1.2, 2.7);
}

Complex bare_metal(Random& random) {
    const double n = random.uniform(0.05, 3);
    return {n, random.uniform(1.5, 7)};
}

ColorFamily dielectric_family(Random& random) {
    const double n = transparent(random), d = random.uniform(0, 1500);
    return at_some_angle(random, film_stack(1, n, d, random.uniform(1, 2.5)));
}

ColorFamily conductor(Random& random) {
    const double n = transparent(random), d = random.uniform(0, 1500);
    return at_some_angle(random, film_stack(1, n, d, bare_metal(random)));
}

ColorFamily dispersive(Random& random) {
    constexpr std::array<std::string_view, 6> films{"SiO2",  "MgF2", "Al2O3",
                                                    "water", "ZrO2", "butanol"};
    constexpr std::array<std::string_view, 10> bases{"Cu", "Au", "Ag", "Al",  "Ti",
                                                     "Cr", "W",  "Si", "BK7", "Hg"};
    StackBuilder b;
    const std::size_t film = b.material(built_in(films[random.below(films.size())]));
    b.add(StackBuilder::layer_of(film, random.uniform(0, 1500)));
    const std::size_t base = b.material(built_in(bases[random.below(bases.size())]));
    return at_some_angle(random, b.over_material(base));
}

ColorFamily multilayer(Random& random) {
    StackBuilder b;
    for (std::size_t left = 2 + random.below(8); left > 0; --left) {
        const double n = transparent(random);
        const double k = random.one_in(4) ? random.uniform(0, 0.3) : 0;
        b.add(b.layer({n, k}, random.uniform(5, 300)));
    }
    return at_some_angle(random, b.over(random.one_in(2) ? Complex(1.52) : bare_metal(random)));
}

ColorFamily bragg(Random& random) {
    StackBuilder b;
    const double n1 = transparent(random), d1 = random.uniform(30, 200);
    const double n2 = transparent(random), d2 = random.uniform(30, 200);
    b.add(StackBuilder::group(2 + random.below(29), {b.layer(n1, d1), b.layer(n2, d2)}));
    return at_some_angle(random, b.over(1.52));
}

/// Films of the first material over a range of thicknesses on the second, at three angles.
ColorFamily tabulated_film(std::string_view film, double thickest_nm, std::string_view base) {
    ColorFamily family{{}, {0, 40, 70}};
    for (const double t : steps(16)) {
        StackBuilder b;
        b.add(StackBuilder::layer_of(b.material(built_in(film)), thickest_nm * (t + 0.1)));
        family.variants.push_back(b.over_material(b.material(built_in(base))));
    }
    return family;
}
ColorFamily anodized(Random&) {
    return tabulated_film("TiO2", 180, "Ti");
}
ColorFamily ito_glass(Random&) {
    return tabulated_film("ITO", 400, "BK7");
}

/// Silver between two oxides on glass, with all thicknesses scaled together.
ColorFamily low_e(Random&) {
    ColorFamily family{{}, {0, 40, 70}};
    for (const double t : steps(16)) {
        const double scale = 0.7 + 0.6 * t;
        StackBuilder b;
        const std::size_t oxide = b.material(built_in("TiO2")), silver = b.material(built_in("Ag"));
        b.add(StackBuilder::layer_of(oxide, 38 * scale));
        b.add(StackBuilder::layer_of(silver, 11 * scale));
        b.add(StackBuilder::layer_of(oxide, 34 * scale));
        family.variants.push_back(b.over_material(b.material(built_in("BK7"))));
    }
    return family;
}

/// Six layers of a tabulated index, or of a similar analytic one.
template <bool is_table>
ColorFamily six_oxides(Random&) {
    ColorFamily family{{}, {0, 40, 70}};
    for (const double t : steps(16)) {
        StackBuilder b;
        const std::size_t low = b.material(built_in("MgF2")), high = b.material(built_in("TiO2"));
        for (int i = 0; i < 6; ++i) {
            const double nm = (40 + 12 * i) * (0.7 + 0.6 * t);
            if (i % 2 == 1) {
                b.add(is_table ? StackBuilder::layer_of(low, nm) : b.layer(1.38, nm));
            } else {
                b.add(is_table ? StackBuilder::layer_of(high, nm) : b.layer(2.4, nm));
            }
        }
        family.variants.push_back(b.over(1.52));
    }
    return family;
}

ColorFamily absorbing_bragg(Random&) {
    ColorFamily family{{}, {0, 40, 70}};
    for (const double t : steps(16)) {
        StackBuilder b;
        const double scale = 0.9 + 0.2 * t;
        b.add(StackBuilder::group(
            10, {b.layer({2.3, 0.01}, 60 * scale), b.layer({1.46, 0.002}, 94 * scale)}));
        family.variants.push_back(b.over({1.9, 1.5}));
    }
    return family;
}

constexpr std::array kCases{
    ColorCase{"bb17_fig7", "BB17 figure 7: 525 nm of 1.5 on 1.09", false, bb17_fig7},
    ColorCase{"butanol_glass", "BB17 figure 8: 666 nm of butanol on BK7", false, butanol_glass},
    ColorCase{"butanol_mercury", "the same on mercury", false, butanol_mercury},
    ColorCase{"butanol_copper", "the same on copper", false, butanol_copper},
    ColorCase{"soap_bubble", "BB17: 400 nm of 1.7 in air", false, soap_bubble},
    ColorCase{"boar", "BB17: 600 nm of 1.33 on 1.5 + 3i", false, boar},
    ColorCase{"beetle", "BB17: 505 nm of 1.39 on 1.2 + 0.5i below 1.2", false, beetle},
    ColorCase{"mat_preview", "BB17: 550 nm of 1.33 on 1.9 + 1.5i", false, mat_preview},
    ColorCase{"leather", "BB17: 290 nm of 1.3 on 1", false, leather},
    ColorCase{"fpb24_fig3", "FPB24: (1@315 | 1.5@315)^10", false, fpb24_fig3},
    ColorCase{"fpb24_fig1", "FPB24: (1@101 | 1.5@143)^20", false, fpb24_fig1},
    ColorCase{"fpb24_244_10", "FPB24 table 1: (1@122 | 1.5@122)^10", false, fpb24_table1<10, 244>},
    ColorCase{"fpb24_244_20", "(1@122 | 1.5@122)^20", false, fpb24_table1<20, 244>},
    ColorCase{"fpb24_500_10", "(1@250 | 1.5@250)^10", false, fpb24_table1<10, 500>},
    ColorCase{"fpb24_500_20", "(1@250 | 1.5@250)^20", false, fpb24_table1<20, 500>},
    ColorCase{"fpb24_988_10", "(1@494 | 1.5@494)^10", false, fpb24_table1<10, 988>},
    ColorCase{"fpb24_988_20", "(1@494 | 1.5@494)^20", false, fpb24_table1<20, 988>},
    ColorCase{"fpb24_500_100", "(1@250 | 1.5@250)^100", false, fpb24_table1<100, 500>},
    ColorCase{"fpb24_500_1000", "(1@250 | 1.5@250)^1000", false, fpb24_table1<1000, 500>},
    ColorCase{"film_normal", "256 films of 1.33 up to 1500 nm in air, 0 degrees", false,
              film_normal},
    ColorCase{"film_80", "four of them at 0:80:2 degrees", false, film_80},
    ColorCase{"copper_normal", "256 films of 1.5 up to 1500 nm on copper", false, copper_normal},
    ColorCase{"copper_80", "four of them at 0:80:2 degrees", false, copper_80},
    ColorCase{"six_normal", "64 stacks of six layers at 0 degrees", false, six_normal},
    ColorCase{"six_80", "four of them at 0:80:2 degrees", false, six_80},
    ColorCase{"mirror_normal", "32 mirrors like (2.3@60 | 1.46@94)^20, 0 degrees", false,
              mirror_normal},
    ColorCase{"mirror_80", "four of them at 0:80:2 degrees", false, mirror_80},
    ColorCase{"dielectric", "random films up to 1500 nm on dielectrics", true, dielectric_family},
    ColorCase{"conductor", "the same on metals of constant index", true, conductor},
    ColorCase{"dispersive", "built-in films on built-in metals and glass", true, dispersive},
    ColorCase{"multilayer", "2 to 9 random layers, some absorbing", true, multilayer},
    ColorCase{"bragg", "2 to 30 periods of two random layers", true, bragg},
    ColorCase{"anodized", "16 films of TiO2 on titanium, 0, 40 and 70 degrees", false, anodized},
    ColorCase{"ito_glass", "the same of ITO on BK7", false, ito_glass},
    ColorCase{"low_e", "TiO2, silver, TiO2 on BK7, scaled", false, low_e},
    ColorCase{"six_tables", "six layers of TiO2 and MgF2, scaled", false, six_oxides<true>},
    ColorCase{"six_constant", "the same of 2.4 and 1.38", false, six_oxides<false>},
    ColorCase{"absorbing_bragg", "10 absorbing periods on an absorber, scaled", false,
              absorbing_bragg},
};

}  // namespace

std::span<const ColorCase> color_cases() {
    return kCases;
}

std::vector<ColorFamily> color_families(const ColorCase& of, std::uint64_t count,
                                        std::uint64_t seed) {
    std::vector<ColorFamily> families;
    for (std::uint64_t i = 0; i < (of.is_set ? count : 1); ++i) {
        Random random(Random(seed + i).bits());
        families.push_back(of.make(random));
    }
    return families;
}

}  // namespace irido
