#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/material/material.hpp"
#include "schemas/readers/material_file.hpp"

namespace irido::schemas {

// Readers of material models from values that stack.schema.json has accepted.

/// The number at a key, or `otherwise` if the key is missing.
double number_or(const nlohmann::json& object, const char* key, double otherwise);

/// n = A + B/L^2 + C/L^4 + ... as formula 5 with coefficients A and (B, -2), (C, -4), ...
Formula read_cauchy(const nlohmann::json& series);

/// n^2 = 1 + sum B L^2/(L^2 - C) as formula 2 with a first coefficient of 0.
Formula read_sellmeier(const nlohmann::json& terms);

LorentzDrude read_lorentz_drude(const nlohmann::json& object);

/// Rows [nm, n] or [nm, n, k]; k is known only in the rows that give it, and 0 if none does.
MaterialFile read_table(const nlohmann::json& rows, const std::string& name);

/// "1.9+1.5i"
std::string index_text(double n, double k);

}  // namespace irido::schemas
