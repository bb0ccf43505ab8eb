#pragma once

#include "core/color/color_tables.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"

namespace irido::test {

/// Of the 2 degree observer under D65, made once.
inline const ColorTables& d65_tables() {
    static const ColorTables tables(Sensitivity(observer(2), illuminant("D65")));
    return tables;
}

}  // namespace irido::test
