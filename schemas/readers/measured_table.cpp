#include "schemas/readers/measured_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.hpp"
#include "core/material/material.hpp"
#include "core/math/constants.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"

namespace irido::schemas {

namespace {

std::vector<std::string> words_of(std::string_view column) {
    std::vector<std::string> words{""};
    for (const char c : plain_words(column)) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

bool has_word(const std::vector<std::string>& words, std::span<const std::string_view> any) {
    return std::ranges::any_of(
        words, [&](const std::string& word) { return std::ranges::find(any, word) != any.end(); });
}

constexpr std::array<std::string_view, 5> kAngles{"angle", "aoi", "theta", "incidence", "angles"};
constexpr std::array<std::string_view, 6> kErrors{"sigma",  "error", "stderr",
                                                  "stddev", "sd",    "uncertainty"};
constexpr std::array<std::string_view, 4> kReflected{"r", "reflectance", "reflection",
                                                     "reflectivity"};
constexpr std::array<std::string_view, 4> kTransmitted{"t", "transmittance", "transmission",
                                                       "transmissivity"};
constexpr std::array<std::string_view, 3> kAbsorbed{"a", "absorptance", "absorption"};

/// Whether the words name the quantity; for psi_deg, psi suffices.
bool names_quantity(const std::vector<std::string>& words, std::string_view quantity) {
    if (quantity == "R") return has_word(words, kReflected);
    if (quantity == "T") return has_word(words, kTransmitted);
    if (quantity == "A") return has_word(words, kAbsorbed);
    const std::vector<std::string> own = words_of(quantity);
    if (own.front() == "psi" || own.front() == "delta")
        return std::ranges::find(words, own.front()) != words.end();
    return std::ranges::includes(words, own);
}

constexpr std::array<std::string_view, 1> kPercent{"percent"};
constexpr std::array<std::string_view, 2> kFraction{"fraction", "fractions"};
constexpr std::array<std::string_view, 3> kRadians{"rad", "radian", "radians"};
constexpr std::array<std::string_view, 3> kDegrees{"deg", "degree", "degrees"};

bool is_percent(std::string_view column) {
    return column.find('%') != std::string_view::npos || has_word(words_of(column), kPercent);
}

/// Factor from the unit that the column's name states to fractions or degrees.
double scale_of(std::string_view column) {
    if (is_percent(column)) return 0.01;
    return has_word(words_of(column), kRadians) ? 1 / kDegree : 1;
}

struct Bounds {
    double low, high;
};

/// Powers that noise and drift leave credible, and those in a column that states its unit, which
/// may be relative to a poor reference.
constexpr Bounds kPower{-0.02, 1.02}, kStatedPower{-0.2, 1.5};
/// psi is in [0, 90].
constexpr Bounds kPsi_deg{-1, 91};

bool names_columns(const std::vector<std::string>& header) {
    return std::ranges::any_of(
        header, [](const std::string& column) { return spectral_column(column).has_value(); });
}

class MeasuredReader {
public:
    MeasuredReader(std::string_view text, const std::string& name, std::string_view quantity,
                   std::string_view column)
        : name_(name),
          quantity_(quantity),
          is_power_(quantity == "R" || quantity == "T" || quantity == "A"),
          lines_(lines_of(text)),
          table_(read_columns(lines_, name,
                              {names_columns,
                               "a wavelength with its unit, such as wavelength_nm, and " +
                                   std::string(column.empty() ? quantity : column),
                               2, kMostColumns})) {
        if (table_.header.empty())
            throw InputError(name, "",
                             "must have a heading that names its columns and the unit of its "
                             "wavelengths, such as wavelength_nm," +
                                 std::string(quantity));
        find_columns(quantity, column);
    }

    std::vector<MeasuredRows> read() const {
        std::vector<MeasuredRows> all;
        for (const ColumnRow& row : table_.rows) {
            const std::optional<double> angle_deg =
                angle_ ? std::optional(row.values[*angle_] * angle_scale_) : std::nullopt;
            if (angle_deg && !(*angle_deg >= 0 && *angle_deg < 90))
                throw InputError(
                    name_, place_of(row.line, row.cells[*angle_]),
                    "an angle must be in [0, 90) degrees (got " + to_text(*angle_deg) + ")");
            auto rows = std::ranges::find(all, angle_deg, &MeasuredRows::angle_deg);
            if (rows == all.end()) {
                all.push_back({angle_deg, {}, {}, {}});
                rows = all.end() - 1;
            }
            rows->wavelength_nm.push_back(wavelength(row));
            rows->value.push_back(value(row));
            if (sigma_) rows->sigma.push_back(sigma(row));
        }
        return all;
    }

private:
    static constexpr std::size_t kMostColumns = 64;

    double wavelength(const ColumnRow& row) const {
        const double nm = to_nm(row.values[spectral_], unit_);
        if (nm >= kAllWavelengths.first_nm && nm <= kAllWavelengths.last_nm) return nm;
        throw InputError(name_, place_of(row.line, row.cells[spectral_]),
                         "wavelength_nm must be in [1, 1e+07] (got " + to_text(nm) + ")");
    }

    double value(const ColumnRow& row) const {
        const double cell = row.values[value_], number = cell * scale_;
        const bool is_psi = quantity_ == "psi_deg", is_unstated = is_power_ && !is_fraction_;
        if (!is_power_ && !is_psi) return number;
        const Bounds& bounds = is_psi ? kPsi_deg : is_fraction_ ? kStatedPower : kPower;
        if (number >= bounds.low && number <= bounds.high) return number;
        std::string text = table_.header[value_] + " must be " +
                           (is_unstated ? "a fraction " : "") + "in [" +
                           to_text(bounds.low / scale_) + ", " + to_text(bounds.high / scale_) +
                           "] (got " + to_text(cell) + ")";
        if (is_unstated && number > bounds.high)
            text += "; name the column \"" + quantity_ + " [%]\" if it is in percent, " +
                    quantity_ + "_fraction if it exceeds 1";
        throw InputError(name_, place_of(row.line, row.cells[value_]), text);
    }

    double sigma(const ColumnRow& row) const {
        const double value = row.values[*sigma_] * sigma_scale_;
        if (value > 0) return value;
        throw InputError(name_, place_of(row.line, row.cells[*sigma_]),
                         "a standard deviation must be above 0 (got " + to_text(value) + ")");
    }

    /// Sets the column of a role that only one may have.
    void take(std::optional<std::size_t>& role, std::size_t column, const std::string& hint) const {
        if (role)
            throw InputError(name_, "",
                             "has two columns for one purpose, " + in_quotes(table_.header[*role]) +
                                 " and " + in_quotes(table_.header[column]) + hint);
        role = column;
    }

    void find_columns(std::string_view quantity, std::string_view column) {
        std::optional<std::size_t> spectral, value;
        for (std::size_t c = 0; c < table_.header.size(); ++c) {
            const std::string& name = table_.header[c];
            const std::vector<std::string> words = words_of(name);
            if (const auto own = spectral_column(name)) {
                if (!own->unit)
                    throw InputError(
                        name_, "",
                        "the column " + name + " must name its unit: nm, um, angstrom, eV or cm-1");
                if (spectral && *own->unit != unit_) continue;  // the same in another unit
                take(spectral, c, "");
                unit_ = *own->unit;
            } else if (has_word(words, kErrors)) {
                if (names_quantity(words, quantity)) take(sigma_, c, "");
            } else if (has_word(words, kAngles)) {
                take(angle_, c, "");
            } else if (column.empty() ? names_quantity(words, quantity) : name == column) {
                take(value, c, column.empty() ? "; \"column\" of a target names one" : "");
            }
        }
        if (!value)
            throw InputError(name_, "",
                             "has no column " + std::string(column.empty() ? quantity : column) +
                                 " (its columns: " + names() + ")");
        spectral_ = spectral.value();
        value_ = *value;
        const std::string& name = table_.header[value_];
        for (const std::size_t c : {value_, sigma_.value_or(value_), angle_.value_or(value_)})
            require_one_unit(table_.header[c]);
        scale_ = scale_of(name);
        is_fraction_ = has_word(words_of(name), kFraction) || is_percent(name);
        if (sigma_) sigma_scale_ = scale_ != 1 ? scale_ : scale_of(table_.header[*sigma_]);
        if (angle_ && has_word(words_of(table_.header[*angle_]), kRadians))
            angle_scale_ = 1 / kDegree;
    }

    void require_one_unit(const std::string& column) const {
        const std::vector<std::string> words = words_of(column);
        const auto refuse = [&](const char* units) {
            throw InputError(name_, "",
                             "the column " + in_quotes(column) + " states both " + units);
        };
        if (is_percent(column) && has_word(words, kFraction)) refuse("percent and fraction");
        if (has_word(words, kDegrees) && has_word(words, kRadians)) refuse("degrees and radians");
    }

    std::string names() const {
        std::string all;
        for (const std::string& name : table_.header) all += (all.empty() ? "" : ", ") + name;
        return all;
    }

    const std::string& name_;
    std::string quantity_;
    bool is_power_ = false;     ///< a quantity from 0 to 1
    bool is_fraction_ = false;  ///< the column's name states that or percent
    std::vector<TextLine> lines_;
    ColumnText table_;
    std::size_t spectral_ = 0, value_ = 0;
    std::optional<std::size_t> angle_, sigma_;
    SpectralUnit unit_ = SpectralUnit::nm;
    double scale_ = 1, sigma_scale_ = 1, angle_scale_ = 1;
};

constexpr std::array<std::string_view, 5> kMeasured{"R", "T", "A", "psi_deg", "delta_deg"};

/// Whether the words name that quantity itself, not its error.
bool is_column_of(const std::string& column, std::string_view quantity) {
    const std::vector<std::string> words = words_of(column);
    return !spectral_column(column) && !has_word(words, kErrors) && !has_word(words, kAngles) &&
           names_quantity(words, quantity);
}

bool names_measurements(const std::vector<std::string>& header) {
    return names_columns(header) && std::ranges::any_of(header, [](const std::string& column) {
               return std::ranges::any_of(kMeasured, [&](std::string_view quantity) {
                   return is_column_of(column, quantity);
               });
           });
}

}  // namespace

std::vector<MeasuredColumn> measured_columns(std::string_view text) {
    constexpr std::string_view kColumnSeparators = ",;\t ";
    std::vector<MeasuredColumn> columns;
    for (const TextLine& line : lines_of(text)) {
        const std::string_view names = trimmed(line.text);
        const bool is_comment = names.starts_with("//") || names.find_first_of("#;!%") == 0;
        std::vector<std::string> header;
        for (const char separator : kColumnSeparators) {
            if (is_comment && separator == ' ') break;
            header = column_names(names, separator);
            if (header.size() > 1 && names_measurements(header)) break;
            header.clear();
        }
        if (header.empty()) continue;
        for (const std::string_view quantity : kMeasured) {
            std::vector<std::string> of_quantity;
            for (const std::string& column : header)
                if (is_column_of(column, quantity)) of_quantity.push_back(column);
            for (const std::string& column : of_quantity)
                columns.push_back({std::string(quantity), of_quantity.size() > 1 ? column : ""});
        }
        break;
    }
    return columns;
}

std::vector<MeasuredRows> read_measured_table(std::string_view text, const std::string& name,
                                              std::string_view quantity, std::string_view column) {
    return MeasuredReader(text, name, quantity, column).read();
}

}  // namespace irido::schemas
