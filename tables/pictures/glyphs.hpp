#pragma once

#include <string_view>
#include <vector>

#include "tables/pictures/drawing.hpp"

namespace irido::tables {

/// The one typeface of pictures, the same on every machine: DejaVu Sans for Latin, Greek and
/// Cyrillic letters, raised and lowered digits and some signs.
inline constexpr const char* kTypeface = "DejaVu Sans";

/// Coordinates of glyphs are whole numbers of this part of the font size.
inline constexpr double kGlyphUnits = 2048;

/// A contour of a glyph, closed: a point to begin at, then a control and an end of each quadratic
/// curve; y upwards, in units of 1/2048 of the font size.
struct GlyphContour {
    Point first;
    struct Curve {
        Point control, end;
        bool straight;  ///< the control does not matter
    };
    std::vector<Curve> curves;
};

struct Glyph {
    double advance = 0;
    std::vector<GlyphContour> contours;
};

/// Of a character; a character that the typeface lacks looks like U+FFFD.
const Glyph& glyph_of(char32_t character);

/// The characters of well-formed text.
std::u32string characters_of(std::string_view text);

/// Length of a line of text.
double text_width(std::string_view text, double size);

}  // namespace irido::tables
