// Reads every data file of a copy of the refractiveindex.info database and compares it with an
// independent parser of the same text: IRIDO_TEST_DATABASE names the folder.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "schemas/input_error.hpp"
#include "schemas/readers/material_file.hpp"
#include "schemas/readers/text_file.hpp"

using namespace irido;
using namespace irido::schemas;

namespace {

/// An item of DATA, taken literally from its lines; wavelengths in um.
struct Item {
    std::string type;
    std::vector<long double> coefficients, range;
    std::vector<std::vector<long double>> rows;
};

struct Text {
    std::vector<Item> items;
    bool in_air = false;
    long double celsius = 20;
};

std::vector<long double> numbers(const std::string& line) {
    std::istringstream words(line);
    std::vector<long double> result;
    for (std::string word; words >> word;) result.push_back(std::strtold(word.c_str(), nullptr));
    return result;
}

/// Reads the lines below the top-level key DATA.
Text read_lines(const std::string& text) {
    Text result;
    std::istringstream lines(text);
    bool in_data = false, in_rows = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("glass_code:") != std::string::npos ||
            line.find("Zemax catalog") != std::string::npos ||
            line.find("optical glass catalog") != std::string::npos ||
            line.find("is_absolute: false") != std::string::npos)
            result.in_air = true;
        if (line.starts_with("    temperature: ")) {
            const long double value = numbers(line.substr(17)).at(0);
            result.celsius = value > 100 ? std::round((value - 273.15L) * 2) / 2 : value;
        }
        if (!line.empty() && line[0] != ' ' && line[0] != '#') in_data = line.starts_with("DATA:");
        if (!in_data || line.starts_with("DATA:")) continue;
        const auto after = [&](const char* key) -> std::optional<std::string> {
            const std::size_t at = line.find(key);
            if (at == std::string::npos) return std::nullopt;
            in_rows = false;
            return line.substr(at + std::string(key).size());
        };
        if (const auto type = after("- type: ")) {
            result.items.push_back({*type, {}, {}, {}});
        } else if (const auto c = after("coefficients: ")) {
            result.items.back().coefficients = numbers(*c);
        } else if (const auto r = after("wavelength_range: ")) {
            result.items.back().range = numbers(*r);
        } else if (after("data: |")) {
            in_rows = true;
        } else if (in_rows && !numbers(line).empty()) {
            result.items.back().rows.push_back(numbers(line));
        }
    }
    return result;
}

/// n from a formula at L um, with each term written out as on the database's definition sheet.
long double formula(const Item& item, long double L) {
    const auto c = [&](std::size_t i) {
        return i <= item.coefficients.size() ? item.coefficients[i - 1] : 0.0L;
    };
    const long double L2 = L * L;
    long double n2 = 1 + c(1);
    switch (item.type.back()) {
        case '1':
            for (std::size_t i = 2; i < 17; i += 2)
                if (c(i) != 0) n2 += c(i) * L2 / (L2 - c(i + 1) * c(i + 1));
            return std::sqrt(n2);
        case '2':
            for (std::size_t i = 2; i < 17; i += 2)
                if (c(i) != 0) n2 += c(i) * L2 / (L2 - c(i + 1));
            return std::sqrt(n2);
        case '3':
        case '5':
            n2 = c(1);
            for (std::size_t i = 2; i < 17; i += 2) n2 += c(i) * std::pow(L, c(i + 1));
            return item.type.back() == '5' ? n2 : std::sqrt(n2);
        case '4':
            n2 = c(1);
            for (const std::size_t i : {2U, 6U})
                if (c(i) != 0)
                    n2 += c(i) * std::pow(L, c(i + 1)) / (L2 - std::pow(c(i + 2), c(i + 3)));
            for (std::size_t i = 10; i < 17; i += 2) n2 += c(i) * std::pow(L, c(i + 1));
            return std::sqrt(n2);
        case '6':
            for (std::size_t i = 2; i < 11; i += 2)
                if (c(i) != 0) n2 += c(i) / (c(i + 1) - 1 / L2);
            return n2;
        case '7': {
            const long double u = 1 / (L2 - 0.028L);
            return c(1) + c(2) * u + c(3) * u * u + c(4) * L2 + c(5) * L2 * L2 +
                   c(6) * L2 * L2 * L2;
        }
        case '8': {
            const long double r = c(1) + c(2) * L2 / (L2 - c(3)) + c(4) * L2;
            return std::sqrt((1 + 2 * r) / (1 - r));
        }
        default:
            return std::sqrt(c(1) + c(2) / (L2 - c(3)) +
                             c(4) * (L - c(5)) / ((L - c(5)) * (L - c(5)) + c(6)));
    }
}

/// Ciddor's air at 15 C, scaled to the density at another temperature.
long double air(long double um, long double celsius) {
    const long double s2 = 1 / std::pow(std::clamp(um, 0.23L, 1.69L), 2.0L);
    return 1 + (0.05792105L / (238.0185L - s2) + 0.00167917L / (57.362L - s2)) * 288.15L /
                   (celsius + 273.15L);
}

