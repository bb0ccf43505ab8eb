#include "cli/options/comparison_options.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/error.hpp"

namespace irido::cli {

namespace {

constexpr std::array<std::string_view, 4> kComparedMethods{"gaussian", "smits", "naive",
                                                           "equal/16"};

ComparedEngine parse_engine(const std::string& name) {
    for (const Engine* engine : engines())
        if (engine->name == name) return {name, engine, {}};
    const std::string stem = name.substr(0, name.find('/'));
    if (stem == "gaussian" || stem == "smits" || stem == "naive" || stem == "equal") {
        try {
            return {name, nullptr, parse_method(name)};
        } catch (const UsageError& error) {
            const std::string text = error.what();
            throw UsageError("--engine" + text.substr(text.find(':')));
        }
    }
    std::vector<std::string> names = engine_names();
    names.back() = "equal/N";
    const std::vector<std::string_view> views(names.begin(), names.end());
    throw UsageError("--engine: " + not_one_of(views, name));
}

}  // namespace

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const Engine* engine : engines()) names.emplace_back(engine->name);
    names.insert(names.end(), kComparedMethods.begin(), kComparedMethods.end());
    return names;
}

std::string formula_names() {
    std::vector<std::string> names;
    for (const Engine* engine : engines()) names.emplace_back(engine->name);
    return joined(names, ",");
}

std::vector<ComparedEngine> parse_engines(const std::string& text) {
    std::vector<ComparedEngine> chosen;
    const auto add = [&](const std::string& name) {
        if (std::ranges::find(chosen, name, &ComparedEngine::name) != chosen.end())
            throw UsageError("--engine: " + name + " is named twice");
        chosen.push_back(parse_engine(name));
    };
    if (text == "all") {
        for (const std::string& name : engine_names()) add(name);
        return chosen;
    }
    for (const std::string_view name : comma_separated(text)) add(std::string(name));
    return chosen;
}

Sensitivity parse_sensitivity(const ComparisonOptions& options) {
    return {parse_observer(options.color.observer), parse_illuminant(options.color.illuminant)};
}

EngineDifference parse_difference(const ComparisonOptions& options, const Triple& white) {
    constexpr std::array<std::string_view, 2> whites{"own", "common"};
    if (std::ranges::find(whites, options.white) == whites.end())
        throw UsageError("--white: " + not_one_of(whites, options.white));
    using enum DifferenceRequest::White;
    try {
        return {{options.white == "common" ? common : own, options.as_cie_rgb}, white};
    } catch (const DomainError& error) {
        throw UsageError("--illuminant: " + std::string(error.what()) + "; use --white own");
    }
}

std::string channels_text(const Triple& values) {
    const auto text = [](double value) {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), "%.4g", value);
        return std::string(digits.data());
    };
    if (values[0] == values[1] && values[1] == values[2]) return text(values[0]);
    return text(values[0]) + "," + text(values[1]) + "," + text(values[2]);
}

void add_comparison_options(CLI::App& command, ComparisonOptions& options) {
    command
        .add_option("--engine", options.engines,
                    "engines, with commas between them, or all: gltf, three, babylon, unity,\n"
                    "materialx, materialx-gltf, openpbr, cycles, cycles-principled, gaussian,\n"
                    "smits, naive, equal/N (N wavelengths); see irido compare list [all]")
        ->type_name("LIST");
    offer(command, "engine", engine_names, OfferedWords::Use::several);
    add_light_options(command, options.color);
    command
        .add_option("--white", options.white,
                    "white of Delta E: own, the exact colour against that of the illuminant,\n"
                    "the engine's against that of its space; common, the engine's colour\n"
                    "adapted (Bradford) to the illuminant's white [own]")
        ->type_name("WHITE");
    offer(command, "white", "own common");
    command.add_flag("--as-cie-rgb", options.as_cie_rgb,
                     "take results of MaterialX as CIE RGB with white E, as its source says,\n"
                     "instead of linear sRGB, as viewers show them");
    command.add_flag("--strict", options.strict,
                     "refuse stacks of which engines cannot take all properties");
}

}  // namespace irido::cli
