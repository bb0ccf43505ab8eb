#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/math/simd_level.hpp"
#include "core/render/surface_stack.hpp"

namespace irido {

/// Reflectance and transmittance of a stack on a surface at given wavelengths, of s and p, for
/// angles and thicknesses that change from call to call. Safe from many threads.
class StackSpectra {
public:
    /// Throws DomainError as IndexTable does.
    StackSpectra(SurfaceStack surface, const std::vector<double>& wavelength_nm, SimdLevel simd);
    ~StackSpectra();
    StackSpectra(StackSpectra&&) noexcept;

    std::size_t count() const;  ///< of wavelengths

    /// Memory of calls of one StackSpectra on one thread.
    class Memory {
    public:
        Memory();
        ~Memory();
        Memory(Memory&&) noexcept;

    private:
        friend class StackSpectra;
        struct Kernel;
        std::unique_ptr<Kernel> kernel_;
    };

    /// powers  [R, T][s, p][wavelength]
    void operator()(const FilmPoint& at, std::span<float> powers, Memory& memory) const;

private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace irido
