#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/queries/profile_query.hpp"
#include "core/incoherent/chain.hpp"

namespace irido::cli {

namespace {

struct ProfileCommand {
    schemas::StackRequest stack;
    std::unique_ptr<QueryOptions> typed;
    OutputOptions output;
    bool quiet = false;
};

/// A layer in a picture; positions in nm.
struct DrawnLayer {
    double begin, end;
    std::size_t material;
};

std::vector<DrawnLayer> drawn_layers(const Stack& stack) {
    std::vector<DrawnLayer> drawn;
    double end = 0;
    const std::vector<std::size_t> listed = listed_layers(stack.elements);
    std::size_t i = 0;
    for (const Layer& layer : written_out(stack.elements)) {
        const double begin = std::exchange(end, end + layer.thickness_nm);
        if (i > 0 && listed[i] == listed[i - 1])
            drawn.back().end = end;
        else
            drawn.push_back({begin, end, layer.material});
        ++i;
    }
    return drawn;
}

/// Adds the layers to every panel over the depth, as areas behind the curves.
void draw_layers(const schemas::StackDocument& document, tables::Figure& figure) {
    constexpr std::size_t kMostDrawn = 1000, kFirstStyle = 2;
    if (count_listed_layers(document.stack.elements) > kMostDrawn) return;
    const std::vector<DrawnLayer> layers = drawn_layers(document.stack);
    std::map<std::size_t, std::size_t> styles;
    for (tables::Panel& panel : figure.panels) {
        double low = 0, high = 0;
        for (const tables::Series& series : panel.series)
            for (const tables::Point& point : series.points) {
                low = std::min(low, point.y);
                high = std::max(high, point.y);
            }
        for (const DrawnLayer& layer : layers) {
            if (layer.begin == layer.end) continue;
            const auto style =
                kFirstStyle + styles.try_emplace(layer.material, styles.size()).first->second;
            const std::string& name = document.stack.materials[layer.material].name;
            panel.areas.push_back({.name = "",
                                   .style = style,
                                   .title = name,
                                   .label = name,
                                   .label_in_middle = true,
                                   .x = {layer.begin, layer.end},
                                   .low = {low, low},
                                   .high = {high, high}});
        }
    }
}

int run_profile(const ProfileCommand& command) {
    const tables::PictureFormat* const picture = asked_picture(command.output);
    if (!picture) resolved_record_format(command.output, RecordTarget::stream_or_picture);
    const auto say = [&](const std::string& text) { note(text, command.quiet); };
    auto typed = static_cast<const ProfileOptions&>(*command.typed);
    typed.faces = picture != nullptr;  // where E and the absorption jump
    const ProfileQuery query(typed, {.note = say});
    const auto prepared = query.prepare(read_noted_stack(command.stack, command.quiet));
    check_writable(command.output);
    const tables::Records records = records_of(query, *prepared);
    if (!picture) {
        write_records(records, command.output);
        return 0;
    }
    const std::string title = title_of(prepared->document, command.stack);
    const auto figure = [&] {
        tables::Figure drawn = figure_of_rows(query, records, {}, title, {}, say);
        if (!query.is_summary()) draw_layers(prepared->document, drawn);
        return drawn;
    };
    write_picture(figure, {}, *picture, command.output);
    return 0;
}

}  // namespace

void add_profile_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "profile", "Electric field, absorption and flux over the depth of a stack.");
    const auto options = std::make_shared<ProfileCommand>();
    add_stack_options(*command, options->stack);
    options->typed = ProfileOptions::add(*command);
    add_output_options(*command, options->output,
                       record_formats_text(RecordTarget::stream_or_picture));
    add_quiet_option(*command, options->quiet);
    set_examples(
        *command,
        {"irido profile \"BK7 | Ag@50 | air\" -w 633 -a 42.82 -p p --points 400 -o field.png",
         "irido profile \"air | SiO2@100 | Si\" -w 550 --z 0:150:50",
         "irido profile \"air | MgF2@90 | Ag@20 | BK7\" -w 450,550 --summary"},
        "|E|^2 and its components along x (the surface and the plane of incidence), y and z\n"
        "(the normal) are relative to the incident wave; flux and absorption to its power.\n"
        "Medium 0 is the incident one, the substrate is the last.");
    set_run(*command, run, options, run_profile);
}

}  // namespace irido::cli
