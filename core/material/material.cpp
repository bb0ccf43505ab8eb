#include "core/material/material.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/error.hpp"
#include "core/keep_once.hpp"
#include "core/material/air.hpp"
#include "core/material/formula.hpp"
#include "core/material/linear_value.hpp"
#include "core/math/constants.hpp"
#include "core/math/square.hpp"

namespace irido {

namespace {

constexpr double kLargestIndex = 1e4;
constexpr double kSmallestModulus = 1e-6;

std::string name_of(const Material& material) {
    return material.name.empty() ? "material" : material.name;
}

/// One evaluation: material and wavelength, for error messages.
struct Query {
    const Material& material;
    double wavelength_nm;
    bool holds;  ///< clamp outside the ranges

    double require(std::string_view what, double value, double lowest, double highest) const {
        if (value >= lowest && value <= highest) return value;
        throw DomainError(name_of(material) + ": " + std::string(what) + " must be in [" +
                          to_text(lowest) + ", " + to_text(highest) + "] (got " + to_text(value) +
                          " at " + to_text(wavelength_nm) + " nm)");
    }

    double root(double square) const {
        return std::sqrt(require("n^2", square, 0, kLargestIndex * kLargestIndex));
    }
};

double value_at(const Constant& constant, const Query&) {
    return constant.value;
}

/// The formula's value at a wavelength in um, both in its own reference medium.
double formula_value(const Formula& formula, double um, const Query& query) {
    constexpr int kFormulas = 9;
    if (formula.number < 1 || formula.number > kFormulas)
        throw DomainError(name_of(query.material) + ": formula number must be in [1, 9] (got " +
                          std::to_string(formula.number) + ")");
    const FormulaAt<double> at(formula, um);
    return at.is_square() ? query.root(at.value()) : at.value();
}

double value_at(const Formula& formula, const Query& query) {
    const auto& [index_to_air, wavelength_in_air, temperature_c] = formula.reference;
    const double nm =
        std::clamp(query.wavelength_nm, formula.range.first_nm, formula.range.last_nm);
    const double own_nm = wavelength_in_air ? air_wavelength(nm, temperature_c) : nm;
    const double value = formula_value(formula, own_nm / 1000, query);
    return index_to_air ? value * index_of_air(nm, temperature_c) : value;
}

double value_at(const Table& table, const Query& query) {
    return linear_value(table, query.wavelength_nm);
}

WavelengthRange common(WavelengthRange a, WavelengthRange b) {
    return {std::max(a.first_nm, b.first_nm), std::min(a.last_nm, b.last_nm)};
}

WavelengthRange known_range(const Constant&) {
    return kAllWavelengths;
}

WavelengthRange known_range(const Formula& formula) {
    return formula.range;
}

WavelengthRange known_range(const Table& table) {
    if (table.wavelength_nm.empty() || table.wavelength_nm.size() != table.value.size())
        throw DomainError("a table needs at least one row, and as many values as wavelengths");
    return {table.wavelength_nm.front(), table.wavelength_nm.back()};
}

WavelengthRange known_range(const Dispersion& dispersion) {
    return std::visit([](const auto& form) { return known_range(form); }, dispersion);
}

WavelengthRange known_range(const RefractiveIndex& index) {
    return common(known_range(index.n), known_range(index.k));
}

bool contains(WavelengthRange range, double wavelength_nm) {
    return wavelength_nm >= range.first_nm && wavelength_nm <= range.last_nm;
}

Complex value_at(const RefractiveIndex& index, const Query& query) {
    const auto evaluate = [&](const auto& dispersion) { return value_at(dispersion, query); };
    return {std::visit(evaluate, index.n), std::visit(evaluate, index.k)};
}

Complex known_index(const Material& material, double wavelength_nm, bool holds);

Complex part_at(const Material& part, const Query& query) {
    return known_index(part, query.wavelength_nm, query.holds || part.outside == Outside::clamp);
}

Complex value_at(const Mixture& mixture, const Query& query) {
    const auto part = [&](std::size_t i) { return part_at(mixture.parts[i], query); };
    if (mixture.fraction == 0) return part(1);
    if (mixture.fraction == 1) return part(0);
    query.require("fraction", mixture.fraction, 0, 1);
    return std::sqrt(mixed_permittivity(mixture.rule, part(0), part(1), mixture.fraction));
}

/// In-plane and normal index.
std::array<Complex, 2> indices_of(const GradedPart& part, const Query& query) {
    const std::vector<Material>& ends = *part.ends;
    const auto eps =
        GradedHalfStep(part.half, part.steps)
            .permittivity(part.profile, part_at(ends[0], query), part_at(ends[1], query));
    return {std::sqrt(eps[0]), std::sqrt(eps[1])};
}

Complex value_at(const GradedPart& part, const Query& query) {
    return indices_of(part, query)[0];
}

Complex value_at(const Uniaxial& medium, const Query& query) {
    return part_at(medium.parts[0], query);
}

Complex value_at(const LorentzDrude& model, const Query& query) {
    const double energy = kPhotonEnergy_eVnm / std::clamp(query.wavelength_nm, model.range.first_nm,
                                                          model.range.last_nm);
    Complex permittivity = model.eps_infinity;
    for (const auto& [strength, damping, resonance] : model.oscillators)
        if (strength != 0)
            permittivity += strength * model.plasma_ev * model.plasma_ev /
                            Complex(resonance * resonance - energy * energy, -energy * damping);
    return std::sqrt(permittivity);
}

WavelengthRange known_range(const LorentzDrude& model) {
    return model.range;
}

WavelengthRange range_of_parts(std::span<const Material> parts) {
    WavelengthRange range = kAllWavelengths;
    for (const Material& part : parts)
        if (part.outside == Outside::refuse) range = common(range, range_of(part));
    return range;
}

WavelengthRange known_range(const Mixture& mixture) {
    return range_of_parts(mixture.parts);
}

WavelengthRange known_range(const GradedPart& part) {
    return range_of_parts(*part.ends);
}

WavelengthRange known_range(const Uniaxial& medium) {
    return range_of_parts(medium.parts);
}

std::string in_words(WavelengthRange range) {
    return to_text(range.first_nm) + " to " + to_text(range.last_nm) + " nm";
}

/// Throws unless the material is known or clamped at the wavelength; the parts of a mixture are
/// checked on their own.
void require_known(const Material& material, double wavelength_nm, bool holds) {
    require_in_range("wavelength_nm", wavelength_nm, kAllWavelengths.first_nm,
                     kAllWavelengths.last_nm);
    if (holds || !parts_of(material).empty() || contains(range_of(material), wavelength_nm)) return;
    const auto refuse = [&](const std::string& what, WavelengthRange range) {
        throw DomainError(what + " is known from " + in_words(range) + " (asked for " +
                          to_text(wavelength_nm) + ")");
    };
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    if (index != nullptr && contains(known_range(index->n), wavelength_nm))
        refuse("k of " + name_of(material), known_range(index->k));
    refuse(name_of(material), index != nullptr ? known_range(index->n) : range_of(material));
}

Complex known_index(const Material& material, double wavelength_nm, bool holds) {
    require_known(material, wavelength_nm, holds);
    const Query query{material, wavelength_nm, holds};
    const Complex index =
        std::visit([&](const auto& model) { return value_at(model, query); }, material.model);
    query.require("n", index.real(), 0, kLargestIndex);
    query.require("k", index.imag(), -kLargestIndex, kLargestIndex);
    if (!(std::norm(index) > 2 * square(kSmallestModulus)))  // a square is quicker than the root
        query.require("|n + ik|", std::abs(index), kSmallestModulus,
                      std::numbers::sqrt2 * kLargestIndex);
    return index;
}

}  // namespace

bool Mixture::operator==(const Mixture& other) const {
    return rule == other.rule && fraction == other.fraction && parts == other.parts;
}

bool Uniaxial::operator==(const Uniaxial& other) const {
    return parts == other.parts;
}

bool GradedPart::operator==(const GradedPart& other) const {
    return profile == other.profile && half == other.half && steps == other.steps &&
           (ends == other.ends || *ends == *other.ends);
}

bool is_uniaxial(const Material& material) {
    return std::holds_alternative<Uniaxial>(material.model) ||
           std::holds_alternative<GradedPart>(material.model);
}

const Material* first_uniaxial(std::span<const Material> materials) {
    const auto found = std::ranges::find_if(materials, is_uniaxial);
    return found == materials.end() ? nullptr : &*found;
}

Complex extraordinary_index_at(const Material& material, double wavelength_nm) {
    const Complex ordinary = index_at(material, wavelength_nm);
    if (!is_uniaxial(material)) return ordinary;
    const Query query{material, wavelength_nm, material.outside == Outside::clamp};
    const auto* medium = std::get_if<Uniaxial>(&material.model);
    const Complex index = medium ? part_at(medium->parts[1], query)
                                 : indices_of(std::get<GradedPart>(material.model), query)[1];
    if (ordinary.imag() * index.imag() < 0)
        throw DomainError(name_of(material) +
                          ": must not absorb along one axis and amplify along another (k " +
                          to_text(ordinary.imag()) + " and " + to_text(index.imag()) + " at " +
                          to_text(wavelength_nm) + " nm)");
    return index;
}

std::span<const Material> parts_of(const Material& material) {
    if (const auto* mixture = std::get_if<Mixture>(&material.model)) return mixture->parts;
    if (const auto* medium = std::get_if<Uniaxial>(&material.model)) return medium->parts;
    if (const auto* part = std::get_if<GradedPart>(&material.model)) return *part->ends;
    return {};
}

WavelengthRange range_of(const Material& material) {
    return common(kAllWavelengths,
                  std::visit([](const auto& model) { return known_range(model); }, material.model));
}

Complex index_at(const Material& material, double wavelength_nm) {
    return known_index(material, wavelength_nm, material.outside == Outside::clamp);
}

bool is_constant(const Material& material) {
    const std::span<const Material> parts = parts_of(material);
    if (!parts.empty()) return std::ranges::all_of(parts, is_constant);
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    return index != nullptr && std::holds_alternative<Constant>(index->n) &&
           std::holds_alternative<Constant>(index->k);
}

namespace {

/// Appends the rows of all tables of a material.
void add_rows(const Material& material, std::vector<double>& rows) {
    for (const Material& part : parts_of(material)) add_rows(part, rows);
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    if (index == nullptr) return;
    for (const Dispersion* dispersion : {&index->n, &index->k})
        if (const auto* table = std::get_if<Table>(dispersion))
            rows.insert(rows.end(), table->wavelength_nm.begin(), table->wavelength_nm.end());
}

/// Appends the wavelengths inside `between` and `known` where n or k has a kink, including the ends
/// of clamped ranges.
void add_kinks(const Material& material, WavelengthRange between, WavelengthRange known, bool holds,
               std::vector<double>& found) {
    for (const Material& part : parts_of(material))
        add_kinks(part, between, known, holds || part.outside == Outside::clamp, found);
    const auto take = [&](double nm) {
        if (nm > between.first_nm && nm < between.last_nm && contains(known, nm))
            found.push_back(nm);
    };
    const auto take_ends = [&](WavelengthRange range) {
        if (!holds) return;
        take(range.first_nm);
        take(range.last_nm);
    };
    if (const auto* index = std::get_if<RefractiveIndex>(&material.model))
        for (const Dispersion* dispersion : {&index->n, &index->k})
            if (const auto* table = std::get_if<Table>(dispersion))
                std::for_each(table->wavelength_nm.begin(), table->wavelength_nm.end(), take);
            else
                take_ends(known_range(*dispersion));
    else if (parts_of(material).empty())
        take_ends(range_of(material));
}

}  // namespace

std::vector<double> table_rows(const Material& material, WavelengthRange between) {
    std::vector<double> rows;
    if (is_uniaxial(material)) return rows;
    add_rows(material, rows);
    if (rows.empty()) return rows;
    const std::vector<double> all = kinks(material, between);
    std::ranges::sort(rows);
    std::vector<double> found;
    std::ranges::set_intersection(all, rows, std::back_inserter(found));
    return found;
}

std::vector<double> kinks(const Material& material, WavelengthRange between) {
    const bool holds = material.outside == Outside::clamp;
    std::vector<double> found;
    add_kinks(material, between, holds ? kAllWavelengths : range_of(material), holds, found);
    keep_once(found);
    return found;
}

}  // namespace irido
