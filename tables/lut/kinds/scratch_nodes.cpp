#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scratch/slit_color.hpp"
#include "tables/lut/kind_parts.hpp"
#include "tables/lut/light_facts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

LutPlan plan(const LutRequest& request) {
    const auto count = static_cast<std::size_t>(request.number("count"));
    LutPlan result;
    result.axes = {{{"node", "", stepped(1, count)}, true}};
    result.channels = {"nu_per_um", "X", "Y", "Z"};
    result.evaluate =
        [nodes = one_panel_nodes(*request.sensitivity, count)](const std::vector<LutAxis>& axes) {
            std::vector<double> values;
            for (const double node : axes[0].values) {
                const auto i = static_cast<std::size_t>(node);
                values.push_back(nodes.nu_per_um[i]);
                for (std::size_t c = 0; c < 3; ++c) values.push_back(nodes.weight[c][i]);
            }
            return values;
        };
    // there is nothing to interpolate between nodes
    result.measure = {
        "none", [](const std::vector<LutAxis>& axes, std::span<const double>,
                   std::span<const double>) { return std::vector<double>(axes[0].count(), 0.0); }};
    result.facts = light_facts(request);
    result.facts.erase("color_space");
    return result;
}

/// The weights must add up to white.
std::vector<std::string> problems(const Lut& lut) {
    const auto& white = lut.facts.at("request").at("white_xyz");
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < lut.values.size(); i += 4) sum += lut.values[i + 1 + c];
        const double most = 10 * rounding_of(lut.type);
        if (!(std::abs(sum - white[c].get<double>()) <= most))
            return {"the weights of " + lut.channels[1 + c] + " must add up to the white"};
    }
    return {};
}

}  // namespace

extern const LutKind lut_kind_scratch_nodes = {
    .name = "scratch-nodes",
    .summary = "Wavenumbers and weights with which shaders integrate scratches' spectra.",
    .axes = "node",
    .notes =
        "X = sum of X_i f(nu_i) and so on for a spectrum f that is smooth in nu = 1/L. For the\n"
        "colours of scratches, up to a path u + 2 D (um) of 5, 10, 24: 33 nodes are within\n"
        "1e-6, 5e-2; 65 within 2e-8 at 10, 1e-4 at 24. A texture of one row: fetch its texels.",
    .examples = {"scratch-nodes --count 33 -o nodes.ktx2",
                 "scratch-nodes --count 49 --observer 10"},
    .light = true,
    .text_type = "f64",
    .options = {{.name = "count",
                 .type = LutOption::Type::whole,
                 .help = "number of nodes, [5, 129] [33]",
                 .fallback = "33",
                 .lowest = 5,
                 .highest = 129}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
