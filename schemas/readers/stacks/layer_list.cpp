#include "schemas/readers/stacks/layer_list.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.hpp"
#include "core/material/library.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/stack_expression.hpp"
#include "schemas/readers/stacks/stack_writing.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

/// The cells of a line; one that begins with a quote ends with one, doubled ones inside.
std::vector<std::string> list_cells(const std::string& file, const TextLine& line, char separator) {
    std::vector<std::string> cells;
    std::string_view rest = line.text;
    for (bool is_more = true; is_more;) {
        rest = trimmed(rest);
        std::string cell;
        if (rest.starts_with('"')) {
            const std::string_view opening = rest;
            for (rest.remove_prefix(1);; rest.remove_prefix(1)) {
                if (rest.empty())
                    throw InputError(file, place_of(line, opening), "the quote is never closed");
                if (rest.starts_with("\"\"")) {
                    rest.remove_prefix(1);
                } else if (rest[0] == '"') {
                    rest.remove_prefix(1);
                    break;
                }
                cell += rest[0];
            }
        }
        const std::size_t end = rest.find(separator);
        cell += trimmed(rest.substr(0, end));
        is_more = end != std::string_view::npos;
        rest.remove_prefix(is_more ? end + 1 : rest.size());
        cells.push_back(std::move(cell));
    }
    return cells;
}

enum class ListColumn { layer, material, nm, um, qwot, sigma, coherent };

std::optional<ListColumn> list_column(const std::string& name) {
    constexpr std::array<std::pair<std::string_view, ListColumn>, 13> kNames{
        {{"layer", ListColumn::layer},
         {"#", ListColumn::layer},
         {"material", ListColumn::material},
         {"thickness nm", ListColumn::nm},
         {"d nm", ListColumn::nm},
         {"thickness", ListColumn::nm},
         {"thickness um", ListColumn::um},
         {"d um", ListColumn::um},
         {"qwot", ListColumn::qwot},
         {"thickness qwot", ListColumn::qwot},
         {"thickness sigma nm", ListColumn::sigma},
         {"coherent", ListColumn::coherent},
         {"index", ListColumn::layer}}};
    const std::string words = plain_words(name);
    const auto* const found =
        std::ranges::find(kNames, words, &std::pair<std::string_view, ListColumn>::first);
    if (found == kNames.end()) return std::nullopt;
    return found->second;
}

/// A list that is being read.
class LayerList {
public:
    LayerList(std::string_view text, const std::string& file, const StackReadOptions& options)
        : file_(file), options_(options) {
        for (const TextLine& line : lines_of(text)) {
            const std::string_view content = trimmed(line.text);
            if (content.empty() || content.starts_with('#')) continue;
            if (columns_.empty()) {
                read_header(line);
            } else {
                read_row(line);
            }
        }
        if (columns_.empty())
            throw InputError(file_, "", "must have a header: layer,material,thickness_nm");
    }

    StackFile take() {
        StackFile result;
        const bool has_incident = !rows_.empty() && rows_.front().is_medium,
                   has_substrate = rows_.size() > 1 && rows_.back().is_medium;
        if (!has_incident || !has_substrate)
            result.notes.push_back(file_ + ": the media around are not in the list: " +
                                   (has_incident    ? "BK7"
                                    : has_substrate ? "air"
                                                    : "air and BK7") +
                                   " (--set substrate=... gives another one)");
        json layers = json::array();
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const bool is_end =
                (i == 0 && has_incident) || (i + 1 == rows_.size() && has_substrate);
            if (is_end) continue;
            if (rows_[i].is_medium)
                fail(rows_[i].line, rows_[i].line.text, "the layer has no thickness");
            layers.push_back(std::move(rows_[i].layer));
        }
        result.document = {
            {"incident", has_incident ? rows_.front().layer["material"] : json("air")},
            {"layers", std::move(layers)},
            {"substrate", has_substrate ? rows_.back().layer["material"] : json("BK7")}};
        return result;
    }

