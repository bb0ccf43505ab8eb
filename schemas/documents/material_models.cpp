#include "schemas/documents/material_models.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "schemas/readers/index_rows.hpp"

namespace irido::schemas {

using nlohmann::json;

double number_or(const json& object, const char* key, double otherwise) {
    const auto found = object.find(key);
    return found == object.end() ? otherwise : found->get<double>();
}

Formula read_cauchy(const json& series) {
    Formula formula{5, {series[0].get<double>()}, kAllWavelengths};
    for (std::size_t i = 1; i < series.size(); ++i) {
        formula.coefficients.push_back(series[i].get<double>());
        formula.coefficients.push_back(-2 * static_cast<double>(i));
    }
    return formula;
}

Formula read_sellmeier(const json& terms) {
    Formula formula{2, {0}, kAllWavelengths};
    for (const json& term : terms) {
        formula.coefficients.push_back(term[0].get<double>());
        formula.coefficients.push_back(term[1].get<double>());
    }
    return formula;
}

LorentzDrude read_lorentz_drude(const json& object) {
    LorentzDrude model;
    model.eps_infinity = number_or(object, "eps_infinity", 1);
    model.plasma_ev = object["plasma_ev"].get<double>();
    model.range = kAllWavelengths;
    for (const json& term : object["oscillators"]) {
        model.oscillators.push_back(
            {term[0].get<double>(), term[1].get<double>(), term[2].get<double>()});
    }
    return model;
}

MaterialFile read_table(const json& rows, const std::string& name) {
    Table n;
    Table k;
    for (const json& row : rows) {
        n.wavelength_nm.push_back(row[0].get<double>());
        n.value.push_back(row[1].get<double>());
        if (row.size() < 3) continue;
        k.wavelength_nm.push_back(row[0].get<double>());
        k.value.push_back(row[2].get<double>());
    }
    const bool is_real =
        std::all_of(k.value.begin(), k.value.end(), [](double v) { return v == 0; });
    return material_of(name, std::move(n), is_real ? std::nullopt : std::optional(std::move(k)),
                       {});
}

std::string index_text(double n, double k) {
    if (k == 0) return to_text(n);
    return to_text(n) + (k > 0 ? "+" : "") + to_text(k) + "i";
}

}  // namespace irido::schemas
