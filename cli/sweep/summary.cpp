#include "cli/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "cli/options/list.hpp"
#include "core/nearest.hpp"
#include "schemas/readers/number.hpp"
#include "tables/records/packed_rows.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kMostSummedNumbers = std::size_t{1} << 27;

using FieldType = tables::RecordField::Type;

/// Columns of packed rows.
struct PackedColumns {
    tables::RecordLayout fields;
    std::vector<std::size_t> offsets;

    void add(const tables::RecordField& field, std::size_t offset) {
        fields.push_back(field);
        offsets.push_back(offset);
    }
    /// Their bytes in one row, concatenated.
    std::string of(std::string_view row) const {
        std::string bytes;
        for (std::size_t c = 0; c < fields.size(); ++c)
            bytes +=
                row.substr(offsets[c], tables::packed_bytes(fields[c], tables::TextCode::utf8));
        return bytes;
    }
    /// A number, or a flag as 0 or 1.
    double number(std::size_t column, std::string_view row) const {
        if (fields[column].type == FieldType::flag) return row[offsets[column]] != 0 ? 1 : 0;
        double value = 0;
        std::memcpy(&value, row.data() + offsets[column], sizeof value);
        return value;
    }
};

struct Statistics {
    double mean = 0, sd = 0, p5 = 0, p50 = 0, p95 = 0;
};

/// The quantile of sorted values for a given share.
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]);
}

Statistics statistics_of(std::vector<double> values) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (values.empty()) return {kNone, kNone, kNone, kNone, kNone};
    const auto count = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    Statistics result{sum / count};
    for (const double value : values) squares += (value - result.mean) * (value - result.mean);
    result.sd = std::sqrt(squares / count);
    std::ranges::sort(values);
    result.p5 = quantile(values, 0.05);
    result.p50 = quantile(values, 0.5);
    result.p95 = quantile(values, 0.95);
    return result;
}

/// For each sample, whether it satisfies the limits, or that it has no rows.
using Kept = std::vector<std::uint8_t>;
constexpr std::uint8_t kNoRows = 0, kKeeps = 1, kFails = 2;

Statistics yield_of(const Kept& kept) {
    std::vector<double> values;
    for (const std::uint8_t state : kept)
        if (state != kNoRows) values.push_back(state == kKeeps ? 1 : 0);
    return statistics_of(std::move(values));
}

Kept all_kept(const std::vector<Kept>& limits) {
    Kept all = limits.front();
    for (const Kept& limit : limits)
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::max(all[i], limit[i]);
    return all;
}

/// A row that all samples share: at one angle, wavelength, ...
struct RowOfSamples {
    std::string key;
    std::vector<std::vector<double>> numbers;  ///< of each quantity
};

/// Data for one combination of varied values.
struct Combination {
    std::string key;
    std::vector<RowOfSamples> rows;
    std::map<std::string, std::size_t, std::less<>> row_of_key;
    std::vector<Kept> kept;  ///< per limit
};

/// A row of the result.
struct SummaryLine {
    const std::string* combination;  ///< key of the varied values
    const std::string* row;          ///< key of the row, nullptr for limits
    std::string quantity;
    Statistics statistics;
};

/// Adds the columns of a key in which lines differ; lines without the key get no value there.
void add_key_columns(tables::Records& to, const PackedColumns& columns,
                     const std::vector<SummaryLine>& lines, const std::string* SummaryLine::*key) {
    std::size_t offset = 0;
    for (const tables::RecordField& field : columns.fields) {
        const std::size_t width = tables::packed_bytes(field, tables::TextCode::utf8);
        std::set<std::string_view> distinct;
        tables::Column::Numbers numbers;
        tables::Column::Texts texts;
        for (const SummaryLine& line : lines) {
            const std::string* const whole = line.*key;
            const std::string_view part =
                whole ? std::string_view(*whole).substr(offset, width) : std::string_view();
            if (whole) distinct.insert(part);
            if (field.type == FieldType::text) {
                texts.emplace_back(part.substr(0, part.find('\0')));
            } else {
                double number = std::numeric_limits<double>::quiet_NaN();
                if (whole) std::memcpy(&number, part.data(), sizeof number);
                numbers.push_back(number);
            }
        }
        offset += width;
        if (distinct.size() < 2) continue;
        if (field.type == FieldType::text) {
            to.columns.push_back({field.name, std::move(texts)});
        } else {
            to.columns.push_back({field.name, std::move(numbers)});
        }
    }
}

