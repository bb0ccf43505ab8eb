#include "core/colorimetry/illuminant.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/error.hpp"

namespace irido {
namespace {

#include "core/colorimetry/data/illuminants.inc"

constexpr std::array<std::string_view, 6> kIlluminantNames{"D65", "D50", "A", "E", "FL2", "FL11"};

Table rows_of_5_nm(double first_nm, std::span<const double> power) {
    Table table;
    for (std::size_t i = 0; i < power.size(); ++i) {
        table.wavelength_nm.push_back(first_nm + 5 * static_cast<double>(i));
        table.value.push_back(power[i]);
    }
    return table;
}

/// S(l) = 100 (560/l)^5 (exp(c/560) - 1) / (exp(c/l) - 1) with c = 1.435e7 nm K / 2848 K, l in nm.
/// Source: ISO/CIE 11664-2, where these two numbers define the illuminant.
Table illuminant_a() {
    constexpr double c = 1.435e7 / 2848;
    Table table;
    for (int row_nm = 300; row_nm <= 830; ++row_nm) {
        const double l = row_nm;
        table.wavelength_nm.push_back(l);
        table.value.push_back(100 * std::pow(560 / l, 5) * std::expm1(c / 560) / std::expm1(c / l));
    }
    return table;
}

}  // namespace

Table illuminant(std::string_view name) {
    if (name == "D65") return rows_of_5_nm(300, kD65);
    if (name == "D50") return rows_of_5_nm(300, kD50);
    if (name == "A") return illuminant_a();
    if (name == "E") return {{300, 830}, {100, 100}};
    if (name == "FL2") return rows_of_5_nm(380, kFl2);
    if (name == "FL11") return rows_of_5_nm(380, kFl11);
    throw DomainError("illuminant " + not_one_of(kIlluminantNames, name));
}

std::span<const std::string_view> illuminant_names() {
    return kIlluminantNames;
}

}  // namespace irido
