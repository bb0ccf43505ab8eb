#include "schemas/refractiveindex_info.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/number.hpp"

namespace irido {

namespace {

/// Coefficients that formulas 1 to 9 define at most.
constexpr std::array<std::size_t, 9> kMostCoefficients = {17, 17, 17, 17, 11, 11, 6, 4, 6};

/// What one item of DATA gives.
struct Item {
    std::optional<Dispersion> n;
    std::optional<Dispersion> k;
};

/// Where in the file we are, and what was done so far.
struct Reader {
    const std::string& file;
    std::vector<std::string> notes;
    std::string where;

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(file, where, message);
    }
};

/// Vacuum wavelength in nm, the decimal point moved instead of a product rounded: 0.57 gives 570.
double to_nm(double um) {
    std::array<char, 40> text{};
    char* end = std::to_chars(text.data(), text.data() + 32, um, std::chars_format::scientific).ptr;
    char* const exponent = std::find(text.data(), end, 'e') + 1;
    int power = 0;
    std::from_chars(exponent + (*exponent == '+' ? 1 : 0), end, power);
    end = std::to_chars(exponent, text.data() + text.size(), power + 3).ptr;
    return parse_number({text.data(), end}).value_or(um * 1000);
}

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// The numbers of one line, which must be numbers altogether.
std::vector<double> numbers_of(std::string_view line, const Reader& reader) {
    std::vector<double> numbers;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const std::string_view token = line.substr(0, line.find_first_of(" \t"));
        const auto number = parse_number(token);
        if (!number) reader.fail("must be a number (got " + in_quotes(token) + ")");
        numbers.push_back(*number);
        line.remove_prefix(token.size());
    }
    return numbers;
}

std::string text_of(const YAML::Node& item, const char* key, const Reader& reader) {
    const YAML::Node value = item[key];
    if (!value || !value.IsScalar()) reader.fail(std::string("needs the text '") + key + "'");
    return value.Scalar();
}

WavelengthRange range_of(const YAML::Node& item, const Reader& reader) {
    const auto ends = numbers_of(text_of(item, "wavelength_range", reader), reader);
    if (ends.size() != 2 || !(ends[0] > 0) || !(ends[0] <= ends[1]))
        reader.fail("wavelength_range must be two increasing wavelengths in um");
    return {to_nm(ends[0]), to_nm(ends[1])};
}

Item formula_item(const YAML::Node& item, std::string_view number, const Reader& reader) {
    if (number.size() != 1 || number[0] < '1' || number[0] > '9')
        reader.fail("formula must be 1 to 9 (got " + in_quotes(number) + ")");
    const int index = number[0] - '0';
    auto coefficients = numbers_of(text_of(item, "coefficients", reader), reader);
    const std::size_t most = kMostCoefficients[static_cast<std::size_t>(index - 1)];
    if (coefficients.empty() || coefficients.size() > most)
        reader.fail("formula " + std::to_string(index) + " must have 1 to " + std::to_string(most) +
                    " coefficients (got " + std::to_string(coefficients.size()) + ")");
    return {Formula{index, std::move(coefficients), range_of(item, reader)}, std::nullopt};
}

/// A row of a table: a wavelength in nm and one or two values.
using Row = std::array<double, 3>;

std::vector<Row> rows_of(std::string_view block, std::size_t columns, const Reader& reader) {
    std::vector<Row> rows;
    std::size_t number = 0;
    while (!block.empty()) {
        const std::string_view line = block.substr(0, block.find('\n'));
        block.remove_prefix(std::min(line.size() + 1, block.size()));
        ++number;
        const auto numbers = numbers_of(line, reader);
        if (numbers.empty()) continue;
        if (numbers.size() != columns)
            reader.fail("row " + std::to_string(number) + " must have " +
                        plural(columns, "column") + " (got " + std::to_string(numbers.size()) +
                        ")");
        if (!(numbers[0] > 0))
            reader.fail("row " + std::to_string(number) +
                        ": the wavelength must be positive (got " + to_text(numbers[0]) + ")");
        rows.push_back({to_nm(numbers[0]), numbers[1], columns == 3 ? numbers[2] : 0});
    }
    if (rows.empty()) reader.fail("the table has no rows");
    return rows;
}

void put_in_order(std::vector<Row>& rows, Reader& reader) {
    const auto by_wavelength = [](const Row& a, const Row& b) { return a[0] < b[0]; };
    if (std::is_sorted(rows.begin(), rows.end(), by_wavelength)) return;
    std::stable_sort(rows.begin(), rows.end(), by_wavelength);
    reader.notes.push_back(reader.where + ": rows sorted by wavelength");
}

void average_equal_wavelengths(std::vector<Row>& rows, Reader& reader) {
    std::vector<Row> kept;
    kept.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size();) {
        Row sum = rows[i];
        double count = 1;
        for (++i; i < rows.size() && rows[i][0] == sum[0]; ++i, ++count)
            for (const std::size_t value : {1U, 2U}) sum[value] += rows[i][value];
        kept.push_back({sum[0], sum[1] / count, sum[2] / count});
    }
    if (kept.size() < rows.size())
        reader.notes.push_back(reader.where + ": rows at equal wavelengths averaged, " +
                               plural(rows.size() - kept.size(), "row") + " fewer");
    rows = std::move(kept);
}

