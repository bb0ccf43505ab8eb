#include "tables/lut/lut_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>

#include "core/math/half.hpp"
#include "tables/lut/lut_format.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kMostAxes = 3, kMostSamples = 1U << 20U, kMostLevels = 32;
constexpr std::size_t kMostChannels = 4096;
constexpr double kMostLutValues = 0x1p40;

template <class Number>
void append_number_bytes(std::string& out, Number number) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, &number, sizeof(Number));
    out.append(bytes, sizeof(Number));
}

template <class Number>
Number read_number(const char* bytes) {
    Number number{};
    std::memcpy(&number, bytes, sizeof(Number));
    return number;
}

// --- shape ----------------------------------------------------------------------------------

std::string text_of(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

void check_name(const std::string& name, std::set<std::string>& names) {
    const bool is_plain = std::ranges::none_of(name, [](char c) {
        return static_cast<unsigned char>(c) <= ' ' || c == ',' || c == '"' || c == '\x7F';
    });
    if (name.empty() || !is_plain)
        throw LutError("an axis or channel cannot be called '" + name + "'");
    if (!names.insert(name).second)
        throw LutError("two axes or channels are called '" + name + "'");
}

void check_axis(const LutAxis& axis) {
    if (axis.values.empty() || axis.count() > kMostSamples)
        throw LutError("axis " + axis.name + " must have 1 to " + std::to_string(kMostSamples) +
                       " samples (got " + std::to_string(axis.count()) + ")");
    const std::vector<double> samples = samples_of(axis);
    const bool rises = samples.back() > samples.front();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool follows =
            i == 0 || (rises ? samples[i] > samples[i - 1] : samples[i] < samples[i - 1]);
        if (!std::isfinite(samples[i]) || !follows)
            throw LutError("the samples of axis " + axis.name +
                           " must be finite and strictly monotonic (got " + text_of(samples[i]) +
                           " at sample " + std::to_string(i) + ")");
    }
}

void check_mips(const Lut& lut) {
    if (lut.axes.size() < 2) throw LutError("mip levels need an axis besides that of the levels");
    if (lut.levels() > kMostLevels)
        throw LutError("there must be at most " + std::to_string(kMostLevels) +
                       " mip levels (got " + std::to_string(lut.levels()) + ")");
    for (std::size_t a = 1; a < lut.axes.size(); ++a)
        if (!lut.axes[a].is_linear())
            throw LutError("mip levels need equally spaced samples along " + lut.axes[a].name);
}

}  // namespace

std::vector<double> samples_of(const LutAxis& axis) {
    return axis.is_linear() ? equally_spaced(axis.values.front(), axis.values.back(), axis.count())
                            : axis.values;
}

std::size_t values_of(const Lut& lut) {
    std::size_t count = 0;
    for (std::size_t level = 0; level < lut.levels(); ++level) count += lut.values_of_level(level);
    return count;
}

void check_shape(const Lut& lut) {
    if (lut.axes.empty() || lut.axes.size() > kMostAxes)
        throw LutError("a table has 1 to 3 axes, not " + std::to_string(lut.axes.size()));
    if (lut.channels.empty() || lut.channels.size() > kMostChannels)
        throw LutError("a table has 1 to " + std::to_string(kMostChannels) + " channels, not " +
                       std::to_string(lut.channels.size()));
    std::set<std::string> names;
    for (const LutAxis& axis : lut.axes) check_name(axis.name, names);
    for (const std::string& channel : lut.channels) check_name(channel, names);
    auto count = static_cast<double>(lut.channels.size());
    for (const LutAxis& axis : lut.axes) {
        check_axis(axis);
        count *= static_cast<double>(axis.count());
    }
    if (count > kMostLutValues) throw LutError("the table has more than 2^40 values");
    if (lut.mips) check_mips(lut);
}

void check_values(const Lut& lut) {
    check_shape(lut);
    if (lut.values.size() != values_of(lut))
        throw LutError("the table has " + std::to_string(lut.values.size()) +
                       " values, its axes and channels require " + std::to_string(values_of(lut)));
    for (std::size_t i = 0; i < lut.values.size(); ++i) {
        if (std::isfinite(rounded(lut.values[i], lut.type))) continue;
        const std::string rule = std::isfinite(lut.values[i])
                                     ? "beyond the range of " + std::string(name_of(lut.type))
                                     : "not a finite number";
        throw LutError(place_of(lut, i) + ": " + rule + " (got " + text_of(lut.values[i]) + ")");
    }
}

std::string place_of(const Lut& lut, std::size_t index) {
    std::size_t level = 0;
    for (; level + 1 < lut.levels() && index >= lut.values_of_level(level); ++level)
        index -= lut.values_of_level(level);
    const std::size_t channels = lut.channels.size();
    std::size_t sample = index / channels;
    std::string place;
    const std::vector<LutAxis> axes = lut.axes_of_level(level);
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        place =
            ", " + axis->name + " = " + text_of(samples_of(*axis)[sample % axis->count()]) + place;
        sample /= axis->count();
    }
    if (lut.mips)
        place = ", " + lut.axes.front().name + " = " +
                text_of(samples_of(lut.axes.front())[level]) + place;
    return lut.channels[index % channels] + " at " + place.substr(2);
}

void append_bytes(std::string& out, double value, LutType type) {
    switch (type) {
        case LutType::f16:
            return append_number_bytes(out, half_bits(rounded(value, type)));
        case LutType::f32:
            return append_number_bytes(out, static_cast<float>(value));
        case LutType::f64:
            return append_number_bytes(out, value);
    }
}

double number_at(const char* bytes, LutType type) {
    switch (type) {
        case LutType::f16:
            return half_value(read_number<std::uint16_t>(bytes));
        case LutType::f32:
            return static_cast<double>(read_number<float>(bytes));
        case LutType::f64:
            break;
    }
    return read_number<double>(bytes);
}

std::string value_bytes(const Lut& lut) {
    std::string bytes;
    bytes.reserve(lut.values.size() * bytes_of(lut.type));
    for (const double value : lut.values) append_bytes(bytes, value, lut.type);
    return bytes;
}

std::vector<double> values_from_bytes(std::string_view bytes, LutType type) {
    std::vector<double> values(bytes.size() / bytes_of(type));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = number_at(bytes.data() + i * bytes_of(type), type);
    return values;
}

}  // namespace irido::tables
