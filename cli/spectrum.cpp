#include <memory>

#include "cli/command.hpp"
#include "core/error.hpp"
#include "core/interference/spectrum.hpp"
#include "core/math/parallel.hpp"
#include "schemas/input_error.hpp"
#include "schemas/number.hpp"

namespace irido {

namespace {

struct SpectrumOptions {
    StackRequest stack;
    std::string wavelengths = "380:780:1";
    std::string angles = "0";
    std::string polarization = "u";
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// The letters of "s,p,u" in the order typed.
std::string parse_polarizations(std::string_view text) {
    std::string letters;
    for (std::string_view rest = text;; rest.remove_prefix(1)) {
        const std::string_view item = rest.substr(0, rest.find(','));
        if (item != "s" && item != "p" && item != "u")
            throw UsageError("--polarization: must be s, p, u or several with commas (got '" +
                             std::string(text) + "')");
        letters += item;
        rest.remove_prefix(item.size());
        if (rest.empty()) return letters;
    }
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

/// Responses [angle][wavelength].
std::vector<Polarized> compute(const StackDocument& document, const IndexTable& table,
                               const std::vector<double>& angles_deg, Needs needs,
                               unsigned threads) {
    const std::size_t count = table.wavelength_nm().size();
    std::vector<Polarized> responses(angles_deg.size() * count);
    try {
        const StackPower stack(document.stack);
        parallel_for(angles_deg.size(), responses.size() < 256 ? 1 : threads, [&](std::size_t i) {
            power_spectrum(stack, table, cos_of_incidence(angles_deg[i]), needs,
                           std::span(responses).subspan(i * count, count));
        });
    } catch (const DomainError& error) {
        throw InputError(document.file, "", error.what());
    }
    return responses;
}

Power in_polarization(const Polarized& power, char letter) {
    return letter == 's' ? power.s.power : letter == 'p' ? power.p.power : power.unpolarized();
}

Records to_records(const std::vector<double>& wavelengths_nm, const std::vector<double>& angles_deg,
                   const std::string& letters, const std::vector<Polarized>& powers) {
    Column::Numbers wavelength, angle, r, t, a;
    Column::Texts polarization;
    for (std::size_t i = 0; i < angles_deg.size(); ++i) {
        for (const char letter : letters) {
            for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
                const Power power = in_polarization(powers[i * wavelengths_nm.size() + w], letter);
                wavelength.push_back(wavelengths_nm[w]);
                angle.push_back(angles_deg[i]);
                polarization.emplace_back(1, letter);
                r.push_back(power.R);
                t.push_back(power.T);
                a.push_back(power.A);
            }
        }
    }
    return {{{"wavelength_nm", std::move(wavelength)},
             {"angle_deg", std::move(angle)},
             {"polarization", std::move(polarization)},
             {"R", std::move(r)},
             {"T", std::move(t)},
             {"A", std::move(a)}}};
}

int run_spectrum(const SpectrumOptions& options) {
    resolved_record_format(options.output);
    const std::vector<double> wavelengths = parse_list(
        "--wavelengths", options.wavelengths, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    const std::vector<double> angles = parse_list("--angles", options.angles, 0, kLargestAngle_deg);
    const std::string letters = parse_polarizations(options.polarization);
    const StackDocument document = read_stack(options.stack);
    for (const std::string& text : document.notes) note(text, options.quiet);

    const bool mean = letters.find('u') != std::string::npos;
    const Needs needs{mean || letters.find('s') != std::string::npos,
                      mean || letters.find('p') != std::string::npos};
    const std::vector<Polarized> powers =
        compute(document, index_table(document, wavelengths), angles, needs, options.threads);
    write_records(to_records(wavelengths, angles, letters, powers), options.output);
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
    add_output_options(*command, options->output, "csv, json or npy [csv]");
    add_threads_option(*command, options->threads);
    command->add_flag("--quiet", options->quiet, "no notes on standard error");
    set_examples(*command,
                 {"irido spectrum \"air | SiO2@100 | Si\" -w 380:780:5 -a 0,45 -p s,p",
                  "irido spectrum stack.json --set layers.0.thickness_nm=420 -o out.npy"});
    command->callback([options, &run] { run = [options] { return run_spectrum(*options); }; });
}

}  // namespace irido