class SampleSummary : public tables::RecordStream {
public:
    SampleSummary(const tables::RecordLayout& layout, const SweepSpace& space, const Query& query,
                  std::vector<SampleLimit> limits, std::function<void(const tables::Records&)> take)
        : layout_(layout),
          space_(space),
          query_(query),
          limits_(std::move(limits)),
          take_(std::move(take)) {
        for (const SampleLimit& limit : limits_) require_column(limit);
    }

    std::uint64_t units_done() const override { return 0; }
    std::uint64_t rows_done() const override { return rows_; }
    bool is_complete() const override { return false; }

    void append(const std::string& bytes, std::uint64_t, std::uint64_t rows) override {
        if (rows == 0) return;
        const std::size_t row_bytes = bytes.size() / rows;
        if (rows_ == 0) sort_columns(bytes);
        rows_ += rows;
        for (std::size_t at = 0; at < bytes.size(); at += row_bytes)
            add(std::string_view(bytes).substr(at, row_bytes));
    }

    void finish() override { take_(records()); }
    void suspend() override { discard(); }
    void discard() noexcept override { combinations_.clear(); }

private:
    void require_column(const SampleLimit& limit) const {
        std::vector<std::string> names;
        for (const tables::RecordField& field : layout_)
            if (field.type != FieldType::text) names.push_back(field.name);
        if (std::ranges::find(names, limit.column) == names.end())
            throw UsageError("--limit: unknown column '" + limit.column + "'" +
                             did_you_mean(limit.column, names));
    }

    /// Determines from the first rows which columns distinguish rows and which are quantities.
    void sort_columns(const std::string& bytes) {
        std::set<std::string> keys{"order"};
        for (const tables::RowKey& key :
             query_.plot(tables::unpacked_rows(layout_, bytes), tables::GamutMapping{}).keys)
            keys.insert(key.column);
        std::map<std::string, bool> varied;  // whether samples differ in it
        for (const SweptColumn& column : space_.columns())
            varied[column.path] = column.scattered.has_value();
        std::size_t offset = 0;
        for (std::size_t f = 0; f < layout_.size(); ++f) {
            const tables::RecordField& field = layout_[f];
            const std::size_t begin = offset;
            offset += tables::packed_bytes(field, tables::TextCode::utf8);
            if (is_named_again(f)) continue;
            if (field.type != FieldType::text) numbers_.add(field, begin);
            const auto found = varied.find(field.name);
            if (found != varied.end()) {
                if (!found->second) varied_.add(field, begin);
                if (field.name == kSweptSample) sample_.add(field, begin);
            } else if (keys.contains(field.name)) {
                keys_.add(field, begin);
            } else if (field.type != FieldType::text) {
                quantities_.add(field, begin);
            }
        }
        for (const SampleLimit& limit : limits_)
            limited_.push_back(static_cast<std::size_t>(
                std::ranges::find(numbers_.fields, limit.column, &tables::RecordField::name) -
                numbers_.fields.begin()));
    }

    /// Of columns with the same name the last counts, since it was requested explicitly.
    bool is_named_again(std::size_t field) const {
        return std::any_of(
            layout_.begin() + static_cast<std::ptrdiff_t>(field) + 1, layout_.end(),
            [&](const tables::RecordField& other) { return other.name == layout_[field].name; });
    }

    Combination& combination_of(std::string_view row) {
        std::string key = varied_.of(row);
        const auto [found, is_new] = combination_of_key_.try_emplace(key, combinations_.size());
        if (is_new)
            combinations_.push_back(
                {std::move(key), {}, {}, std::vector<Kept>(limits_.size(), Kept(samples()))});
        return combinations_[found->second];
    }

    RowOfSamples& row_of(Combination& combination, std::string_view row) const {
        std::string key = keys_.of(row);
        const auto [found, is_new] =
            combination.row_of_key.try_emplace(key, combination.rows.size());
        if (is_new)
            combination.rows.push_back(
                {std::move(key), std::vector<std::vector<double>>(quantities_.fields.size())});
        return combination.rows[found->second];
    }

