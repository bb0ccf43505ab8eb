#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "cli/options/command.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "core/nearest.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/material_database.hpp"
#include "schemas/readers/material_file.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

constexpr WavelengthRange kVisible{380, 780};

struct MaterialsOptions {
    std::string name;
    std::string text;  ///< search text of find
    std::string wavelengths;
    OutputOptions output;
    bool quiet = false;
};

LibraryMaterial material_named(std::string_view name) {
    if (auto found = find_material(name)) return *std::move(found);
    throw UsageError("unknown material '" + std::string(name) + "'" +
                     did_you_mean(name, library_names_and_aliases()) +
                     "; see irido materials list");
}

double year_or_none(int year) {
    return year > 0 ? year : std::numeric_limits<double>::quiet_NaN();
}

int run_list(const MaterialsOptions& options) {
    tables::Column::Texts name, alias, source;
    tables::Column::Numbers first, last, year;
    tables::Column::Flags visible, film;
    for (const std::string_view entry : library_names()) {
        const LibraryMaterial found = material_named(entry);
        const WavelengthRange range = range_of(found.material);
        name.emplace_back(entry);
        alias.push_back(joined(found.aliases, " "));
        first.push_back(range.first_nm);
        last.push_back(range.last_nm);
        visible.push_back(range.first_nm <= kVisible.first_nm && range.last_nm >= kVisible.last_nm);
        source.push_back(found.source);
        year.push_back(year_or_none(found.year));
        film.push_back(found.is_film);
    }
    write_records({{{"name", name},
                    {"aliases", alias},
                    {"first_nm", first},
                    {"last_nm", last},
                    {"covers_380_780", visible},
                    {"source", source},
                    {"year", year},
                    {"film", film}}},
                  options.output);
    return 0;
}

/// The wavelengths given; by default every nm from 380 to 780 within the material's range or, if
/// there are none, a hundred steps over that range.
std::vector<double> wavelengths_of(const MaterialsOptions& options, WavelengthRange range) {
    if (!options.wavelengths.empty())
        return parse_list("--wavelengths", options.wavelengths, kAllWavelengths.first_nm,
                          kAllWavelengths.last_nm);
    std::vector<double> values = parse_list("--wavelengths", "380:780:1", 1, 1e7);
    std::erase_if(values, [&](double v) { return v < range.first_nm || v > range.last_nm; });
    constexpr int kSteps = 100;
    if (values.empty() && range.first_nm == range.last_nm) return {range.first_nm};
    for (int i = 0; values.size() <= static_cast<std::size_t>(i) && i <= kSteps; ++i)
        values.push_back(range.first_nm + (range.last_nm - range.first_nm) * i / kSteps);
    return values;
}

/// A built-in material, a page of the database, or the material in a file.
schemas::MaterialFile shown_material(const std::string& name) {
    if (name.starts_with(schemas::kDatabaseMark)) {
        const std::string path = schemas::database_file(name);
        schemas::MaterialFile page = schemas::read_material_file(
            schemas::read_text(path, schemas::TextSource::regular_file), path);
        page.material.name = name;
        return page;
    }
    if (auto found = find_material(name))
        return {std::move(found->material), {}, std::move(found->source)};
    if (name == "-" || schemas::is_material_file(name))
        return schemas::read_material_file(schemas::read_text(name), schemas::shown_path(name));
    throw UsageError("unknown material '" + name + "'" +
                     did_you_mean(name, library_names_and_aliases()) +
                     "; see irido materials list and find; material files end in .csv, .txt, .tsv, "
                     ".dat, .nk, .mat, "
                     ".yml or .yaml");
}

int run_show(const MaterialsOptions& options) {
    const schemas::MaterialFile shown = shown_material(options.name);
    const WavelengthRange range = range_of(shown.material);
    tables::Column::Numbers wavelength, n, k;
    for (const double nm : wavelengths_of(options, range)) {
        const Complex index = index_at(shown.material, nm);
        wavelength.push_back(nm);
        n.push_back(index.real());
        k.push_back(index.imag());
    }
    std::string lowest, highest;
    tables::append_number(lowest, range.first_nm);
    tables::append_number(highest, range.last_nm);
    note(shown.material.name + ", " + lowest + " to " + highest + " nm" +
             (shown.source.empty() ? "" : ": " + shown.source),
         options.quiet);
    for (const std::string& text : shown.notes)
        note(shown.material.name + ": " + text, options.quiet);
    write_records({{{"wavelength_nm", wavelength}, {"n", n}, {"k", k}}}, options.output);
    return 0;
}

