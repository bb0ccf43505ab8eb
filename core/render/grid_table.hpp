#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace irido {

/// The range of angles and thicknesses of a surface that a picture shows.
struct ShownRange {
    double least_cosine = 0, largest_cosine = 1;  ///< of the angle of incidence, within [0, 1]
    double least_nm = 0, largest_nm = 0;          ///< of the thickness that varies

    bool is_uniform() const { return least_nm == largest_nm; }
    bool has_one_angle() const { return least_cosine == largest_cosine; }
};

/// Values of a smooth function of the cosine of an angle and of a thickness, interpolated by cubics
/// between equally spaced samples. A tenth of the samples of linear interpolation, or less.
class GridTable {
public:
    /// Values [cosine][channel] at one thickness. Safe from many threads.
    using Function = std::function<void(double thickness_nm, std::span<const double> cosines,
                                        std::span<float> values)>;
    /// The distance between two samples' channels, in the unit of the tolerance.
    using Distance = std::function<double(std::span<const float>, std::span<const float>)>;

    struct Plan {
        ShownRange range;
        std::size_t channels = 3;
        double tolerance = 0.1;
        std::size_t most_samples = 0;  ///< limit beyond which a table does not pay off
        unsigned threads = 1;
    };

    /// Refines both axes until the interpolation error, measured at cell centres, is below the
    /// tolerance. Gives up (is_good() is false) if that takes more samples than the plan allows.
    GridTable(const Plan& plan, const Function& function, const Distance& distance);

    bool is_good() const { return is_good_; }
    std::size_t cosines() const { return cosines_; }
    std::size_t thicknesses() const { return thicknesses_; }
    std::size_t channels() const { return plan_.channels; }
    /// Samples computed, those of the measurement included.
    std::size_t evaluations() const { return evaluations_; }
    /// The largest distance that was measured.
    double error() const { return error_; }

    /// The channels at a place of the range.
    void lookup(double cosine, double thickness_nm, std::span<float> values) const;

private:
    double cosine(double index, std::size_t count) const;
    double thickness(double index, std::size_t count) const;
    std::size_t at(std::size_t thickness, std::size_t cosine) const {
        return (thickness * cosines_ + cosine) * plan_.channels;
    }
    double refine_cosines(const Function& function, const Distance& distance);
    double refine_thicknesses(const Function& function, const Distance& distance);
    double measured(const Function& function, const Distance& distance, bool along_cosines);

    Plan plan_;
    std::size_t cosines_, thicknesses_, evaluations_ = 0;
    std::vector<float> values_;  ///< [thickness][cosine][channel]
    double error_ = 0;
    bool is_good_ = false;
};

}  // namespace irido
