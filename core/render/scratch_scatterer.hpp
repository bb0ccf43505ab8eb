#pragma once

#include <optional>
#include <vector>

#include "core/render/layered_scatterer.hpp"
#include "core/scratch/scratched_surface.hpp"

namespace irido {

/// Fields of scratches in a smooth or rough base, seen on average over all places: what
/// ensemble_brdf() adds up to, from tables over |xi| and the rise of light and view, with the
/// balance of scratch_balance(). Angles are counted from x. Single scratches are left out.
class ScratchScatterer : public Scatterer {
public:
    /// The base is already held where its materials are not known. Throws DomainError where grooves
    /// are too wide or too deep for a table.
    ScratchScatterer(const ScratchedSurface& surface, const TablePlan& plan);

    bool mirrors() const override { return base_ && !alpha_; }
    bool scatters() const override { return !fields_.empty() || alpha_; }
    void mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const override;
    std::optional<Vector3> draw(const Vector3& to, double pick, double u, double v) const override;
    double density(const Vector3& to, const Vector3& from) const override;
    void scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                 std::span<float> spectrum, Memory& memory) const override;

    const ColorReport& report() const { return report_; }

private:
    /// Scratches whose angles spread evenly over a range.
    struct Field {
        double low, high;                ///< of their angles, rad
        std::optional<GridTable> power;  ///< BRDF times |xi| over |xi| and the rise, of all angles
        std::vector<double> sums;        ///< chances of |xi| up to each of equal steps
    };
    void add_field(const ScratchField& field, const ScratchOptics& optics, const TablePlan& plan);
    void add_balance(const ScratchedSurface& surface, const TablePlan& plan);
    double angle_share(const Field& field, double angle, double size) const;
    double field_density(const Field& field, const Vector3& to, const Vector3& from) const;

    std::size_t count_;
    std::vector<float> wavenumber_;  ///< of the nodes, 1/um
    ScratchOptics optics_;
    std::optional<double> alpha_;
    std::optional<StackSpectra> base_;
    std::optional<GridTable> base_table_;  ///< mean R over theta_d
    std::optional<GridTable> balance_;     ///< [base, scratches][node] over the view's cosine
    std::vector<Field> fields_;
    ColorReport report_;
};

/// Wavelengths that serve the reflectance of the base and the grooves' interference.
ColorNodes scratched_nodes(const ScratchedSurface& surface, const Sensitivity& sensitivity,
                           const RgbTransform& to_srgb, SimdLevel simd);

}  // namespace irido
