#include "schemas/documents/equal_materials.hpp"

#include <algorithm>
#include <bit>
#include <functional>

namespace irido::schemas {

namespace {

void mix(std::uint64_t& hash, double value) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(value + 0.0);  // -0 equals 0
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 32U;
}

struct HashOf {
    std::uint64_t hash = 0;

    void operator()(const Constant& constant) { mix(hash, constant.value); }
    void operator()(const Formula& formula) {
        for (const double c : formula.coefficients) mix(hash, c);
    }
    void operator()(const Table& table) {
        constexpr std::size_t enough = 16;  // rows of long tables: equality is checked later
        const std::size_t step = std::max<std::size_t>(table.value.size() / enough, 1);
        for (std::size_t i = 0; i < table.value.size(); i += step) mix(hash, table.value[i]);
    }
    void operator()(const RefractiveIndex& index) {
        std::visit(*this, index.n);
        std::visit(*this, index.k);
    }
    void operator()(const Mixture& mixture) {
        mix(hash, mixture.fraction);
        for (const Material& part : mixture.parts) std::visit(*this, part.model);
    }
    void operator()(const GradedPart& part) {
        mix(hash, static_cast<double>(part.half));
        mix(hash, static_cast<double>(part.steps));
        for (const Material& end : *part.ends) std::visit(*this, end.model);
    }
    void operator()(const Uniaxial& medium) {
        mix(hash, 2);
        for (const Material& part : medium.parts) std::visit(*this, part.model);
    }
    void operator()(const LorentzDrude& model) {
        mix(hash, model.plasma_ev);
        for (const auto& oscillator : model.oscillators) mix(hash, oscillator.strength);
    }
};

}  // namespace

std::uint64_t hash_of(const Material& material) {
    HashOf hash;
    std::visit(std::ref(hash), material.model);
    return hash.hash;
}

bool same_physics(const Material& a, const Material& b) {
    return a.model == b.model && a.outside == b.outside;
}
}  // namespace irido::schemas
