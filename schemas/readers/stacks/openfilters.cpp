#include "schemas/readers/stacks/openfilters.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/material/library.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stacks/stack_writing.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

constexpr double kSubstrate_nm = 1e6;
constexpr std::size_t kLongestOpenFiltersName = 64;

bool same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) {
        const auto lower = [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        };
        return lower(x) == lower(y);
    });
}

/// A line "Keyword: value", or a block of them.
struct ProjectEntry {
    TextLine line;
    std::string_view keyword, value;
    std::vector<ProjectEntry> block;
};

/// The lines of a project as a tree.
class ProjectText {
public:
    ProjectText(std::string_view text, const std::string& file)
        : file_(file), lines_(lines_of(text)) {
        entries = read_block(nullptr);
    }

    std::vector<ProjectEntry> entries;

private:
    /// is_text  lines are not parted at their colons and open no blocks
    std::vector<ProjectEntry> read_block(const TextLine* opened, bool is_text = false) {
        std::vector<ProjectEntry> found;
        while (at_ < lines_.size()) {
            const TextLine& line = lines_[at_++];
            const std::string_view text = trimmed(line.text);
            if (text.empty()) continue;
            if (same_word(text, "end")) {
                if (opened) return found;
                throw InputError(file_, place_of(line, text), "End without a block");
            }
            const std::size_t colon = text.find(':');
            if (is_text || colon == std::string_view::npos) {
                found.push_back({line, {}, text, {}});  // a line of free text
                continue;
            }
            ProjectEntry entry{
                line, trimmed(text.substr(0, colon)), trimmed(text.substr(colon + 1)), {}};
            // blocks have nothing behind their colon, and descriptions may be empty
            const bool is_description = entry.keyword.ends_with("Description");
            if (entry.value.empty() && !is_description)
                entry.block = read_block(&line, same_word(entry.keyword, "Comment"));
            found.push_back(std::move(entry));
        }
        if (opened) throw InputError(file_, place_of(*opened, trimmed(opened->text)), "has no End");
        return found;
    }

    const std::string& file_;
    std::vector<TextLine> lines_;
    std::size_t at_ = 0;
};

const ProjectEntry* find_entry(const std::vector<ProjectEntry>& entries, std::string_view keyword) {
    const auto found = std::ranges::find_if(
        entries, [&](const ProjectEntry& entry) { return same_word(entry.keyword, keyword); });
    return found == entries.end() ? nullptr : &*found;
}

std::string_view value_or(const std::vector<ProjectEntry>& entries, std::string_view keyword,
                          std::string_view otherwise) {
    const ProjectEntry* const found = find_entry(entries, keyword);
    return found ? found->value : otherwise;
}

const ProjectEntry& chosen_filter(const std::vector<ProjectEntry>& entries, const std::string& file,
                                  const std::string& wanted) {
    const ProjectEntry* chosen = nullptr;
    std::size_t count = 0;
    std::string names;
    for (const ProjectEntry& entry : entries) {
        if (!same_word(entry.keyword, "Filter")) continue;
        const std::string name(value_or(entry.block, "Description", ""));
        if (++count == 1 || (!wanted.empty() && name == wanted)) chosen = &entry;
        if (!wanted.empty() && name == wanted) return entry;
        names += (names.empty() ? "" : ", ") + name;
    }
    if (!chosen) throw InputError(file, "", "has no Filter");
    if (!wanted.empty()) throw InputError(file, "", "has no filter " + wanted + ", only " + names);
    if (count > 1) throw InputError(file, "", "has several filters; choose one of " + names);
    return *chosen;
}

/// Builds the document of a filter.
class FilterReader {
public:
    FilterReader(const std::string& file, const StackReadOptions& options)
        : file_(file), options_(options) {}

    StackFile read(const std::vector<ProjectEntry>& filter) {
        json front = layers_of(filter, "Front"), back = layers_of(filter, "Back");
        std::reverse(front.begin(), front.end());
        const ProjectEntry* const substrate = find_entry(filter, "Substrate");
        if (!substrate) throw InputError(file_, "", "the filter has no Substrate");
        const auto [material, thickness_nm] = material_and_thickness(*substrate);
        json& document = result_.document;
        document["incident"] = medium(filter, "FrontMedium");
        if (value_or(filter, "ConsiderBackside", "0") == "1") {
            front.push_back(
                {{"material", material}, {"thickness_nm", thickness_nm}, {"coherent", false}});
            for (json& layer : back) front.push_back(std::move(layer));
            document["substrate"] = medium(filter, "BackMedium");
        } else {
            document["substrate"] = material;
            result_.notes.push_back(file_ + ": without ConsiderBackside the substrate has no end" +
                                    (back.empty() ? "" : ", and the back layers are left out"));
        }
        document["layers"] = std::move(front);
        const std::string_view name = value_or(filter, "Description", "");
        if (!name.empty()) document["name"] = std::string(name);
        if (!materials_.empty()) document["materials"] = materials_;
        return std::move(result_);
    }

private:
    [[noreturn]] void fail(const ProjectEntry& entry, const std::string& message) const {
        throw InputError(file_, place_of(entry.line, trimmed(entry.line.text)), message);
    }

