#pragma once

#include <string_view>
#include <vector>

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// The only typeface of pictures, the same on every machine: DejaVu Sans with Latin, Greek and
/// Cyrillic letters, superscript and subscript digits and some signs.
inline constexpr const char* kTypeface = "DejaVu Sans";

/// Units of glyph coordinates per font size.
inline constexpr double kGlyphUnits = 2048;

/// A closed contour of a glyph: a starting point, then a control point and an end point for each
/// quadratic curve; y upwards, in units of 1/2048 of the font size.
struct GlyphContour {
    Point first;
    struct Curve {
        Point control, end;
        bool straight;  ///< the control point is ignored
    };
    std::vector<Curve> curves;
};

struct Glyph {
    double advance = 0;
    std::vector<GlyphContour> contours;
};

/// The glyph of a character; characters missing from the typeface look like U+FFFD.
const Glyph& glyph_of(char32_t character);

/// The characters of well-formed text.
std::u32string characters_of(std::string_view text);

/// Width of a line of text.
double text_width(std::string_view text, double size);

}  // namespace irido::tables