private:
    struct ListRow {
        TextLine line;
        json layer;
        bool is_medium = false;
    };

    [[noreturn]] void fail(const TextLine& line, std::string_view part,
                           const std::string& message) const {
        throw InputError(file_, place_of(line, part), message);
    }

    void read_header(const TextLine& line) {
        for (const char separator : {';', '\t'})
            if (line.text.find(separator) != std::string_view::npos) separator_ = separator;
        bool has_material = false, has_thickness = false;
        for (const std::string& name : list_cells(file_, line, separator_)) {
            const auto column = list_column(name);
            if (!column)
                fail(line, line.text,
                     "columns must be layer, material, thickness_nm, thickness_um, qwot, "
                     "thickness_sigma_nm or coherent (got " +
                         in_quotes(name) + ")");
            if (std::ranges::find(columns_, *column) != columns_.end())
                fail(line, line.text, "duplicate column " + in_quotes(name));
            has_material = has_material || *column == ListColumn::material;
            const bool is_thickness = *column == ListColumn::nm || *column == ListColumn::um ||
                                      *column == ListColumn::qwot;
            if (is_thickness && has_thickness) fail(line, line.text, "has two thicknesses");
            has_thickness = has_thickness || is_thickness;
            columns_.push_back(*column);
        }
        if (!has_material || !has_thickness)
            fail(line, line.text, "must have a header with material and thickness_nm");
    }

    void read_row(const TextLine& line) {
        const std::vector<std::string> cells = list_cells(file_, line, separator_);
        if (cells.size() > columns_.size()) fail(line, line.text, "has more cells than the header");
        ListRow row{line, json::object(), true};
        double qwot = -1;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::string& cell = cells[c];
            if (cell.empty() || columns_[c] == ListColumn::layer) continue;
            if (columns_[c] == ListColumn::material) {
                json index = parse_index(cell);
                row.layer["material"] = index.is_null() ? json(cell) : std::move(index);
            } else if (columns_[c] == ListColumn::coherent) {
                if (cell != "true" && cell != "false")
                    fail(line, line.text,
                         "coherent must be true or false (got " + in_quotes(cell) + ")");
                if (cell == "false") row.layer["coherent"] = false;
            } else {
                std::string decimal = cell;
                if (separator_ == ';') std::ranges::replace(decimal, ',', '.');
                const auto value = parse_number(decimal);
                if (!value || *value < 0)
                    fail(line, line.text,
                         "must be a number, at least 0 (got " + in_quotes(cell) + ")");
                if (columns_[c] == ListColumn::sigma) {
                    if (*value != 0) row.layer["thickness_sigma_nm"] = *value;
                    continue;
                }
                row.is_medium = false;
                if (columns_[c] == ListColumn::qwot) {
                    qwot = *value;
                } else {
                    row.layer["thickness_nm"] =
                        columns_[c] == ListColumn::um ? shifted(*value, 3) : *value;
                }
            }
        }
        if (!row.layer.contains("material")) fail(line, line.text, "the row has no material");
        if (qwot >= 0) row.layer["thickness_nm"] = quarter_waves(line, row.layer["material"], qwot);
        rows_.push_back(std::move(row));
    }

    /// The thickness of that many quarter waves, nm.
    double quarter_waves(const TextLine& line, const json& material, double count) const {
        if (!(options_.primary_nm > 0))
            fail(line, line.text,
                 "the thickness is in quarter waves: --primary NM gives their wavelength");
        std::optional<double> n;
        if (material.is_number()) n = material.get<double>();
        if (material.is_object()) n = material["n"].get<double>();
        if (material.is_string())
            if (const auto found = find_material(material.get<std::string>()))
                n = index_at(found->material, options_.primary_nm).real();
        if (!n || *n <= 0)
            fail(
                line, line.text,
                "quarter waves need an index or a built-in material (got " + material.dump() + ")");
        return count * options_.primary_nm / (4 * *n);
    }

    const std::string& file_;
    const StackReadOptions& options_;
    char separator_ = ',';
    std::vector<ListColumn> columns_;
    std::vector<ListRow> rows_;
};

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

StackFile read_layer_list(std::string_view text, const std::string& file,
                          const StackReadOptions& options) {
    return LayerList(text, file, options).take();
}

WrittenStack write_layer_list(const Stack& stack, const StackWriteOptions&) {
    Losses losses, no_losses;
    const std::vector<Layer> layers = layers_written_out(stack, no_losses);
    for (const std::string& loss : no_losses.take())
        if (loss != "thickness_sigma_nm") losses.add(loss);
    const bool has_sigma = std::ranges::any_of(
                   layers, [](const Layer&layer) { return layer.thickness_sigma_nm != 0; }),
               has_coherent =
                   std::ranges::any_of(layers, [](const Layer&layer) { return !layer.coherent; });
    std::vector<std::string> names;
    for (const Material& material : stack.materials) {
        std::vector<std::string> lost;
        names.push_back(csv_cell(medium_text(material, lost)));
        for (const std::string& loss : lost) losses.add(loss);
    }
    std::string text = "layer,material,thickness_nm";
    text += has_sigma ? ",thickness_sigma_nm" : "";
    text += has_coherent ? ",coherent\n" : "\n";
    const std::string ending = std::string(has_sigma ? "," : "") + (has_coherent ? "," : "") + "\n";
    text += "0," + names[stack.incident] + "," + ending;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        text += std::to_string(i + 1) + "," + names[layers[i].material] + "," +
                plain_number(layers[i].thickness_nm);
        if (has_sigma) text += "," + to_text(layers[i].thickness_sigma_nm);
        if (has_coherent) text += layers[i].coherent ? ",true" : ",false";
        text += "\n";
    }
    text += std::to_string(layers.size() + 1) + "," + names[stack.substrate] + "," + ending;
    WrittenStack result{std::move(text)};
    result.losses = losses.take();
    return result;
}

}  // namespace irido::schemas
