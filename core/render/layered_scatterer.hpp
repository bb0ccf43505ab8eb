#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/render/color_nodes.hpp"
#include "core/render/grid_table.hpp"
#include "core/render/scatterer.hpp"
#include "core/rough/layered/layered_scattering.hpp"

namespace irido {

/// Tables of spectra for a picture, how they are made and what they took.
struct TablePlan {
    const PictureNodes* nodes = nullptr;
    double tolerance = 0.1;  ///< CIEDE2000 of the colours of a table's spectra
    unsigned threads = 1;
    SimdLevel simd = best_simd_level();
};

/// Colours of two spectra of a table: their CIEDE2000.
GridTable::Distance spectral_distance(const PictureNodes& nodes);

/// The larger of two reports' sizes and errors, evaluations added.
void add_table(const GridTable& table, ColorReport& report);

/// Rough layers over a Lambertian base, under a smooth coating or none: LayeredScattering from
/// tables over the angle. Draws a layer as FPB24 eqs. 31 and 35 have it, for one path of all
/// wavelengths, and a facet among those that are seen; the coating's mirror is apart.
class LayeredScatterer : public Scatterer {
public:
    /// varied  of the stack of the only layer, whose thickness is within the range
    /// Throws DomainError as LayeredScattering does, and if paths are all and not closed.
    LayeredScatterer(const LayeredScattering& scattering, Paths paths, const LayerPlace& varied,
                     const ShownRange& range, const TablePlan& plan);

    bool mirrors() const override { return coating_.is_there(); }
    bool scatters() const override { return !parts_.empty(); }
    void mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const override;
    std::optional<Vector3> draw(const Vector3& to, double pick, double u, double v) const override;
    double density(const Vector3& to, const Vector3& from) const override;
    void scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                 std::span<float> spectrum, Memory& memory) const override;

    const ColorReport& report() const { return report_; }

private:
    /// A layer, or the base.
    struct Part {
        double alpha = 0;                     ///< of a layer
        std::optional<StackSpectra> spectra;  ///< of a layer
        std::optional<GridTable> R;           ///< over theta_d; none: computed each time
        std::optional<GridTable> straight;    ///< tau/G1 of a layer that is crossed
        bool is_base = false;
    };
    void add_layer(const LayeredScattering& scattering, std::size_t l, const LayerPlace& varied,
                   const ShownRange& range, const TablePlan& plan);
    void set_probabilities();
    double inside_cosine(double cosine) const;
    /// Of each part, reached from a cosine outside; sums to 1.
    double probability(std::size_t part, double cosine) const;
    void pass(const Part& part, double cosine, std::span<float> spectrum, Memory& memory) const;

    Coating coating_;
    double ratio_;  ///< index outside over that inside
    std::size_t count_;
    std::vector<Part> parts_;
    std::vector<float> base_;  ///< albedo of the base over pi, between all it meets if so asked
    std::vector<float> probabilities_;  ///< [cosine][part]
    ColorReport report_;
};

/// Wavelengths that serve the layers' reflectances, transmittances and their products, as means
/// over facets that tilt by up to alpha.
ColorNodes layered_nodes(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                         const RgbTransform& to_srgb);

}  // namespace irido
