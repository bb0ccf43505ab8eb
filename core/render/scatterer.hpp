#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/render/stack_spectra.hpp"
#include "core/render/vector3.hpp"

namespace irido {

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
};

}  // namespace irido