    /// Lines FrontLayer or BackLayer, in their order.
    json layers_of(const std::vector<ProjectEntry>& filter, const std::string& side) {
        json layers = json::array();
        for (const ProjectEntry& entry : filter) {
            if (same_word(entry.keyword, side + "GradedLayer"))
                fail(entry, "graded layers are not read");
            if (!same_word(entry.keyword, side + "Layer")) continue;
            const auto [material, thickness_nm] = material_and_thickness(entry);
            layers.push_back({{"material", material}, {"thickness_nm", thickness_nm}});
        }
        return layers;
    }

    std::pair<json, double> material_and_thickness(const ProjectEntry& entry) {
        std::string_view rest = entry.value;
        std::vector<std::string_view> words;
        for (; !rest.empty(); rest = trimmed(rest)) {
            words.push_back(rest.substr(0, rest.find_first_of(" \t")));
            rest.remove_prefix(words.back().size());
        }
        if (words.size() == 3) fail(entry, "layers of mixtures are not read");
        const auto thickness_nm = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
        if (!thickness_nm || *thickness_nm < 0)
            fail(entry, "must be a material and its thickness in nm");
        return {named(entry, std::string(words[0])), *thickness_nm};
    }

    json medium(const std::vector<ProjectEntry>& filter, std::string_view keyword) {
        const ProjectEntry* const entry = find_entry(filter, keyword);
        return entry ? named(*entry, std::string(entry->value)) : json("vacuum");
    }

    /// A material's file, or the built-in material of that name.
    json named(const ProjectEntry& entry, const std::string& name) {
        if (options_.media.contains(name) || materials_.contains(name)) return name;
        if (name == "void") return "vacuum";
        const std::filesystem::path folder = options_.folder.empty()
                                                 ? std::filesystem::path(file_).parent_path()
                                                 : std::filesystem::path(options_.folder);
        std::error_code ignored;
        const std::filesystem::path place = folder / (name + ".mat");
        if (std::filesystem::exists(place, ignored)) {
            const std::string shown =
                options_.folder.empty() ? name + ".mat" : std::filesystem::absolute(place).string();
            materials_[name] = {{"file", shown}};
            return name;
        }
        const std::string own = built_in_name(name);
        if (own.empty())
            fail(entry, "there is no file " + place.string() + ", and no built-in material " +
                            name + "; give its folder with --material-folder, or --material " +
                            name + "=...");
        result_.notes.push_back(file_ + ": there is no file " + place.string() + ": the built-in " +
                                own + " is taken");
        return own;
    }

    static std::string built_in_name(const std::string& name) {
        for (const std::string& known : library_names_and_aliases()) {
            std::string letters;
            for (const char c : known)
                if (c != '-') letters += c;
            if (same_word(known, name) || same_word(letters, name)) return known;
        }
        return "";
    }

    const std::string& file_;
    const StackReadOptions& options_;
    json materials_ = json::object();
    StackFile result_;
};

/// "2.4-0.01j", where loss is negative.
std::string complex_text(double n, double k) {
    if (k == 0) return to_text(n);
    return to_text(n) + (k > 0 ? "-" : "+") + to_text(std::abs(k)) + "j";
}

/// "Model: ...\nProperties: ..." of a formula that OpenFilters has; "" for any other material.
std::string formula_text(const Material& material) {
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    const Formula* const formula = index ? std::get_if<Formula>(&index->n) : nullptr;
    if (!formula || index->k != Dispersion(Constant{0}) || formula->reference != Reference{})
        return "";
    std::vector<double> numbers;
    const std::vector<double>& c = formula->coefficients;
    if (formula->number == 5 && c.size() <= 5) {
        numbers = {c.empty() ? 0 : c[0], 0, 0};
        for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
            if (c[i + 1] != -2 && c[i + 1] != -4) return "";
            numbers[c[i + 1] == -2 ? 1 : 2] += c[i];
        }
    } else if ((formula->number == 1 || formula->number == 2) && c.size() <= 7 &&
               (c.empty() || c[0] == 0)) {
        numbers.resize(6);
        for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
            numbers[i - 1] = c[i];
            numbers[i] = formula->number == 1 ? c[i + 1] * c[i + 1] : c[i + 1];
        }
    } else {
        return "";
    }
    std::string text =
        formula->number == 5 ? "Model: Cauchy\nProperties:" : "Model: Sellmeier\nProperties:";
    for (const double number : numbers) text += " " + to_text(number);
    return text + "\n";
}