// --- find -----------------------------------------------------------------------------------

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// The words of a text, in lower case, split at punctuation and blanks.
std::vector<std::string> search_words(const std::string& text) {
    std::vector<std::string> words(1);
    for (const char c : lower_case(text)) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
        if (is_letter) {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

/// Whether each wanted word begins a word of the text, or equals one if it has only one or two
/// letters.
bool matches(const std::vector<std::string>& wanted, const std::string& text) {
    const std::vector<std::string> words = search_words(text);
    return std::ranges::all_of(wanted, [&](const std::string& word) {
        return std::ranges::any_of(words, [&](const std::string& other) {
            return word.size() <= 2 ? other == word : other.starts_with(word);
        });
    });
}

/// A search result.
struct FoundMaterial {
    std::string name;
    Material material;
    std::string source;
    int year = 0;
    bool is_film = false;
};

/// The last year given in parentheses in a reference, as in (1972); otherwise the last year.
int year_in(const std::string& reference) {
    int year = 0, in_parentheses = 0;
    for (std::size_t i = 0; i + 4 <= reference.size(); ++i) {
        const auto is_digit = [&](std::size_t at) {
            return at < reference.size() && reference[at] >= '0' && reference[at] <= '9';
        };
        if (!is_digit(i) || !is_digit(i + 1) || !is_digit(i + 2) || !is_digit(i + 3)) continue;
        if (is_digit(i + 4) || (i > 0 && is_digit(i - 1))) continue;
        const int number = std::stoi(reference.substr(i, 4));
        if (number < 1800 || number > 2100) continue;
        year = number;
        if (i > 0 && reference[i - 1] == '(') in_parentheses = number;
    }
    return in_parentheses > 0 ? in_parentheses : year;
}

/// The aliases of a name and of the part before its first dash: silver for Ag-LD.
std::string aliases_of(const LibraryMaterial& entry) {
    std::string words = joined(entry.aliases, " ");
    const std::string& name = entry.material.name;
    if (const auto base = find_material(name.substr(0, name.find('-'))))
        words += " " + joined(base->aliases, " ");
    return words;
}

std::vector<FoundMaterial> found_built_in(const std::vector<std::string>& wanted) {
    std::vector<FoundMaterial> found;
    for (const std::string_view name : library_names()) {
        LibraryMaterial entry = material_named(name);
        const std::string text = entry.material.name + " " + aliases_of(entry) + " " + entry.source;
        if (matches(wanted, text))
            found.push_back({entry.material.name, std::move(entry.material),
                             std::move(entry.source), entry.year, entry.is_film});
    }
    return found;
}

/// Common names of database books that share their name with built-in materials: silver for Ag.
std::string plain_words_of(const schemas::DatabasePage& page) {
    std::string words = page.words;
    for (const std::string& word : search_words(page.name)) {
        for (const std::string_view name : library_names()) {
            if (lower_case(std::string(name)) != word) continue;
            words += " " + joined(material_named(name).aliases, " ");
        }
    }
    return words;
}

void add_found_pages(const std::vector<std::string>& wanted, std::vector<FoundMaterial>& found) {
    if (schemas::material_database().empty()) return;
    for (const schemas::DatabasePage& page : schemas::database_pages()) {
        if (!matches(wanted, plain_words_of(page))) continue;
        try {
            const std::string text =
                schemas::read_text(page.path, schemas::TextSource::regular_file);
            schemas::MaterialFile read = schemas::read_material_file(text, page.path);
            const bool is_film = lower_case(text).find("film") != std::string::npos;
            found.push_back(
                {page.name, std::move(read.material), read.source, year_in(read.source), is_film});
        } catch (const schemas::InputError&) {  // no index usable by irido
        }
    }
}

int run_find(const MaterialsOptions& options) {
    const std::vector<std::string> wanted = search_words(options.text);
    if (wanted.empty()) throw UsageError("TEXT: must have letters or digits");
    std::optional<double> wavelength;
    if (!options.wavelengths.empty())
        wavelength = parse_one_number("--wavelength", options.wavelengths, kAllWavelengths.first_nm,
                                      kAllWavelengths.last_nm);
    std::vector<FoundMaterial> found = found_built_in(wanted);
    add_found_pages(wanted, found);
    tables::Column::Texts name, source;
    tables::Column::Numbers n, k, first, last, year;
    tables::Column::Flags film;
    std::size_t outside = 0;
    for (const FoundMaterial& entry : found) {
        if (wavelength) {
            try {
                const Complex index = index_at(entry.material, *wavelength);
                n.push_back(index.real());
                k.push_back(index.imag());
            } catch (const DomainError&) {
                ++outside;
                continue;
            }
        }
        const WavelengthRange range = range_of(entry.material);
        name.push_back(entry.name);
        first.push_back(range.first_nm);
        last.push_back(range.last_nm);
        year.push_back(year_or_none(entry.year));
        film.push_back(entry.is_film);
        source.push_back(entry.source);
    }
    if (outside > 0)
        note(std::to_string(outside) + " more are not known at that wavelength", options.quiet);
    tables::Records records{{{"name", name}}};
    if (wavelength) {
        records.columns.push_back({"n", n});
        records.columns.push_back({"k", k});
    }
    records.columns.push_back({"first_nm", first});
    records.columns.push_back({"last_nm", last});
    records.columns.push_back({"year", year});
    records.columns.push_back({"film", film});
    records.columns.push_back({"source", source});
    write_records(records, options.output);
    return 0;
}

void add_find(CLI::App& materials, const std::shared_ptr<MaterialsOptions>& options, Run& run) {
    CLI::App* find =
        materials.add_subcommand("find", "Find materials by the words of their names and sources.");
    find->add_option("TEXT", options->text,
                     "words, all of which must occur; one or two letters are a whole word")
        ->required();
    find->add_option("-w,--wavelength", options->wavelengths,
                     "also print n and k at this vacuum wavelength, nm, and leave out what\n"
                     "is not known there")
        ->type_name("NM");
    add_database_option(*find);
    add_output_options(*find, options->output, record_formats_text());
    add_quiet_option(*find, options->quiet);
    set_examples(*find,
                 {"irido materials find silver -w 633", "irido materials find \"johnson 1972\"",
                  "irido materials find gold -w 1550 --database ~/rii"},
                 "film: measured on a film, as far as is known.");
    set_run(*find, run, options, run_find);
}

void add_show(CLI::App& materials, const std::shared_ptr<MaterialsOptions>& options, Run& run) {
    CLI::App* show = materials.add_subcommand(
        "show", "Print n and k of a built-in material or a material file.");
    show->add_option("NAME", options->name,
                     "a built-in material (see irido materials list), a material file\n"
                     "(.csv, .txt, .tsv, .dat, .nk, .mat, .yml), a page of the database\n"
                     "(rii:main/Ag/Johnson), or - for standard input")
        ->required();
    show->add_option("-w,--wavelengths", options->wavelengths,
                     "vacuum wavelengths, nm [380:780:1, within the material's range]")
        ->type_name("LIST");
    offer(*show, "NAME", library_names_and_aliases, OfferedWords::Use::one_or_file);
    add_database_option(*show);
    add_output_options(*show, options->output, record_formats_text());
    add_quiet_option(*show, options->quiet, "no source, range or notes");
    set_examples(*show, {"irido materials show Au -w 400:800:100",
                         "irido materials show water -w 589.3 -f json",
                         "irido materials show schemas/examples/materials/N-BK7.yml"});
    set_run(*show, run, options, run_show);
}

}  // namespace

void add_materials_command(CLI::App& program, Run& run) {
    CLI::App* command =
        program.add_subcommand("materials", "The built-in materials, with source and valid range.");
    command->require_subcommand(1);
    const auto options = std::make_shared<MaterialsOptions>();
    CLI::App* list = command->add_subcommand(
        "list", "List names, ranges in nm, whether 380 to 780 nm is covered, and sources.");
    add_output_options(*list, options->output, record_formats_text());
    set_examples(*list, {"irido materials list", "irido materials list -f json"});
    set_run(*list, run, options, run_list);
    add_show(*command, options, run);
    add_find(*command, options, run);
    set_examples(*command, {"irido materials list", "irido materials show Au -w 400:800:100",
                            "irido materials find silver -w 633"});
}

}  // namespace irido::cli
