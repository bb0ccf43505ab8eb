// CSV: for people, spreadsheets and scripts.
// - The first line has the names: one column per axis, then one per channel.
// - One line per sample, the last axis fastest; with mip levels, level 0 comes first, and each
//   level has its own samples, with its value of the mip axis in the leading column.
// - Numbers are the shortest text of the double to which the table's type rounds the value, so that
//   f16, f32 and f64 all read back bit-identical. Linear axes are written as in the metadata.
// - The metadata is in the companion FILE.csv.json; a table on standard output has none.

#include "tables/records/record_format.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "schemas/readers/number.hpp"
#include "tables/lut/lut_metadata.hpp"
#include "tables/lut/lut_values.hpp"

namespace irido::tables {

namespace {

/// Samples of all axes at one level, preceded by the level itself if there are levels.
std::vector<std::vector<double>> samples_of_level(const Lut& lut, std::size_t level) {
    std::vector<std::vector<double>> samples;
    if (lut.mips) samples.push_back({samples_of(lut.axes.front())[level]});
    for (const LutAxis& axis : lut.axes_of_level(level)) samples.push_back(samples_of(axis));
    return samples;
}

/// Iterates over all combinations of samples, the last fastest.
class Odometer {
public:
    explicit Odometer(const std::vector<std::vector<double>>& samples)
        : samples_(samples), at_(samples.size(), 0) {}

    std::size_t operator[](std::size_t axis) const { return at_[axis]; }
    /// False after the last combination.
    bool advance() {
        for (std::size_t axis = at_.size(); axis-- > 0;) {
            if (++at_[axis] < samples_[axis].size()) return true;
            at_[axis] = 0;
        }
        return false;
    }

private:
    const std::vector<std::vector<double>>& samples_;
    std::vector<std::size_t> at_;
};

Records records_of(const Lut& lut) {
    std::vector<Column::CodedNumbers> axes(lut.axes.size());
    for (std::size_t level = 0; level < lut.levels(); ++level) {
        const std::vector<std::vector<double>> samples = samples_of_level(lut, level);
        std::vector<std::size_t> first(axes.size());
        for (std::size_t a = 0; a < axes.size(); ++a) {
            first[a] = axes[a].values.size();
            axes[a].values.insert(axes[a].values.end(), samples[a].begin(), samples[a].end());
        }
        Odometer odometer(samples);
        do {
            for (std::size_t a = 0; a < axes.size(); ++a)
                axes[a].codes.push_back(static_cast<std::uint32_t>(first[a] + odometer[a]));
        } while (odometer.advance());
    }
    Records records;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        Column column{lut.axes[a].name, {}};
        column.values = std::move(axes[a]);
        records.columns.push_back(std::move(column));
    }
    const std::size_t channels = lut.channels.size();
    for (std::size_t c = 0; c < channels; ++c) {
        Column::Numbers values;
        values.reserve(lut.values.size() / channels);
        for (std::size_t i = c; i < lut.values.size(); i += channels)
            values.push_back(rounded(lut.values[i], lut.type));
        Column column{lut.channels[c], {}};
        column.values = std::move(values);
        records.columns.push_back(std::move(column));
    }
    return records;
}

std::vector<LutFile> write(const Lut& lut, const LutLayout& layout) {
    check_plain(layout, "csv");
    check_values(lut);
    std::vector<LutFile> files;
    files.push_back(companion_of(lut));
    std::string bytes = written(*find_record_format("csv"), records_of(lut));
    files.push_back({"", std::move(bytes)});
    return files;
}

// --- reading --------------------------------------------------------------------------------

/// Iterates over the lines of a text, split at commas.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    /// False at the end of the text.
    bool next() {
        if (text_.empty()) return false;
        const std::size_t end = std::min(text_.find('\n'), text_.size());
        rest_ = schemas::trimmed(text_.substr(0, end));
        text_.remove_prefix(std::min(end + 1, text_.size()));
        ++number_;
        is_cut_ = false;
        return true;
    }
    std::string_view line() const { return rest_; }

    double number() {
        if (is_cut_) fail("has too few numbers");
        const std::size_t end = rest_.find(',');
        const std::string_view token = schemas::trimmed(rest_.substr(0, end));
        is_cut_ = end == std::string_view::npos;
        if (!is_cut_) rest_.remove_prefix(end + 1);
        const std::optional<double> value = schemas::parse_number(token);
        if (!value) fail(schemas::in_quotes(token) + " is not a finite number");
        // the sign of a -0 is kept, as in the other formats
        return std::copysign(*value, token.starts_with('-') ? -1.0 : 1.0);
    }
    bool is_at_end() const { return is_cut_; }

    [[noreturn]] void fail(const std::string& words) const {
        throw LutError("line " + std::to_string(number_) + ": " + words);
    }

private:
    std::string_view text_, rest_;
    std::size_t number_ = 0;
    bool is_cut_ = false;
};

void read_row(Lines& lines, const std::vector<std::vector<double>>& samples,
              const Odometer& odometer, Lut& lut) {
    if (!lines.next())
        throw LutError("the file ends after " +
                       std::to_string(lut.values.size() / lut.channels.size()) + " of " +
                       std::to_string(values_of(lut) / lut.channels.size()) + " rows");
    for (std::size_t a = 0; a < samples.size(); ++a)
        if (lines.number() != samples[a][odometer[a]])
            lines.fail("the value of " + lut.axes[a].name + " does not match the metadata");
    for (const std::string& channel : lut.channels) {
        const double value = lines.number();
        if (rounded(value, lut.type) != value)
            lines.fail("the value of " + channel + " is not an " + std::string(name_of(lut.type)) +
                       " number");
        lut.values.push_back(value);
    }
    if (!lines.is_at_end()) lines.fail("has too many numbers");
}

Lut read(std::string_view bytes, std::string_view companion) {
    Lut lut = lut_from_companion(companion);
    std::string names;
    for (const LutAxis& axis : lut.axes) names += axis.name + ",";
    for (const std::string& channel : lut.channels) names += channel + ",";
    names.pop_back();
    Lines lines(bytes);
    if (!lines.next() || lines.line() != names)
        throw LutError("the first line must match the metadata: " + names);
    for (std::size_t level = 0; level < lut.levels(); ++level) {
        const std::vector<std::vector<double>> samples = samples_of_level(lut, level);
        Odometer odometer(samples);
        do read_row(lines, samples, odometer, lut);
        while (odometer.advance());
    }
    if (lines.next()) lines.fail("is after the last row of the table");
    return lut;
}

}  // namespace

extern const LutFormat lut_format_csv{
    .name = "csv",
    .summary = "one line per sample: axes, then channels; metadata in FILE.csv.json",
    .is_binary = false,
    .write = write,
    .read = read,
};

}  // namespace irido::tables