    void add(std::string_view row) {
        Combination& combination = combination_of(row);
        RowOfSamples& kept = row_of(combination, row);
        for (std::size_t q = 0; q < kept.numbers.size(); ++q) {
            const double number = quantities_.number(q, row);
            if (std::isnan(number)) continue;
            kept.numbers[q].push_back(number);
            if (++numbers_kept_ > kMostSummedNumbers)
                throw UsageError(
                    "--summary: the samples have more than 2^27 numbers; ask for "
                    "fewer rows or columns");
        }
        const auto sample = static_cast<std::size_t>(sample_.number(0, row)) - 1;
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            std::uint8_t& state = combination.kept[i][sample];
            const bool holds = limits_[i].holds(numbers_.number(limited_[i], row));
            state = std::max(state, holds ? kKeeps : kFails);
        }
    }

    std::size_t samples() const {
        const auto column = std::ranges::find(space_.columns(), true, &SweptColumn::is_sample);
        return column->size();
    }

    std::vector<SummaryLine> lines() const {
        std::vector<SummaryLine> result;
        for (const Combination& combination : combinations_) {
            for (const RowOfSamples& row : combination.rows)
                for (std::size_t q = 0; q < row.numbers.size(); ++q)
                    result.push_back({&combination.key, &row.key, quantities_.fields[q].name,
                                      statistics_of(row.numbers[q])});
            for (std::size_t i = 0; i < limits_.size(); ++i)
                result.push_back(
                    {&combination.key, nullptr, limits_[i].text, yield_of(combination.kept[i])});
            if (!limits_.empty())
                result.push_back(
                    {&combination.key, nullptr, "yield", yield_of(all_kept(combination.kept))});
        }
        return result;
    }

    tables::Records records() const {
        const std::vector<SummaryLine> all = lines();
        tables::Records result;
        add_key_columns(result, varied_, all, &SummaryLine::combination);
        add_key_columns(result, keys_, all, &SummaryLine::row);
        tables::Column::Texts quantity;
        for (const SummaryLine& line : all) quantity.push_back(line.quantity);
        result.columns.push_back({"quantity", std::move(quantity)});
        constexpr std::array<std::pair<const char*, double Statistics::*>, 5> kNumbers{
            {{"mean", &Statistics::mean},
             {"sd", &Statistics::sd},
             {"p5", &Statistics::p5},
             {"p50", &Statistics::p50},
             {"p95", &Statistics::p95}}};
        for (const auto& [name, member] : kNumbers) {
            tables::Column::Numbers numbers;
            for (const SummaryLine& line : all) numbers.push_back(line.statistics.*member);
            result.columns.push_back({name, std::move(numbers)});
        }
        return result;
    }

    const tables::RecordLayout& layout_;
    const SweepSpace& space_;
    const Query& query_;
    std::vector<SampleLimit> limits_;
    std::function<void(const tables::Records&)> take_;
    PackedColumns sample_, varied_, keys_, quantities_, numbers_;
    std::vector<std::size_t> limited_;  ///< columns of numbers_ to which the limits apply
    std::vector<Combination> combinations_;
    std::map<std::string, std::size_t, std::less<>> combination_of_key_;
    std::size_t numbers_kept_ = 0;
    std::uint64_t rows_ = 0;
};

}  // namespace

bool SampleLimit::holds(double number) const {
    switch (side) {
        case Side::at_most:
            return number <= value;
        case Side::at_least:
            return number >= value;
        case Side::below:
            return number < value;
        case Side::above:
            return number > value;
    }
    return false;
}

std::vector<SampleLimit> parse_limits(const std::vector<std::string>& texts) {
    std::vector<SampleLimit> limits;
    for (const std::string& text : texts) {
        const std::size_t at = text.find_first_of("<>");
        const auto refuse = [&]() -> void {
            throw UsageError("--limit: must be COLUMN<=VALUE, or with >=, < or > (got '" + text +
                             "')");
        };
        if (at == std::string::npos) refuse();
        const bool is_closed = text.substr(at + 1).starts_with('=');
        const std::string_view behind = std::string_view(text).substr(at + (is_closed ? 2 : 1));
        const std::optional<double> value = schemas::parse_number(schemas::trimmed(behind));
        SampleLimit limit;
        limit.column = schemas::trimmed(std::string_view(text).substr(0, at));
        if (!value || limit.column.empty()) refuse();
        limit.value = *value;
        using enum SampleLimit::Side;
        limit.side =
            text[at] == '<' ? (is_closed ? at_most : below) : (is_closed ? at_least : above);
        limit.text = limit.column + text[at] + (is_closed ? "=" : "") + to_text(limit.value);
        limits.push_back(std::move(limit));
    }
    return limits;
}

std::unique_ptr<tables::RecordStream> sample_summary(
    const tables::RecordLayout& layout, const SweepSpace& space, const Query& query,
    std::vector<SampleLimit> limits, std::function<void(const tables::Records&)> take) {
    return std::make_unique<SampleSummary>(layout, space, query, std::move(limits),
                                           std::move(take));
}

}  // namespace irido::cli
