#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace irido::cli {

inline constexpr std::string_view kSweptAngle = "angle_deg", kSweptWavelength = "wavelength_nm",
                                  kSweptSample = "sample";

/// Gaussian errors of one value of the stack, one per sample.
struct ScatteredValue {
    double nominal = 0, sigma = 0;
    double lowest = 0, highest = 0;  ///< drawn values are clamped to this range
    std::uint64_t seed = 0;
    std::uint64_t stream = 0;  ///< values with the same stream have the same deviates
    std::uint64_t samples = 0;

    /// The value in a sample, counted from 0; depends only on the sample and the members above.
    double at(std::uint64_t sample) const;
};

/// One varied quantity and its values.
struct SweptColumn {
    std::string path;                ///< in the stack document; or angle_deg, wavelength_nm, sample
    std::vector<double> numbers;     ///< the values, if all are numbers
    std::vector<std::string> texts;  ///< else the distinct values, as printed
    std::vector<std::uint32_t> codes;              ///< for points: indices into texts
    bool of_points = false;                        ///< varies with the points
    std::optional<ScatteredValue> scattered = {};  ///< drawn instead, one value per sample
    bool is_sample = false;                        ///< the sample number, from 1, of `scattered`
    std::uint64_t stride = 1;  ///< number of consecutive combinations with the same value

    bool is_text() const { return !texts.empty(); }
    /// Whether it is an angle or a wavelength rather than a value of the stack.
    bool is_light() const;
    /// Whether it is a value of the stack.
    bool is_of_stack() const { return !is_light() && !is_sample; }
    std::size_t size() const;
    /// The value, for a column without texts.
    double number(std::size_t index) const {
        if (is_sample) return static_cast<double>(index) + 1;
        return scattered ? scattered->at(index) : numbers[index];
    }
    /// The value in the middle of the list.
    nlohmann::json middle() const {
        return scattered ? nlohmann::json(scattered->nominal) : value(size() / 2);
    }
    /// The value as JSON, in the form that --set accepts.
    nlohmann::json value(std::size_t index) const;
    /// The value as printed.
    std::string text(std::size_t index) const;
};

/// All combinations of varied values: every point with every sample with every value of every list;
/// the last list changes fastest.
class SweepSpace {
public:
    /// Throws UsageError or InputError, also for a path that is varied twice or inside another one.
    /// vary       PATH=LIST of numbers, or PATH=comma-separated values that include strings
    /// points     a CSV file of points; "" for none
    /// scattered  the columns of the samples, all of the same length; empty for none
    SweepSpace(const std::vector<std::string>& vary, const std::string& points,
               std::vector<SweptColumn> scattered = {});

    const std::vector<SweptColumn>& columns() const { return columns_; }
    std::uint64_t size() const { return size_; }
    /// Index of the value of a column in a combination.
    std::size_t at(std::size_t column, std::uint64_t combination) const;
    /// Origin of a value of a column: "points.csv: combination 3: " or "--vary PATH: ".
    std::string origin_of(std::size_t column, std::size_t index) const;
    /// "layers.0.thickness_nm=100, substrate=Ag"
    std::string describe(std::uint64_t combination) const;

private:
    void add_points(const std::string& file);
    void add_list(const std::string& text);
    /// Throws InputError unless angles and wavelengths are numbers within their range.
    void check_light(std::size_t column) const;
    void check() const;

    std::vector<SweptColumn> columns_;
    std::string points_file_;
    std::uint64_t points_ = 1, size_ = 1;
};

}  // namespace irido::cli
