#include "schemas/documents/canonical_stack.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/material/library.hpp"
#include "schemas/documents/material_words.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

json range_json(const WavelengthRange& range) {
    return json::array({range.first_nm, range.last_nm});
}

struct DispersionJson {
    json operator()(const Constant& constant) const { return constant.value; }
    json operator()(const Formula& formula) const {
        json result = {{"formula", formula.number},
                       {"coefficients", formula.coefficients},
                       {"range_nm", range_json(formula.range)}};
        const auto& [index_to_air, wavelength_in_air, temperature_c] = formula.reference;
        if (index_to_air || wavelength_in_air)
            result["in_air"] = {{"index", index_to_air},
                                {"wavelength", wavelength_in_air},
                                {"temperature_c", temperature_c}};
        return result;
    }
    json operator()(const Table& table) const {
        json rows = json::array();
        for (std::size_t i = 0; i < table.value.size(); ++i)
            rows.push_back(json::array({table.wavelength_nm[i], table.value[i]}));
        return {{"table", std::move(rows)}};
    }
};

/// n and k as one table of a stack document, if they have the same wavelengths or k is 0.
json table_json(const Table& n, const Dispersion& k) {
    const auto* const k_table = std::get_if<Table>(&k);
    const bool is_real = k == Dispersion(Constant{0});
    if (!is_real && !(k_table && k_table->wavelength_nm == n.wavelength_nm)) return nullptr;
    json rows = json::array();
    for (std::size_t i = 0; i < n.value.size(); ++i) {
        json row = json::array({n.wavelength_nm[i], n.value[i]});
        if (!is_real) row.push_back(k_table->value[i]);
        rows.push_back(std::move(row));
    }
    return {{"table", std::move(rows)}};
}

/// A formula as the document's cauchy or sellmeier, if it is one of these and valid everywhere.
json formula_json(const Formula& formula, const Dispersion& k) {
    const std::vector<double>& c = formula.coefficients;
    if (k != Dispersion(Constant{0}) || formula.range != kAllWavelengths || c.empty() ||
        formula.reference != Reference{})
        return nullptr;
    json terms = json::array();
    if (formula.number == 5) {
        terms.push_back(c[0]);
        for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
            if (c[i + 1] != -static_cast<double>(i + 1)) return nullptr;
            terms.push_back(c[i]);
        }
        return {{"cauchy", std::move(terms)}};
    }
    if (formula.number != 2 || c[0] != 0 || c.size() < 3) return nullptr;
    for (std::size_t i = 1; i + 1 < c.size(); i += 2)
        terms.push_back(json::array({c[i], c[i + 1]}));
    return {{"sellmeier", std::move(terms)}};
}

json index_json(const RefractiveIndex& index) {
    const auto* const n = std::get_if<Constant>(&index.n);
    const auto* const k = std::get_if<Constant>(&index.k);
    if (n && k && k->value == 0) return n->value;
    json result;
    if (const auto* const table = std::get_if<Table>(&index.n))
        result = table_json(*table, index.k);
    if (const auto* const formula = std::get_if<Formula>(&index.n))
        result = formula_json(*formula, index.k);
    if (!result.is_null()) return result;
    return {{"n", std::visit(DispersionJson{}, index.n)},
            {"k", std::visit(DispersionJson{}, index.k)}};
}

json lorentz_drude_json(const LorentzDrude& model) {
    json oscillators = json::array();
    for (const LorentzDrude::Oscillator& o : model.oscillators)
        oscillators.push_back(json::array({o.strength, o.damping_ev, o.resonance_ev}));
    json object = {{"eps_infinity", model.eps_infinity},
                   {"plasma_ev", model.plasma_ev},
                   {"oscillators", std::move(oscillators)}};
    if (model.range != kAllWavelengths) object["range_nm"] = range_json(model.range);
    return {{"lorentz_drude", std::move(object)}};
}

json material_json(const Material& material);

json mixture_json(const Mixture& mixture) {
    return {{"mixture",
             {{"inclusion", material_json(mixture.parts[0])},
              {"host", material_json(mixture.parts[1])},
              {"fraction", mixture.fraction},
              {"model", name_of(mixture.rule)}}}};
}

/// Not a valid document, only a key to tell stacks apart.
json graded_part_json(const GradedPart& part) {
    return {{"graded_part",
             {{"from", material_json((*part.ends)[0])},
              {"to", material_json((*part.ends)[1])},
              {"profile", name_of(part.profile)},
              {"half_step", part.half},
              {"steps", part.steps}}}};
}

json uniaxial_json(const Uniaxial& medium) {
    return {{"ordinary", material_json(medium.parts[0])},
            {"extraordinary", material_json(medium.parts[1])}};
}

struct ModelJson {
    json operator()(const RefractiveIndex& index) const { return index_json(index); }
    json operator()(const LorentzDrude& model) const { return lorentz_drude_json(model); }
    json operator()(const Mixture& mixture) const { return mixture_json(mixture); }
    json operator()(const Uniaxial& medium) const { return uniaxial_json(medium); }
    json operator()(const GradedPart& part) const { return graded_part_json(part); }
};

json material_json(const Material& material) {
    if (const auto built_in = find_material(material.name);
        built_in && built_in->material.model == material.model && !is_constant(material)) {
        if (built_in->material.outside == material.outside) return material.name;
        if (material.outside == Outside::clamp)
            return {{"name", material.name}, {"extrapolate", "clamp"}};
    }
    json result = std::visit(ModelJson{}, material.model);
    const bool is_named = !material.name.empty() && material.name[0] != '/';
    if (is_named && std::holds_alternative<Mixture>(material.model)) result["name"] = material.name;
    if (material.outside == Outside::clamp && !is_constant(material))
        result["extrapolate"] = "clamp";
    return result;
}

class Writer {
public:
    explicit Writer(const Stack& stack) {
        for (const Material& material : stack.materials)
            materials_.push_back(material_json(material));
    }

    const json& material(std::size_t place) const { return materials_[place]; }

    void append(json& array, const std::vector<Element>& elements) const {
        for (const Element& element : elements) {
            if (const auto* const layer = std::get_if<Layer>(&element.value))
                array.push_back(layer_json(*layer));
            else
                append_group(array, std::get<Group>(element.value));
        }
    }

private:
    json layer_json(const Layer& layer) const {
        json result = {{"material", material(layer.material)},
                       {"thickness_nm", layer.thickness_nm}};
        if (layer.thickness_sigma_nm != 0) result["thickness_sigma_nm"] = layer.thickness_sigma_nm;
        if (!layer.coherent) result["coherent"] = false;
        return result;
    }

    void append_group(json& array, const Group& group) const {
        if (group.repeat == 1) return append(array, group.elements);
        json layers = json::array();
        append(layers, group.elements);
        array.push_back({{"repeat", group.repeat}, {"layers", std::move(layers)}});
    }

    std::vector<json> materials_;
};

}  // namespace

json canonical_stack(const Stack& stack) {
    const Writer writer(stack);
    json layers = json::array();
    writer.append(layers, stack.elements);
    return {{"incident", writer.material(stack.incident)},
            {"layers", std::move(layers)},
            {"substrate", writer.material(stack.substrate)}};
}

}  // namespace irido::schemas