long double vacuum_of(long double um, long double celsius) {
    long double vacuum = um;
    for (int i = 0; i < 4; ++i) vacuum = um * air(vacuum, celsius);
    return vacuum;
}

/// The mean of the rows at the same wavelength.
long double mean_at(const Item& item, long double um, std::size_t value) {
    long double sum = 0;
    int count = 0;
    for (const auto& row : item.rows)
        if (row[0] == um) {
            sum += row[value];
            ++count;
        }
    return sum / count;
}

struct Tally {
    std::size_t files = 0, read = 0, points = 0, in_air = 0, without_k = 0, part_of_k = 0;
    double largest = 0, largest_in_air = 0;
    std::map<std::string, std::vector<std::string>> refused;  ///< files by error
    std::vector<std::string> wrong;
};

/// Checks n or k of the first item that has it, at the points stored in the file.
void compare(const std::string& path, const Text& text, const Material& material, Tally& tally) {
    bool has[2] = {false, false};
    for (const Item& item : text.items) {
        const bool is_formula = item.type.starts_with("formula");
        for (const std::size_t part : {0U, 1U}) {  // n, k
            const bool gives =
                is_formula ? part == 0 : item.type.find("nk"[part], 10) != std::string::npos;
            if (!gives || has[part]) continue;
            has[part] = true;
            std::vector<std::pair<long double, long double>> points;
            const std::size_t value = item.type.ends_with("nk") ? 1 + part : 1;
            if (is_formula)
                for (int i = 0; i <= 20; ++i) {
                    const long double um =
                        item.range[0] + (item.range[1] - item.range[0]) * (0.5L + i) / 21;
                    points.emplace_back(um, formula(item, um));
                }
            else
                for (std::size_t i = 0; i < item.rows.size(); i += item.rows.size() / 300 + 1)
                    points.emplace_back(item.rows[i][0], mean_at(item, item.rows[i][0], value));
            for (const auto& [um, expected] : points) {
                const long double vacuum = text.in_air ? vacuum_of(um, text.celsius) : um;
                const long double known =
                    part == 0 ? (text.in_air ? expected * air(vacuum, text.celsius) : expected)
                              : std::max(expected, 0.0L);
                Complex index;
                try {
                    index = index_at(material, static_cast<double>(1000 * vacuum));
                } catch (const std::exception&) {
                    continue;  // out of the other's range, or no index: refused when used
                }
                ++tally.points;
                const double got = part == 0 ? index.real() : index.imag();
                const double off = std::abs(got - static_cast<double>(known)) /
                                   std::max(1.0, std::abs(static_cast<double>(known)));
                double& largest = text.in_air ? tally.largest_in_air : tally.largest;
                largest = std::max(largest, off);
                if (!(off < (text.in_air ? 1e-9 : 1e-10)) && tally.wrong.size() < 20)
                    tally.wrong.push_back(path + " at " + std::to_string(static_cast<double>(um)) +
                                          " um");
            }
        }
    }
}

/// A message without the parts that differ from file to file.
std::string rule_of(const InputError& error) {
    std::string rule;
    for (const char c : error.message)
        if (!(c >= '0' && c <= '9') && c != '.' && c != '-') rule += c;
    return rule.substr(0, 60);
}

void look_at(const std::string& path, Tally& tally) {
    const std::string text = read_text(path);
    if (text.find("\nDATA:") == std::string::npos) return;  // about.yml and catalogues
    ++tally.files;
    try {
        const MaterialFile file = read_material_file(text, path);
        ++tally.read;
        const Text lines = read_lines(text);
        tally.in_air += lines.in_air ? 1 : 0;
        for (const std::string& note : file.notes) {
            tally.without_k += note == "no k in the file: k = 0" ? 1 : 0;
            tally.part_of_k += note.find("is not small") != std::string::npos ? 1 : 0;
        }
        compare(path, lines, file.material, tally);
    } catch (const InputError& error) {
        tally.refused[rule_of(error)].push_back(path + ": " + error.message);
    }
}

}  // namespace

TEST_CASE("a copy of the refractiveindex.info database is read right", "[database]") {
    const char* const folder = std::getenv("IRIDO_TEST_DATABASE");
    if (folder == nullptr) return;
    Tally tally;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".yml") look_at(entry.path().string(), tally);
    std::cout << tally.files << " data files, " << tally.read << " read (" << tally.in_air
              << " relative to air, " << tally.without_k << " without k, " << tally.part_of_k
              << " known in a part of the range of n), " << tally.points
              << " points compared: largest difference " << tally.largest << ", in air "
              << tally.largest_in_air << "\n";
    for (const auto& [rule, files] : tally.refused)
        std::cout << files.size() << " refused, such as " << files.front() << "\n";
    CHECK(tally.files > 0);
    CHECK(tally.wrong == std::vector<std::string>{});
}