Table column(const std::vector<Row>& rows, std::size_t value) {
    Table table;
    for (const Row& row : rows) {
        table.wavelength_nm.push_back(row[0]);
        table.value.push_back(row[value]);
    }
    return table;
}

/// k of a passive medium: what is below 0 is noise.
Table absorption(Table table, Reader& reader) {
    std::size_t negative = 0;
    for (double& k : table.value)
        if (k < 0) {
            k = 0;
            ++negative;
        }
    if (negative > 0)
        reader.notes.push_back(reader.where + ": k < 0 set to 0 in " + plural(negative, "row"));
    return table;
}

Item table_item(const YAML::Node& item, std::string_view quantity, Reader& reader) {
    if (quantity == "n2")
        reader.fail("tabulated n2 is a nonlinear index in m^2/W, not a refractive index");
    if (quantity != "n" && quantity != "k" && quantity != "nk")
        reader.fail("unknown type " + in_quotes("tabulated " + std::string(quantity)));
    auto rows = rows_of(text_of(item, "data", reader), quantity.size() + 1, reader);
    put_in_order(rows, reader);
    average_equal_wavelengths(rows, reader);
    if (quantity == "n") return {column(rows, 1), std::nullopt};
    if (quantity == "k") return {std::nullopt, absorption(column(rows, 1), reader)};
    return {column(rows, 1), absorption(column(rows, 2), reader)};
}

Item item_of(const YAML::Node& item, Reader& reader) {
    if (!item.IsMap()) reader.fail("must be a map with a type");
    const std::string type = text_of(item, "type", reader);
    const std::size_t blank = std::min(type.find(' '), type.size());
    const std::string_view kind = std::string_view(type).substr(0, blank);
    const std::string_view rest = trimmed(std::string_view(type).substr(blank));
    if (kind == "formula") return formula_item(item, rest, reader);
    if (kind == "tabulated") return table_item(item, rest, reader);
    reader.fail("unknown type " + in_quotes(type));
}

WavelengthRange range_of(const Dispersion& dispersion) {
    return range_of(Material{"", RefractiveIndex{dispersion, Constant{0}}, Outside::refuse});
}

std::string in_words(WavelengthRange range) {
    return to_text(range.first_nm) + " to " + to_text(range.last_nm) + " nm";
}

/// k, which is 0 where the file does not give it, with a note that says so.
Dispersion usable_k(const Dispersion& n, std::optional<Dispersion> k, Reader& reader) {
    if (!k) {
        reader.notes.emplace_back("no k in the file: k = 0");
        return Constant{0};
    }
    const WavelengthRange of_n = range_of(n);
    const WavelengthRange of_k = range_of(*k);
    if (of_k.first_nm > of_n.first_nm || of_k.last_nm < of_n.last_nm)
        reader.notes.push_back("k is known from " + in_words(of_k) + " only, n from " +
                               in_words(of_n) + ": k = 0 elsewhere");
    return *std::move(k);
}

/// `text` without the tags of HTML; a < that opens none stays.
std::string without_tags(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        const bool opens = text[0] == '<' && text.size() > 1 &&
                           (text[1] == '/' || (text[1] >= 'a' && text[1] <= 'z'));
        const std::size_t end = opens ? text.find('>') : std::string_view::npos;
        if (end == std::string_view::npos) {
            plain += text[0];
            text.remove_prefix(1);
        } else {
            text.remove_prefix(end + 1);
        }
    }
    return plain;
}

/// `text` on one line, words set apart by one space.
std::string on_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
    return line;
}

MaterialFile material_of(const YAML::Node& document, const std::string& name) {
    Reader reader{name, {}, "DATA"};
    const YAML::Node data = document.IsMap() ? document["DATA"] : YAML::Node();
    if (!data || !data.IsSequence() || data.size() == 0)
        reader.fail("must be a list of formulas and tables");
    Item found;
    std::size_t number = 0;
    for (const YAML::Node& node : data) {
        reader.where = "DATA/" + std::to_string(number++);
        Item item = item_of(node, reader);
        if (!found.n) found.n = std::move(item.n);
        if (!found.k) found.k = std::move(item.k);
    }
    reader.where = "DATA";
    if (!found.n) reader.fail("gives k only, no n");
    Dispersion k = usable_k(*found.n, std::move(found.k), reader);
    const YAML::Node references = document["REFERENCES"];
    return {Material{name, RefractiveIndex{*std::move(found.n), std::move(k)}, Outside::refuse},
            std::move(reader.notes),
            references && references.IsScalar() ? on_one_line(without_tags(references.Scalar()))
                                                : std::string()};
}

}  // namespace

MaterialFile read_refractiveindex_info(std::string_view text, const std::string& name) {
    try {
        return material_of(YAML::Load(std::string(text)), name);
    } catch (const YAML::Exception& error) {
        const std::string where = error.mark.is_null() ? std::string()
                                                       : std::to_string(error.mark.line + 1) + ":" +
                                                             std::to_string(error.mark.column + 1);
        throw InputError(name, where, "is not YAML: " + error.msg);
    }
}

}  // namespace irido
