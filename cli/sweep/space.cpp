#include "cli/sweep/space.hpp"

#include <algorithm>

#include "cli/options/list.hpp"
#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/material/material.hpp"
#include "core/math/normal.hpp"
#include "core/math/philox.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/column_text.hpp"
#include "schemas/readers/number.hpp"
#include "schemas/readers/points_csv.hpp"
#include "schemas/readers/text_file.hpp"
#include "schemas/readers/utf8.hpp"

namespace irido::cli {

namespace {

constexpr double kMostCombinations = 1e15, kLargestNumber = 1e300;

/// The range of a varied number; the stack's schema is checked later.
std::pair<double, double> range_of(std::string_view path) {
    if (path == kSweptAngle) return {0, kLargestAngle_deg};
    if (path == kSweptWavelength) return {kAllWavelengths.first_nm, kAllWavelengths.last_nm};
    return {-kLargestNumber, kLargestNumber};
}

/// Whether an item of a list is a number or start:stop:step or start:stop/count.
bool is_numeric(std::string_view item) {
    return schemas::parse_number(schemas::trimmed(item.substr(0, item.find(':')))).has_value();
}

std::vector<double> numbers_of(const std::string& path, std::string_view list) {
    const auto [lowest, highest] = range_of(path);
    return parse_list("--vary " + path, list, lowest, highest);
}

/// A column of wavelengths in another unit, which its name says, becomes one in nm.
void take_unit(SweptColumn& column, const std::string& file) {
    if (column.path.find(';') != std::string::npos)
        throw schemas::InputError(
            file, "",
            "columns must be separated by commas (got " + schemas::in_quotes(column.path) + ")");
    const auto spectral = schemas::spectral_column(column.path);
    if (!spectral || column.path == kSweptWavelength) return;
    if (!spectral->unit)
        throw schemas::InputError(file, "",
                                  "the column " + schemas::in_quotes(column.path) +
                                      " must name its unit, as wavelength_nm does");
    for (double& value : column.numbers) value = schemas::to_nm(value, *spectral->unit);
    column.path = kSweptWavelength;
}

}  // namespace

bool SweptColumn::is_light() const {
    return path == kSweptAngle || path == kSweptWavelength;
}

double ScatteredValue::at(std::uint64_t sample) const {
    const auto [low, high] = philox_key(sample);
    const auto [stream_low, stream_high] = philox_key(stream);
    const auto words = philox({low, high, stream_low, stream_high}, philox_key(seed));
    const std::uint64_t bits = std::uint64_t{words[1]} << 32 | words[0];
    return std::clamp(nominal + sigma * normal_deviate(bits), lowest, highest);
}

std::size_t SweptColumn::size() const {
    if (scattered) return scattered->samples;
    return is_text() ? texts.size() : numbers.size();
}

nlohmann::json SweptColumn::value(std::size_t index) const {
    if (!is_text()) return number(index);
    return schemas::value_from_text(path, texts[index]);
}

std::string SweptColumn::text(std::size_t index) const {
    return is_text() ? texts[index] : to_text(number(index));
}

SweepSpace::SweepSpace(const std::vector<std::string>& vary, const std::string& points,
                       std::vector<SweptColumn> scattered) {
    if (!points.empty()) add_points(points);
    for (SweptColumn& column : scattered) columns_.push_back(std::move(column));
    for (const std::string& text : vary) add_list(text);
    if (columns_.empty())
        throw UsageError(
            "--vary: a sweep requires --vary PATH=LIST, --points FILE or --scatter PATH=SIGMA");
    check();
    double size = 1;
    for (auto column = columns_.rbegin(); column != columns_.rend(); ++column) {
        if (column->of_points || column->scattered) continue;
        column->stride = size_;
        size *= static_cast<double>(column->size());
        if (size * static_cast<double>(points_) > kMostCombinations)
            throw UsageError("--vary: must give at most 1e15 combinations");
        size_ *= column->size();
    }
    const auto samples = std::ranges::find(columns_, true, &SweptColumn::is_sample);
    if (samples != columns_.end()) {
        for (SweptColumn& column : columns_)
            if (column.scattered) column.stride = size_;
        size *= static_cast<double>(samples->size());
        if (size * static_cast<double>(points_) > kMostCombinations)
            throw UsageError("--samples: must give at most 1e15 combinations");
        size_ *= samples->size();
    }
    for (SweptColumn& column : columns_)
        if (column.of_points) column.stride = size_;
    size_ *= points_;
}

std::size_t SweepSpace::at(std::size_t column, std::uint64_t combination) const {
    const SweptColumn& of = columns_[column];
    const std::uint64_t step = combination / of.stride;
    if (!of.of_points) return step % of.size();
    return of.codes.empty() ? step : of.codes[step];
}

std::string SweepSpace::origin_of(std::size_t column, std::size_t index) const {
    const SweptColumn& of = columns_[column];
    if (!of.of_points) return (of.scattered ? "--scatter " : "--vary ") + of.path + ": ";
    const auto first = std::ranges::find(of.codes, index);
    const std::size_t row =
        of.codes.empty() ? index : static_cast<std::size_t>(first - of.codes.begin());
    return points_file_ + ": combination " + std::to_string(row + 1) + ": ";
}

std::string SweepSpace::describe(std::uint64_t combination) const {
    std::string text;
    for (std::size_t c = 0; c < columns_.size(); ++c)
        text += (c > 0 ? ", " : "") + columns_[c].path + "=" + columns_[c].text(at(c, combination));
    return text;
}

void SweepSpace::add_points(const std::string& file) {
    points_file_ = schemas::shown_path(file);
    for (schemas::PointsColumn& read :
         schemas::read_points_csv(schemas::read_text(file), points_file_)) {
        SweptColumn column{std::move(read.path), std::move(read.numbers), std::move(read.texts),
                           std::move(read.codes)};
        take_unit(column, points_file_);
        column.of_points = true;
        points_ = column.is_text() ? column.codes.size() : column.numbers.size();
        columns_.push_back(std::move(column));
        check_light(columns_.size() - 1);
    }
}

void SweepSpace::check_light(std::size_t column) const {
    const SweptColumn& of = columns_[column];
    if (!of.is_light()) return;
    const auto [lowest, highest] = range_of(of.path);
    for (std::size_t i = 0; i < of.size(); ++i) {
        // one value that is not a number makes a column of strings
        const double value =
            of.is_text() ? schemas::parse_number(of.texts[i]).value_or(lowest - 1) : of.numbers[i];
        if (!(value >= lowest && value <= highest))
            throw schemas::InputError("", "",
                                      origin_of(column, i) + of.path + ": must be in [" +
                                          to_text(lowest) + ", " + to_text(highest) + "] (got " +
                                          of.text(i) + ")");
    }
}

void SweepSpace::add_list(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw UsageError("--vary: must be PATH=LIST, as in layers.0.thickness_nm=0:1000:10 (got '" +
                         text + "')");
    SweptColumn column;
    column.path = text.substr(0, equals);
    const std::string_view list = std::string_view(text).substr(equals + 1);
    const std::vector<std::string_view> items = schemas::split_values(list);
    if (column.is_light() || std::ranges::all_of(items, is_numeric)) {
        column.numbers = numbers_of(column.path, list);
    } else {
        for (const std::string_view item : items) {
            const std::string_view value = schemas::trimmed(item);
            if (value.empty())
                throw UsageError("--vary " + column.path + ": values must not be empty (got '" +
                                 std::string(list) + "')");
            if (!is_numeric(value)) {
                column.texts.emplace_back(value);
                continue;
            }
            for (const double number : numbers_of(column.path, value))
                column.texts.push_back(to_text(number));
        }
    }
    columns_.push_back(std::move(column));
}

void SweepSpace::check() const {
    std::vector<std::string> paths;
    for (const SweptColumn& column : columns_) paths.push_back(column.path);
    if (const auto overlap = schemas::overlap_of(paths)) {
        const SweptColumn& column = columns_[overlap->inner];
        const std::string by = column.of_points   ? "--points: "
                               : column.scattered ? "--scatter: "
                                                  : "--vary: ";
        if (overlap->is_same) throw UsageError(by + column.path + " is varied twice");
        throw UsageError(by + column.path + " is inside " + paths[overlap->outer] +
                         ", which also varies");
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (!schemas::is_well_formed(columns_[c].path))
            throw UsageError("--vary: " + schemas::well_formed(columns_[c].path) + ": " +
                             schemas::kNoText);
        for (std::size_t i = 0; i < columns_[c].texts.size(); ++i)
            if (!schemas::is_well_formed(columns_[c].texts[i]))
                throw schemas::InputError("", "",
                                          origin_of(c, i) +
                                              schemas::well_formed(columns_[c].texts[i]) + ": " +
                                              schemas::kNoText);
    }
}

}  // namespace irido::cli
