#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/queries/color_query.hpp"
#include "cli/queries/surface_query.hpp"

namespace irido::cli {

/// Named columns of numbers.
using NumberColumns = std::vector<std::pair<std::string, tables::Column::Numbers>>;

/// Rows whose first `keys` columns are keys and whose others are values.
SurfaceRows rows_of(NumberColumns columns, std::size_t keys);

/// Angles of directions, each repeated for its rows.
NumberColumns direction_columns(const std::vector<Directions>& directions, std::size_t times);

/// Throws UsageError if there would be more rows than the limit for surfaces, 1e8.
void require_few_rows(double rows);

/// Colours under one illuminant, as columns.
class ColorColumns {
public:
    explicit ColorColumns(const ColorOptions& typed);

    const Illumination& illumination() const { return illumination_; }
    /// Linear sRGB, for use in pictures.
    Triple drawn(const Triple& xyz) const { return drawn_(xyz); }

    /// Rows of keys and colours.
    SurfaceRows rows(NumberColumns keys, const std::vector<Triple>& colors) const;

private:
    const RgbSpace& space_;
    Illumination illumination_;
    RgbTransform drawn_;
};

}  // namespace irido::cli
