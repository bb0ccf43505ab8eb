#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/spectrum_columns.hpp"
#include "core/error.hpp"
#include "core/interference/spectrum.hpp"
#include "schemas/input_error.hpp"
#include "schemas/number.hpp"

namespace irido {

namespace {

struct SpectrumOptions {
    StackRequest stack;
    std::string wavelengths = "380:780:1";
    std::string angles = "0";
    std::string polarization = "u";
    std::string columns;
    OutputOptions output;
    unsigned threads = 0;
    bool stats = false;
    bool quiet = false;
};

/// The letters of "s,p,u" in the order typed.
std::string parse_polarizations(std::string_view text) {
    std::string letters;
    for (const std::string_view item : comma_separated(text)) {
        if (item != "s" && item != "p" && item != "u")
            throw UsageError("--polarization: must be s, p, u or several with commas (got '" +
                             std::string(text) + "')");
        letters += item;
    }
    return letters;
}

/// The error of the first material that has no index at one of the wavelengths, with its place.
[[noreturn]] void throw_material_error(const StackDocument& document,
                                       const std::vector<double>& wavelengths_nm,
                                       const DomainError& fallback) {
    for (std::size_t m = 0; m < document.stack.materials.size(); ++m) {
        try {
            for (const double wavelength : wavelengths_nm)
                index_at(document.stack.materials[m], wavelength);
        } catch (const DomainError& error) {
            throw InputError(document.file, document.material_pointers[m], error.what());
        }
    }
    throw InputError(document.file, document.material_pointers[document.stack.incident],
                     fallback.what());
}

IndexTable index_table(const StackDocument& document, const std::vector<double>& wavelengths_nm) {
    try {
        return {document.stack, wavelengths_nm};
    } catch (const DomainError& error) {
        throw_material_error(document, wavelengths_nm, error);
    }
}

StackPower stack_power(const StackDocument& document) {
    try {
        return StackPower(document.stack);
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
}

std::string count_of(std::size_t part, std::size_t all, const std::string& what) {
    return std::to_string(part) + " of " + std::to_string(all) + " " + what;
}

/// Why the vector kernel does not take a request.
std::string why_plain(const StackPower& stack, const Needs& needs, SimdLevel simd) {
    if (simd == SimdLevel::plain) return "IRIDO_SIMD=plain";
    if (needs.layers) return "A_layers";
    if (!stack.chain()) return "spread thicknesses";
    return "groups of many absorbing layers, or phases beyond 1e12";
}

/// How the request was computed, and what its physics spared.
std::vector<std::string> stats_of(const Work& work, const Needs& needs, std::size_t angles,
                                  const std::string& plain_reason) {
    std::vector<std::string> lines;
    const std::string points = std::to_string(work.points) + " points of wavelength and angle, ";
    if (work.kernel == SimdLevel::plain) {
        lines.push_back(points + "one at a time (" + plain_reason + ")");
    } else {
        lines.push_back(points + "side by side (" + std::string(name_of(work.kernel)) + "), " +
                        std::to_string(work.layers) + " layers");
    }
    const auto skipped = [&](const std::string& what) { lines.push_back("skipped: " + what); };
    if (work.normal_angles > 0 && needs.s && needs.p)
        skipped("p at " + count_of(work.normal_angles, angles, "angles (s serves both at 0 deg)"));
    if (!needs.s || !needs.p) skipped(std::string(needs.s ? "p" : "s") + " (not asked for)");
    if (work.kernel == SimdLevel::plain) return lines;
    if (work.one_film) skipped("the recursion over layers (one film: Airy's sum)");
    if (work.mirror)
        skipped("the matrices of layers (a mirror in a host of one of its indices: Yeh's form)");
    if (work.transparent_layers > 0)
        skipped("complex arithmetic in " +
                count_of(work.transparent_layers, work.layers, "layers (transparent)"));
    if (work.distinct_layers < work.layers)
        skipped("matrices of " + count_of(work.layers - work.distinct_layers, work.layers,
                                          "layers (equal to others)"));
    if (work.powers > 0)
        skipped("the repetitions of " + std::to_string(work.powers) +
                " groups (powers in closed form)");
    if (work.constant_media > 0)
        skipped("angle terms of " + count_of(work.constant_media, work.media,
                                             "media but once an angle (no dispersion)"));
    if (!work.absorbs) skipped("absorption (no layer absorbs)");
    if (work.passes > 1)
        lines.push_back(std::to_string(work.passes) +
                        " passes through coherent blocks between incoherent layers");
    return lines;
}

int run_spectrum(const SpectrumOptions& options) {
    resolved_record_format(options.output);
    const std::vector<double> wavelengths = parse_list(
        "--wavelengths", options.wavelengths, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    const std::vector<double> angles = parse_list("--angles", options.angles, 0, kLargestAngle_deg);
    const std::string letters = parse_polarizations(options.polarization);
    const std::vector<SpectrumColumn> columns = parse_spectrum_columns(options.columns);
    const StackDocument document = read_stack(options.stack);
    for (const std::string& text : document.notes) note(text, options.quiet);

    const StackPower stack = stack_power(document);
    const Needs needs = spectrum_needs(letters, columns, stack);
    const IndexTable table = index_table(document, wavelengths);
    const Execution execution = execution_of(options.threads);
    std::vector<double> cosines(angles.size());
    std::ranges::transform(angles, cosines.begin(), cos_of_incidence);
    Spectra spectra;
    try {
        irido::spectra(stack, table, cosines, needs, execution, spectra);
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
    write_records(spectrum_records(wavelengths, angles, letters, columns, spectra), options.output);
    if (options.stats) {
        const Work work = work_of(stack, table, cosines, needs, execution);
        for (const std::string& line :
             stats_of(work, needs, angles.size(), why_plain(stack, needs, execution.simd)))
            std::cerr << "irido: stats: " << line << '\n';
    }
    return 0;
}

}  // namespace

void add_spectrum_command(CLI::App& program, Run& run) {
    CLI::App* command = program.add_subcommand(
        "spectrum", "Reflectance, transmittance and absorptance of a stack (R, T, A).");
    const auto options = std::make_shared<SpectrumOptions>();
    add_stack_options(*command, options->stack);
    command
        ->add_option("-w,--wavelengths", options->wavelengths,
                     "vacuum wavelengths, nm, [1, 1e7]: v, v1,v2, start:stop:step\n"
                     "or start:stop/count [380:780:1]")
        ->type_name("LIST");
    add_angles_option(*command, options->angles);
    command
        ->add_option("-p,--polarization", options->polarization,
                     "s, p, u (unpolarized: the mean of both), several with commas [u]")
        ->type_name("LETTERS");
    command
        ->add_option("--columns", options->columns,
                     "more columns, several with commas, in that order:\n"
                     "r_re r_im t_re t_im  amplitudes of the tangential electric\n"
                     "    field, time factor exp(-i w t), so that r_p = r_s at 0 deg\n"
                     "psi_deg delta_deg  ellipsometric angles, r_p/r_s = tan(psi)\n"
                     "    exp(i delta); delta = 0 at 0 deg (others have 180 there)\n"
                     "A_layers  A_1 A_2 ..., absorbed in each layer, at most 1000\n"
                     "    (np.load needs max_header_size=100000 for more than 500)\n"
                     "All but A_layers need -p s, p or s,p and coherent layers")
        ->type_name("LIST");
    add_output_options(*command, options->output, "csv, json or npy [csv]");
    add_threads_option(*command, options->threads);
    command->add_flag("--stats", options->stats,
                      "say on standard error how it was computed and what was skipped");
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command,
                 {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
                  "irido spectrum \"air | SiO2@25 | Si\" -a 70 -p s --columns psi_deg,delta_deg",
                  "irido spectrum stack.json --set layers.0.thickness_nm=420 -o out.npy"});
    command->callback([options, &run] { run = [options] { return run_spectrum(*options); }; });
}

}  // namespace irido
