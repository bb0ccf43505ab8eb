#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/coherent/layer.hpp"
#include "core/coherent/slab_response.hpp"
#include "core/stack/stack.hpp"

namespace irido {

/// The fields at one depth, relative to an incident wave with |E| = 1, and its power.
struct FieldPoint {
    std::size_t medium = 0;            ///< 0 incident, 1..L the layers, L + 1 the substrate
    double Ex2 = 0, Ey2 = 0, Ez2 = 0;  ///< |E|^2 along the surface and the plane of incidence,
                                       ///< across that plane, along the normal
    double absorbed_per_nm = 0;        ///< of the incident power; gain is negative
    double flux = 0;                   ///< along z, of the incident power

    double intensity() const { return Ex2 + Ey2 + Ez2; }
};

/// Absorption, penetration depth and peak field of one layer, or of the substrate (the last one).
struct LayerProfile {
    double absorbed = 0;                   ///< of the incident power; 0 in a real substrate
    std::optional<double> penetration_nm;  ///< 1/e depth of a wave's intensity, none where it
                                           ///< travels without loss
    double largest_E2 = 0, largest_at_nm = 0;
};

/// The electric field in a stack of coherent layers over its depth: z = 0 at the first face,
/// growing into the stack; a z on a face belongs to the medium below it. The tangential fields (B,
/// C) are carried from the substrate up, and inside a layer from its lower face, where waves that
/// die away are largest, with their logarithm of scale:
///     s: Ey = B      p: Ex = B, Ez = -(S/eps) C
/// in units of the incident wave's tangential part, 1 for s and cos(theta) for p. The flux is that
/// at the face below and what is absorbed on the way to it, an exact integral.
class FieldProfile {
public:
    /// Limit on the number of layers, repetitions included.
    static constexpr std::size_t kMostLayers = 100000;

    /// Throws DomainError at 90 degrees, and for too many layers.
    ///   stack         coherent, of fixed thicknesses
    ///   media         one per material, followed by the incident medium
    ///   k0            2 pi / wavelength, 1/nm
    ///   at            direction of the light in the incident medium
    ///   polarization  s or p, the one that `media` were computed for
    FieldProfile(const Stack& stack, std::span<const Medium> media, double k0, IncidentAngle at,
                 Polarization polarization);

    /// Faces from the first, 0, to the last, nm.
    const std::vector<double>& faces_nm() const { return faces_nm_; }

    FieldPoint at(double z_nm) const;

    /// Number of layers, each sliced layer counted once.
    std::size_t layers() const { return listed_.empty() ? 0 : listed_.back() + 1; }

    /// Profile of medium 1..L + 1; given the other polarization's profile as well, that of
    /// unpolarized light.
    LayerProfile layer(std::size_t medium, const FieldProfile* other = nullptr) const;

private:
    /// exp(log_scale) (b, c) and the flux, in the same scale, of what is below
    struct Fields {
        Complex b, c;
        double log_scale = 0, flux = 0;
    };

    void add(const std::vector<Element>& elements);
    const Medium& medium(std::size_t number) const;
    /// The medium that is listed for one of the parts, or the substrate.
    std::size_t listed(std::size_t number) const;
    LayerProfile part(std::size_t number, const FieldProfile* other) const;
    double intensity_in(std::size_t number, double up_nm) const;
    double absorbed_in(std::size_t number) const;
    /// By `depth_nm` up from fields at the lower face of a medium.
    Fields above(const Fields& below, const Medium& m, double depth_nm) const;
    FieldPoint point(std::size_t number, const Fields& at) const;

    std::vector<Medium> layers_;       ///< parts of a layer each for itself, as everywhere below
    std::vector<std::size_t> listed_;  ///< of which layer they are
    std::vector<double> faces_nm_;
    std::vector<Fields> at_faces_;
    Medium incident_, substrate_;
    Wave out_;
    double k0_, across2_;  ///< S^2
    Polarization polarization_;
    double amplitude2_ = 1, power_ = 1;  ///< of the incident wave in the fields' units
    double log_scale_ = 0;
};

}  // namespace irido
