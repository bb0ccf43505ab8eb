#include "schemas/material_csv.hpp"

#include "schemas/csv_rows.hpp"

namespace irido {

MaterialFile read_material_csv(std::string_view text, const std::string& name) {
    const auto rows = read_csv_rows(text, name, 2, 3);
    RefractiveIndex index;
    index.n = table_of(rows, 1);
    if (rows[0].values.size() == 3) index.k = table_of(rows, 2);
    return {Material{name, std::move(index), Outside::refuse}, {}, {}};
}

}  // namespace irido
