#include "core/error.hpp"
#include "core/render/noise.hpp"
#include "core/stack/stack.hpp"
#include "tables/lut/kind_parts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

constexpr double kLargestCoordinate = 1e3;

ThicknessNoise noise_of(const LutRequest& request) {
    const std::vector<double>& range = request.list("range");
    return {.least_nm = range[0],
            .most_nm = range[1],
            .scale = request.number("noise-scale"),
            .seed = static_cast<std::uint64_t>(request.number("seed")),
            .octaves = static_cast<unsigned>(request.number("octaves"))};
}

LutPlan plan(const LutRequest& request) {
    const ThicknessNoise noise = noise_of(request);
    const ThicknessField field(noise);
    LutPlan result;
    result.axes = {listed_axis(request, "u", {"u", "", {}}),
                   listed_axis(request, "v", {"v", "", {}})};
    result.channels = {"thickness_nm"};
    result.evaluate = [field](const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        for (const double u : axes[0].values)
            for (const double v : axes[1].values) values.push_back(field(u, v, 0));
        return values;
    };
    result.measure = {"absolute, nm", [](const std::vector<LutAxis>&, std::span<const double> exact,
                                         std::span<const double> approximate) {
                          std::vector<double> differences(exact.size());
                          for (std::size_t i = 0; i < exact.size(); ++i)
                              differences[i] = std::abs(exact[i] - approximate[i]);
                          return differences;
                      }};
    result.facts["request"] = {{"noise_scale", noise.scale},
                               {"octaves", noise.octaves},
                               {"seed", noise.seed},
                               {"range_nm", {noise.least_nm, noise.most_nm}}};
    return result;
}

std::vector<std::string> problems(const Lut& lut) {
    const auto& range = lut.facts.at("request").at("range_nm");
    const double least = range[0], most = range[1], rounding = most * rounding_of(lut.type);
    for (std::size_t i = 0; i < lut.values.size(); ++i)
        if (!(lut.values[i] >= least - rounding && lut.values[i] <= most + rounding))
            return {"thickness_nm must be in [" + to_text(least) + ", " + to_text(most) + "] at " +
                    place_in(lut, i) + " (got " + to_text(lut.values[i]) + ")"};
    return {};
}

}  // namespace

extern const LutKind lut_kind_thickness = {
    .name = "thickness",
    .summary = "Thickness of a film that varies in space, by Perlin noise.",
    .axes = "u, v",
    .notes =
        "d(u, v) = LO + (HI - LO) n(SCALE u, SCALE v, 0), n being improved Perlin noise mapped to\n"
        "[0, 1]. Octave k has 2^k times the frequency and 2^-k times the weight of the first.\n"
        "irido render --thickness-noise takes the same noise at points (x, y, z), a sphere's\n"
        "radius being 1. The values are the same on every machine. The error is in nm.",
    .examples = {"thickness --range 100:800 --noise-scale 3 --seed 1 -o film.exr",
                 "thickness --range 200:600 --octaves 4 --size 512x512 --dtype f16 -o film.ktx2"},
    .options = {{.name = "range",
                 .type = LutOption::Type::range,
                 .help = "thinnest and thickest, nm, [0, 1e9] [100:1000]",
                 .fallback = "100:1000",
                 .lowest = 0,
                 .highest = kLargestThickness_nm},
                {.name = "noise-scale",
                 .type = LutOption::Type::number,
                 .help = "frequency of the noise: hills and valleys per unit of u, [0, 1e6] [4]",
                 .fallback = "4",
                 .lowest = 0,
                 .highest = ThicknessNoise::kLargestScale},
                {.name = "octaves",
                 .type = LutOption::Type::whole,
                 .help = "octaves of noise, [1, 16] [1]",
                 .fallback = "1",
                 .lowest = 1,
                 .highest = ThicknessNoise::kMostOctaves},
                {.name = "seed",
                 .type = LutOption::Type::whole,
                 .help = "another noise for each, [0, 1e15]; 0 has Perlin's own permutation [0]",
                 .fallback = "0",
                 .lowest = 0,
                 .highest = 1e15},
                {.name = "u",
                 .help = "coordinates down the table, [-1e3, 1e3] [0:1/256]",
                 .fallback = "0:1/256",
                 .lowest = -kLargestCoordinate,
                 .highest = kLargestCoordinate},
                {.name = "v",
                 .help = "coordinates along a row, [-1e3, 1e3] [0:1/256]",
                 .fallback = "0:1/256",
                 .lowest = -kLargestCoordinate,
                 .highest = kLargestCoordinate}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
