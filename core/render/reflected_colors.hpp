#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/color/stack_color.hpp"
#include "core/colorimetry/space.hpp"
#include "core/render/grid_table.hpp"
#include "core/render/surface_stack.hpp"

namespace irido {

/// How colours of a picture are computed.
struct ColorPlan {
    ShownRange range;
    std::size_t points = 0;  ///< how many colours the picture shows, more or less
    double tolerance = 0.1;  ///< of a table, CIEDE2000
    bool exact = false;      ///< no table
    ColorMethod method{};    ///< of colours that are reflected once
    unsigned threads = 1;
    SimdLevel simd = best_simd_level();
};

/// How they were.
struct ColorReport {
    std::size_t cosines = 0, thicknesses = 0;  ///< of the table; 0: there is none
    std::size_t evaluations = 0;               ///< colours computed for it, or spectra
    double error = 0;                          ///< of the table, measured, CIEDE2000
    double color_error = 0;                    ///< of X, Y, Z of a colour, the largest
    std::size_t wavelengths = 0;               ///< of spectra; 0: those that each colour needs
    std::string reason;                        ///< why so
};

/// Linear sRGB of the light that a stack reflects, unpolarized, of the illuminant's white {1, 1,
/// 1}. Safe from many threads; a colour depends on its point alone.
class ReflectedColors {
public:
    /// Materials hold their end values outside their range. `tables` must outlive it. Throws as
    /// color_algorithm() does.
    ReflectedColors(const ColorTables& tables, const RgbTransform& to_srgb, SurfaceStack stack,
                    const ColorPlan& plan);

    void operator()(std::span<const FilmPoint> points, std::span<Triple> colors) const;

    /// Of the colours so far.
    ColorReport report() const;

private:
    /// Colours [cosine][channel] of one thickness.
    void compute(double thickness_nm, std::span<const double> cosines,
                 std::span<float> values) const;
    void compute_each(std::span<const FilmPoint> points, std::span<Triple> colors) const;

    SurfaceStack stack_;
    RgbTransform to_srgb_;
    std::unique_ptr<const ColorAlgorithm> algorithm_;
    std::optional<GridTable> table_;
    ColorReport report_;
    mutable std::atomic<double> color_error_ = 0;
};

}  // namespace irido
