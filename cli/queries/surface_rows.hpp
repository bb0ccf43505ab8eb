#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/queries/color_query.hpp"
#include "cli/queries/surface_query.hpp"

namespace irido::cli {

// Shared by the queries of the kinds of surfaces.

using Numbers = tables::Column::Numbers;
using KeyColumns = std::vector<std::pair<std::string, Numbers>>;

/// Throws UsageError for more rows than a table of surfaces may have.
void require_few_rows(double rows);

/// A table of numbers by its columns, of which the first `keys` say where.
SurfaceRows rows_of(KeyColumns columns, std::size_t keys);

/// Angles of a table, each as often as it has rows.
KeyColumns direction_columns(const std::vector<Directions>& directions, std::size_t times);

/// All numbers, so many times.
Numbers repeated(const Numbers& numbers, std::size_t times);

/// Colours under one illuminant, as columns.
class ColorColumns {
public:
    explicit ColorColumns(const ColorOptions& typed);

    const Illumination& illumination() const { return illumination_; }

    /// Rows of keys and colours; keys are columns already.
    SurfaceRows rows(KeyColumns keys, const std::vector<Triple>& colors) const;

private:
    const RgbSpace& space_;
    Illumination illumination_;
    RgbTransform drawn_;
};

}  // namespace irido::cli