/// A name must not begin lines of its own.
std::string on_one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

std::string material_text(const Material& material, WavelengthRange range, Losses& losses) {
    std::string text = "Description: " + on_one_line(name_in_words(material)) + "\nKind: regular\n";
    const std::string formula = formula_text(material);
    if (!formula.empty()) {
        losses.add("the range of " + name_in_words(material));
        return text + formula;
    }
    const auto rows = index_rows_within(material, range);
    if (is_constant(material))
        return text + "Model: constant\nProperties: " + complex_text(rows[0][1], rows[0][2]) + "\n";
    losses.add("lines between the rows of " + name_in_words(material) + " (monotone cubics)");
    text += "Model: table\nProperties:\n";
    for (const auto& [nm, n, k] : rows)
        text += "\t" + to_text(nm) + "\t" + complex_text(n, k) + "\n";
    return text + "End\n";
}

/// A stack as OpenFilters sees it.
struct Filter {
    std::vector<Layer> front, back;  ///< from the incident side on
    std::size_t substrate = 0, behind = 0;
    double substrate_nm = kSubstrate_nm;
    bool has_back = false;
};

Filter filter_of(const Stack& stack, Losses& losses) {
    Filter filter;
    filter.substrate = filter.behind = stack.substrate;
    for (const Layer& layer : layers_written_out(stack, losses)) {
        if (!layer.coherent && !filter.has_back) {
            filter.substrate = layer.material;
            filter.substrate_nm = layer.thickness_nm;
            filter.has_back = true;
            continue;
        }
        if (!layer.coherent) losses.add("\"coherent\": false of a second layer");
        (filter.has_back ? filter.back : filter.front).push_back(layer);
    }
    if (!filter.has_back) losses.add("a substrate without an end: it is 1 mm, its back left out");
    return filter;
}

}  // namespace

StackFile read_openfilters(std::string_view text, const std::string& file,
                           const StackReadOptions& options) {
    const ProjectText project(text, file);
    const ProjectEntry& filter = chosen_filter(project.entries, file, options.coating);
    StackFile result = FilterReader(file, options).read(filter.block);
    if (find_entry(project.entries, "Target"))
        result.notes.push_back(file + ": targets are left out");
    return result;
}

WrittenStack write_openfilters(const Stack& stack, const StackWriteOptions& options) {
    Losses losses;
    const Filter filter = filter_of(stack, losses);
    std::vector<std::string> names = plain_names(stack, kLongestOpenFiltersName);
    std::vector<bool> is_used(stack.materials.size());
    for (std::size_t m = 0; m < names.size(); ++m)
        if (is_constant(stack.materials[m]) && index_at(stack.materials[m], 550) == Complex(1))
            names[m] = "void";
    const auto use = [&](std::size_t material) {
        is_used[material] = true;
        return names[material];
    };
    const auto line = [&](const std::string& keyword, const Layer& layer) {
        return "\t" + keyword + ": " + use(layer.material) + " " +
               plain_number(layer.thickness_nm) + "\n\tRefineThickness: 1\n\tAddNeedles: 0\n";
    };
    std::string text =
        "Version: 1.1\nFilter:\n\tDescription: " + on_one_line(options.name) +
        "\n\tSubstrate: " + use(filter.substrate) + " " + plain_number(filter.substrate_nm) +
        "\n\tFrontMedium: " + use(stack.incident) + "\n\tBackMedium: " + use(filter.behind) +
        "\n\tCenterWavelength: 550\n\tWavelengthRange: 300 1000 1\n"
        "\tDontConsiderSubstrate: 0\n\tStepSpacing: 0.01\n\tMinimumThickness: 0\n"
        "\tIlluminant: CIE-D65\n\tObserver: CIE-1931\n\tConsiderBackside: " +
        (filter.has_back ? "1" : "0") +
        "\n\tEllipsometerType: 1\n\tDeltaMin: -90\n"
        "\tConsiderBacksideOnMonitoring: 1\n\tMonitoringEllipsometerType: 1\n"
        "\tMonitoringDeltaMin: -90\n\tMonitoringSublayerThickness: 1\n";
    for (auto layer = filter.front.rbegin(); layer != filter.front.rend(); ++layer)
        text += line("FrontLayer", *layer);
    for (const Layer& layer : filter.back) text += line("BackLayer", layer);
    text += "End\n";
    WrittenStack result{std::move(text)};
    for (std::size_t m = 0; m < names.size(); ++m) {
        if (!is_used[m] || names[m] == "void") continue;
        note_name(stack.materials[m], names[m], losses);
        result.beside.push_back(
            {names[m] + ".mat", material_text(stack.materials[m], options.range, losses)});
    }
    result.losses = losses.take();
    return result;
}

}  // namespace irido::schemas
