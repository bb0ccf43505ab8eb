#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/render/stack_spectra.hpp"
#include "core/render/vector3.hpp"

namespace irido {

struct ColorNodes;
struct ColorReport;
class LayeredScattering;
enum class Paths;
class RgbTransform;
struct ScratchedSurface;
class Sensitivity;
struct ShownRange;
struct TablePlan;

/// How a surface reflects light, at the wavelengths of a picture. Directions are of unit length,
/// point away from the surface and have z along its normal. Safe from many threads.
class Scatterer {
public:
    virtual ~Scatterer() = default;

    /// Memory of calls on one thread.
    struct Memory {
        std::vector<StackSpectra::Memory> stacks;
        std::vector<float> powers, first, second;
    };

    /// Whether there is a mirror besides the light that is scattered.
    virtual bool mirrors() const = 0;
    /// Whether light is scattered at all.
    virtual bool scatters() const = 0;

    /// Of the mirror: reflectance [s, p][wavelength].
    virtual void mirror(const FilmPoint& at, std::span<float> s_and_p, Memory& memory) const = 0;

    /// A direction where light may come from that is scattered into `to`: those that give much are
    /// drawn often. pick, u and v in (0, 1). Nothing if the draw ends below the surface.
    virtual std::optional<Vector3> draw(const Vector3& to, double pick, double u,
                                        double v) const = 0;
    /// Probability of draw() per steradian.
    virtual double density(const Vector3& to, const Vector3& from) const = 0;
    /// BRDF times the cosine of the light's angle, [wavelength].
    virtual void scatter(const Vector3& to, const Vector3& from, double thickness_nm,
                         std::span<float> spectrum, Memory& memory) const = 0;

    /// How its spectra are computed.
    virtual const ColorReport& report() const = 0;
};

/// Rough layers over a Lambertian base, under a smooth coating or none: LayeredScattering from
/// tables over the angle. Draws a layer as FPB24 eqs. 31 and 35 have it, for one path of all
/// wavelengths, and a facet among those that are seen; the coating's mirror is apart.
///   varied  of the stack of the only layer, whose thickness is within the range
/// Throws DomainError as LayeredScattering does, and if paths are all and not closed.
std::unique_ptr<const Scatterer> layered_scatterer(const LayeredScattering& scattering, Paths paths,
                                                   const LayerPlace& varied,
                                                   const ShownRange& range, const TablePlan& plan);

/// Wavelengths that serve the layers' reflectances, transmittances and their products, as means
/// over facets that tilt by up to alpha.
ColorNodes layered_nodes(const LayeredScattering& scattering, const Sensitivity& sensitivity,
                         const RgbTransform& to_srgb);

/// Fields of scratches in a smooth or rough base, seen on average over all places: what
/// ensemble_brdf() adds up to, from tables over |xi| and the rise of light and view, with the
/// balance of scratch_balance(). Angles are counted from x. Single scratches are left out.
/// The base is already held where its materials are not known. Throws DomainError where grooves are
/// too wide or too deep for a table.
std::unique_ptr<const Scatterer> scratch_scatterer(const ScratchedSurface& surface,
                                                   const TablePlan& plan);

/// Wavelengths that serve the reflectance of the base and the grooves' interference.
ColorNodes scratched_nodes(const ScratchedSurface& surface, const Sensitivity& sensitivity,
                           const RgbTransform& to_srgb, SimdLevel simd);

}  // namespace irido
