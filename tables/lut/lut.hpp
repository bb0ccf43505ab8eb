#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irido::tables {

/// The number format of a table's values in a file.
enum class LutType { f16, f32, f64 };
inline constexpr std::array kLutTypes{LutType::f16, LutType::f32, LutType::f64};

std::string_view name_of(LutType type);  ///< f16, f32, f64
std::optional<LutType> find_lut_type(std::string_view name);
std::size_t bytes_of(LutType type);
/// The value as read back from storage: rounded to nearest even, infinite beyond the type's range.
double rounded(double value, LutType type);

/// The samples of a table's function along one axis.
struct LutAxis {
    std::string name;            ///< column of the CSV: theta_i_deg, cos_theta, opd_nm, ...
    std::string unit;            ///< deg, nm, or "" for a pure number
    std::vector<double> values;  ///< strictly monotonic, at least one
    /// If above 0: equally spaced in place_of(x) = x/(x + half_at), in which readers interpolate.
    double half_at = 0;
    bool operator==(const LutAxis&) const = default;

    std::size_t count() const { return values.size(); }
    /// Whether equally spaced (to 1e-9 of the spacing); if so, only the ends and count are stored.
    bool is_linear() const;
    /// The index of the cell [values[i], values[i + 1]] that contains x or is nearest to it; 0 if
    /// there is none.
    std::size_t cell_of(double x) const;
    double place_of(double x) const { return half_at > 0 ? x / (x + half_at) : x; }
    /// `count` values from one end to the other, equally spaced in place_of.
    std::vector<double> spaced(std::size_t count) const;
    double at_place(double place) const {
        return half_at > 0 ? half_at * place / (1 - place) : place;
    }
};

/// `count` values from one end to the other, both included; count 1 gives only `first`.
std::vector<double> equally_spaced(double first, double last, std::size_t count);

/// A function sampled along 1 to 3 axes: made by a kind, written by a format.
/// Texture coordinates put the first sample of an axis at the centre of the first texel and the
/// last at that of the last: u = (0.5 + (count - 1) (x - first) / (last - first)) / count.
struct Lut {
    std::string kind;
    std::vector<LutAxis> axes;          ///< slowest first
    std::vector<std::string> channels;  ///< R,G,B, or one name per value
    /// The first axis counts mip levels: level l has max(1, count >> l) equally spaced samples
    /// between the same ends along every other axis, which are linear.
    bool mips = false;
    LutType type = LutType::f32;
    std::vector<double> values;  ///< level by level if mips; last axis and then channel fastest
    /// The rest of the metadata, as defined by schemas/lut.schema.json: version, color_space,
    /// stack, request, error, notes. Never paths, times or thread counts.
    nlohmann::json facts = nlohmann::json::object();

    std::size_t levels() const { return mips ? axes.front().count() : 1; }
    /// Axes of one level without the mip axis, with the samples of that level.
    std::vector<LutAxis> axes_of_level(std::size_t level) const;
    std::size_t values_of_level(std::size_t level) const;  ///< numbers, including channels
};

}  // namespace irido::tables
