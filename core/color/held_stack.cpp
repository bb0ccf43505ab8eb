#include "core/color/held_stack.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/keep_once.hpp"

namespace irido {

namespace {

/// Every material must be known here, or say what it does outside its range.
constexpr WavelengthRange kEssential{400, 700};

}  // namespace

std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity) {
    const WavelengthRange support = sensitivity.support();
    std::vector<HeldRange> held;
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        const Material& material = stack.materials[m];
        const WavelengthRange range = range_of(material);
        if (material.outside == Outside::clamp ||
            (range.first_nm <= support.first_nm && range.last_nm >= support.last_nm))
            continue;
        HeldRange entry{m, range, true, {}};
        entry.usable = range.first_nm <= kEssential.first_nm && range.last_nm >= kEssential.last_nm;
        const WavelengthRange inside{std::max(range.first_nm, support.first_nm),
                                     std::min(range.last_nm, support.last_nm)};
        const Triple known =
            inside.first_nm < inside.last_nm ? sensitivity.integral(inside) : Triple{};
        for (std::size_t c = 0; c < 3; ++c)
            entry.weight[c] = std::max(0.0, 1 - known[c] / sensitivity.white()[c]);
        held.push_back(entry);
    }
    return held;
}

Stack held_stack(const Stack& stack, const Sensitivity& sensitivity) {
    for (const HeldRange& entry : held_ranges(stack, sensitivity))
        if (!entry.usable)
            throw DomainError(
                stack.materials[entry.material].name + " must be known from 400 to 700 nm (got " +
                to_text(entry.range.first_nm) + " to " + to_text(entry.range.last_nm) + " nm)");
    Stack held = stack;
    for (Material& material : held.materials) material.outside = Outside::clamp;
    return held;
}

std::vector<double> smooth_pieces(const Stack& stack, WavelengthRange support, bool with_rows) {
    std::vector<double> ends{support.first_nm, support.last_nm};
    const auto add = [&](double wavelength) {
        if (wavelength > support.first_nm && wavelength < support.last_nm)
            ends.push_back(wavelength);
    };
    for (const Material& material : stack.materials) {
        if (is_constant(material)) continue;
        const std::vector<double> rows =
            with_rows ? std::vector<double>{} : table_rows(material, support);
        const WavelengthRange range = range_of(material);
        std::vector<double> own = kinks(material, support);
        own.insert(own.end(), {range.first_nm, range.last_nm});
        for (const double nm : own)
            if (!std::ranges::binary_search(rows, nm)) add(nm);
    }
    keep_once(ends);
    return ends;
}

bool is_real(const Material& material) {
    if (is_uniaxial(material)) return false;
    const std::span<const Material> parts = parts_of(material);
    if (!parts.empty()) return std::ranges::all_of(parts, is_real);
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    if (!index) return false;
    if (const auto* k = std::get_if<Constant>(&index->k)) return k->value == 0;
    const auto* k = std::get_if<Table>(&index->k);
    return k && std::ranges::all_of(k->value, [](double value) { return value == 0; });
}

bool is_surveyed(const Material& material) {
    const std::span<const Material> parts = parts_of(material);
    if (!parts.empty()) return std::ranges::all_of(parts, is_surveyed);
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    return index != nullptr && !std::holds_alternative<Formula>(index->k);
}

std::vector<std::size_t> varied_elements(const Stack& stack, std::span<const LayerPlace> varied) {
    std::vector<std::size_t> elements;
    for (const LayerPlace& place : varied) {
        if (place.empty() || place[0] >= stack.elements.size())
            throw DomainError("varied layers must be layers of the stack");
        elements.push_back(place[0]);
    }
    keep_once(elements);
    return elements;
}

}  // namespace irido
