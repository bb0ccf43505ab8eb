#include "tables/pictures/glyphs.hpp"

#include <charconv>
#include <map>
#include <mutex>

#include "schemas/readers/utf8.hpp"

namespace irido::tables {

namespace {

constexpr std::string_view kGlyphs =
#include "tables/pictures/data/glyphs.inc"
    ;
constexpr char32_t kReplacement = 0xFFFD;

/// Parses "41 1401 M700 1294L426 551" at the start of a text.
class OutlineReader {
public:
    explicit OutlineReader(std::string_view text) : text_(text) {}

    std::uint32_t number(int base = 10) {
        skip_blank();
        std::uint32_t value = 0;
        text_.remove_prefix(static_cast<std::size_t>(
            std::from_chars(text_.data(), text_.data() + text_.size(), value, base).ptr -
            text_.data()));
        return value;
    }
    std::vector<GlyphContour> contours() {
        std::vector<GlyphContour> result;
        skip_blank();
        while (!text_.empty()) {
            const char command = text_.front();
            text_.remove_prefix(1);
            const Point first = point();
            if (command == 'M')
                result.push_back({first, {}});
            else if (command == 'L')
                result.back().curves.push_back({first, first, true});
            else
                result.back().curves.push_back({first, point(), false});
        }
        return result;
    }

private:
    void skip_blank() {
        if (text_.starts_with(' ')) text_.remove_prefix(1);
    }
    double coordinate() {
        skip_blank();
        int value = 0;
        text_.remove_prefix(static_cast<std::size_t>(
            std::from_chars(text_.data(), text_.data() + text_.size(), value).ptr - text_.data()));
        return value;
    }
    Point point() {
        const double x = coordinate();
        return {x, coordinate()};
    }

    std::string_view text_;
};

/// The outline of each character.
std::map<char32_t, std::string_view> lines_of_glyphs() {
    std::map<char32_t, std::string_view> lines;
    for (std::string_view rest = kGlyphs; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const std::size_t blank = line.find(' ');
        lines.emplace(OutlineReader(line).number(16), line.substr(blank));
        rest.remove_prefix(line.size() + 1);
    }
    return lines;
}

}  // namespace

const Glyph& glyph_of(char32_t character) {
    static const std::map<char32_t, std::string_view> lines = lines_of_glyphs();
    static std::map<char32_t, Glyph> glyphs;
    static std::mutex lock;
    const std::scoped_lock guard(lock);
    auto line = lines.find(character);
    if (line == lines.end()) line = lines.find(kReplacement);
    const auto [found, is_new] = glyphs.try_emplace(line->first);
    if (is_new) {
        OutlineReader reader(line->second);
        found->second.advance = reader.number();
        found->second.contours = reader.contours();
    }
    return found->second;
}

std::u32string characters_of(std::string_view text) {
    std::u32string characters;
    for (std::size_t at = 0; at < text.size();)
        characters += schemas::next_code_point(text, at).value_or(kReplacement);
    return characters;
}

double text_width(std::string_view text, double size) {
    double width = 0;
    for (const char32_t character : characters_of(text)) width += glyph_of(character).advance;
    return width * size / kGlyphUnits;
}

}  // namespace irido::tables
