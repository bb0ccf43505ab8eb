#include "schemas/readers/stacks/stack_writing.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

constexpr std::size_t kMostWrittenLayers = 10'000;
constexpr double kOpaqueFrom_k = 1e-3;

void write_out(const std::vector<Element>& elements, std::vector<Layer>& layers, Losses& losses) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->thickness_sigma_nm != 0) losses.add("thickness_sigma_nm");
            if (layers.size() >= kMostWrittenLayers)
                throw InputError("", "",
                                 "must have at most 10000 layers, groups written out, in this "
                                 "format");
            layers.push_back(*layer);
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        if (group.repeat > 1) losses.add("groups (their layers are written out)");
        for (std::uint64_t i = 0; i < group.repeat && !group.elements.empty(); ++i)
            write_out(group.elements, layers, losses);
    }
}

/// Adds rows between two existing ones until linear interpolation is good enough.
class Refinement {
public:
    explicit Refinement(const Material& material) : material_(material) {}

    std::array<double, 3> row(double nm) const {
        const Complex index = index_at(material_, nm);
        return {nm, index.real(), index.imag()};
    }

    void add(const std::array<double, 3>& from, const std::array<double, 3>& to, int depth,
             std::vector<std::array<double, 3>>& rows) const {
        constexpr double kTolerance = 1e-5;
        constexpr int kDeepestSplit = 14;
        if (depth >= kDeepestSplit) return;
        double worst = 0;
        for (const double part : {0.25, 0.5, 0.75}) {
            const auto here = row(from[0] + part * (to[0] - from[0]));
            for (const std::size_t value : {std::size_t{1}, std::size_t{2}})
                worst = std::max(
                    worst, std::abs(here[value] - from[value] - part * (to[value] - from[value])));
        }
        if (worst <= kTolerance) return;
        const auto middle = row(round_step(from[0], to[0]));
        if (middle[0] <= from[0] || middle[0] >= to[0]) return;
        add(from, middle, depth + 1, rows);
        rows.push_back(middle);
        add(middle, to, depth + 1, rows);
    }

private:
    /// A wavelength near the middle, with few decimals.
    static double round_step(double from, double to) {
        const double middle = (from + to) / 2;
        for (const double unit : {100.0, 10.0, 1.0, 0.1, 0.01}) {
            const double rounded = std::round(middle / unit) * unit;
            if (std::abs(rounded - middle) < (to - from) / 8) return std::stod(to_text(rounded));
        }
        return middle;
    }

    const Material& material_;
};

std::string shown_name(const Material& material) {
    constexpr std::string_view kOwn = "/materials/";  // pointer of one of the document's materials
    if (material.name.starts_with(kOwn)) return material.name.substr(kOwn.size());
    if (material.name.starts_with("/layers/") || material.name.empty()) return "M";
    const std::size_t slash = material.name.find_last_of('/');
    std::string name = material.name.substr(slash == std::string::npos ? 0 : slash + 1);
    if (const std::size_t dot = name.find_last_of('.');
        dot != std::string::npos && dot > 0 && !std::isdigit(static_cast<unsigned char>(name[0])))
        name.resize(dot);
    return name;
}

std::string in_capitals(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

void Losses::add(const std::string& what) {
    if (std::ranges::find(all_, what) == all_.end()) all_.push_back(what);
}

std::vector<Layer> layers_written_out(const Stack& stack, Losses& losses) {
    std::vector<Layer> layers;
    write_out(stack.elements, layers, losses);
    return layers;
}

bool is_opaque(const Material& material) {
    const WavelengthRange known = range_of(material);
    const double nm = std::clamp(550.0, known.first_nm, std::max(known.first_nm, known.last_nm));
    return index_at(material, nm).imag() >= kOpaqueFrom_k;
}

std::vector<std::array<double, 3>> index_rows_within(const Material& material,
                                                     WavelengthRange range) {
    if (is_constant(material)) {
        const Complex index = index_at(material, 550);
        return {{550, index.real(), index.imag()}};
    }
    const WavelengthRange known = range_of(material);
    const double first = std::max(known.first_nm, range.first_nm),
                 last = std::min(known.last_nm, range.last_nm);
    if (!(first <= last))
        throw InputError(material.name, "",
                         "is not known from " + to_text(range.first_nm) + " to " +
                             to_text(range.last_nm) + " nm");
    const Refinement refinement(material);
    std::vector<double> ends{first};
    for (const double row : table_rows(material, {first, last})) ends.push_back(row);
    if (last > first) ends.push_back(last);
    std::vector<std::array<double, 3>> rows{refinement.row(first)};
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const auto end = refinement.row(ends[i]), begin = rows.back();
        refinement.add(begin, end, 0, rows);
        rows.push_back(end);
    }
    return rows;
}

std::string plain_name(const std::string& text, std::size_t longest) {
    std::string name;
    for (const char c : text) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 && (c & 0x80) == 0;
        if (is_plain || (!name.empty() && name.back() != '_')) name += is_plain ? c : '_';
    }
    while (name.ends_with('_')) name.pop_back();
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) name = "N" + name;
    if (name.size() > longest) name.resize(longest);
    return name;
}

std::vector<std::string> plain_names(const Stack& stack, std::size_t longest) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Material& material : stack.materials) {
        const std::string wanted = plain_name(shown_name(material), longest);
        std::string name = wanted;
        for (int i = 2; !taken.insert(in_capitals(name)).second; ++i) {
            const std::string ending = "_" + std::to_string(i);
            name = wanted.substr(0, longest - ending.size()) + ending;
        }
        names.push_back(std::move(name));
    }
    return names;
}

std::string plain_number(double value) {
    std::array<char, 400> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    return error == std::errc() ? std::string(text.data(), end) : to_text(value);
}

void note_name(const Material& material, const std::string& name, Losses& losses) {
    if (name != shown_name(material))
        losses.add("the name " + name_in_words(material) + ", which becomes " + name);
}

std::string name_in_words(const Material& material) {
    return shown_name(material);
}

}  // namespace irido::schemas
