#include "core/render/stack_spectra.hpp"

#include <algorithm>

#include "core/spectrum/spectrum.hpp"
#include "core/stack/index_table.hpp"

namespace irido {

namespace {

constexpr Needs kPowersSeen{.A = false};

}  // namespace

struct StackSpectra::Parts {
    SurfaceStack surface;
    IndexTable indices;
    std::size_t count;
    SimdLevel simd;
};

/// The stack with a thickness, in memory that is used again.
struct StackSpectra::Memory::Kernel {
    explicit Kernel(const Parts& of)
        : surface(of.surface),
          power(surface.stack),
          kernel(power, of.indices.absorbs(), of.indices.amplifies(), kPowersSeen, of.simd) {}

    SurfaceStack surface;
    StackPower power;
    SpectrumKernel kernel;
    Spectra spectra;
    SpectrumMemory memory;
};

StackSpectra::Memory::Memory() = default;
StackSpectra::Memory::~Memory() = default;
StackSpectra::Memory::Memory(Memory&&) noexcept = default;
StackSpectra::~StackSpectra() = default;
StackSpectra::StackSpectra(StackSpectra&&) noexcept = default;

StackSpectra::StackSpectra(SurfaceStack surface, const std::vector<double>& wavelength_nm,
                           SimdLevel simd) {
    IndexTable indices(surface.stack, wavelength_nm);
    parts_ = std::make_unique<const Parts>(
        Parts{std::move(surface), std::move(indices), wavelength_nm.size(), simd});
}

std::size_t StackSpectra::count() const {
    return parts_->count;
}

void StackSpectra::operator()(const FilmPoint& at, std::span<float> powers, Memory& memory) const {
    if (!memory.kernel_) memory.kernel_ = std::make_unique<Memory::Kernel>(*parts_);
    Memory::Kernel& own = *memory.kernel_;
    if (!own.surface.varied.empty()) {
        own.surface.set(at.thickness_nm);
        own.power.assign(own.surface.stack);
        own.kernel.update();
    }
    const IncidentAngle angle(at.cosine);
    own.kernel(parts_->indices, {&angle, 1}, own.spectra, own.memory);
    auto to = powers.begin();
    const Spectra& found = own.spectra;
    for (const auto* values : {&found.s.R, &found.p.R, &found.s.T, &found.p.T})
        to = std::ranges::transform(*values, to, [](double value) {
                 return static_cast<float>(value);
             }).out;
}

}  // namespace irido
