// PDF 1.4, one page of the picture's size, with nothing that depends on time or machine. Text stays
// text: its glyphs are type 3 fonts, drawn from the same outlines as elsewhere, with a character
// map for searching and copying. Source: ISO 32000-1.

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/error.hpp"
#include "schemas/readers/utf8.hpp"
#include "tables/pictures/glyphs.hpp"
#include "tables/pictures/outline.hpp"
#include "tables/pictures/picture_format.hpp"
#include "tables/records/records.hpp"

namespace irido::tables {

namespace {

constexpr double kPoints = 0.75;  ///< points of 1/72 inch per unit
constexpr std::size_t kCodes = 255;
constexpr double kHaloWidth = 3;

std::string number(double value) {
    std::string text;
    append_number(text, std::round(value * 1000) / 1000 + 0.0);
    return text + " ";
}

std::string component(std::uint16_t value) {
    return number(value / 65535.0);
}

std::string color(const Ink& ink, const char* command) {
    return component(ink.r) + component(ink.g) + component(ink.b) + command + "\n";
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                  6) != Z_OK)
        throw Error("PDF: no memory");
    out.resize(size);
    return out;
}

std::string utf16(char32_t character) {
    std::array<char, 16> text{};
    if (character < 0x10000) {
        std::snprintf(text.data(), text.size(), "%04X", static_cast<unsigned>(character));
    } else {
        const auto rest = static_cast<unsigned>(character) - 0x10000U;
        std::snprintf(text.data(), text.size(), "%04X%04X", 0xD800U + (rest >> 10U),
                      0xDC00U + (rest & 0x3FFU));
    }
    return text.data();
}

/// The objects of a file and their offsets.
class File {
public:
    File() { bytes_ = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n"; }

    /// Reserves the number of a later object.
    std::size_t reserve() {
        places_.push_back(0);
        return places_.size();
    }
    void put(std::size_t object, const std::string& text) {
        places_[object - 1] = bytes_.size();
        bytes_ += std::to_string(object) + " 0 obj\n" + text + "\nendobj\n";
    }
    std::size_t add(const std::string& text) {
        const std::size_t object = reserve();
        put(object, text);
        return object;
    }
    std::size_t add_stream(const std::string& entries, const std::string& content) {
        const std::string packed = deflated(content);
        return add("<<" + entries + "/Filter/FlateDecode/Length " + std::to_string(packed.size()) +
                   ">>\nstream\n" + packed + "\nendstream");
    }
    std::string finish(std::size_t root, std::size_t info) {
        const std::size_t table = bytes_.size();
        bytes_ += "xref\n0 " + std::to_string(places_.size() + 1) + "\n0000000000 65535 f \n";
        for (const std::size_t place : places_) {
            std::array<char, 32> line{};
            std::snprintf(line.data(), line.size(), "%010zu 00000 n \n", place);
            bytes_ += line.data();
        }
        bytes_ += "trailer\n<</Size " + std::to_string(places_.size() + 1) + "/Root " +
                  reference(root) + "/Info " + reference(info) + ">>\nstartxref\n" +
                  std::to_string(table) + "\n%%EOF\n";
        return std::move(bytes_);
    }
    static std::string reference(std::size_t object) { return std::to_string(object) + " 0 R"; }

private:
    std::string bytes_;
    std::vector<std::size_t> places_;
};

/// The characters of the page, each with a code in one of the fonts.
class Fonts {
public:
    std::size_t place_of(char32_t character) {
        const auto [found, is_new] = places_.try_emplace(character, characters_.size());
        if (is_new) characters_ += character;
        return found->second;
    }
    /// Adds the fonts, as a resource dictionary.
    std::string add_to(File& file) const {
        std::string fonts = "<<";
        for (std::size_t first = 0; first < characters_.size(); first += kCodes)
            fonts += "/F" + std::to_string(first / kCodes) + " " +
                     File::reference(add_font(file, characters_.substr(first, kCodes)));
        return fonts + ">>";
    }

private:
    static std::string procedure(const Glyph& glyph) {
        std::string out = number(glyph.advance) + "0 -1200 -800 4000 2600 d1\n";
        for (const GlyphContour& contour : glyph.contours) {
            Point last = contour.first;
            out += number(last.x) + number(last.y) + "m\n";
            for (const auto& [control, end, straight] : contour.curves) {
                if (!straight) {  // the equivalent cubic curve
                    for (const Point from : {last, end})
                        out += number(from.x + 2.0 / 3 * (control.x - from.x)) +
                               number(from.y + 2.0 / 3 * (control.y - from.y));
                }
                out += number(end.x) + number(end.y) + (straight ? "l\n" : "c\n");
                last = end;
            }
            out += "h\n";
        }
        return out + "f\n";
    }

    static std::size_t add_font(File& file, const std::u32string& characters) {
        std::string procedures, differences, widths, map;
        for (std::size_t code = 0; code < characters.size(); ++code) {
            const Glyph& glyph = glyph_of(characters[code]);
            const std::string name = "/g" + std::to_string(code);
            procedures += name + " " + File::reference(file.add_stream("", procedure(glyph)));
            differences += name;
            widths += number(glyph.advance);
            std::array<char, 8> hexadecimal{};
            std::snprintf(hexadecimal.data(), hexadecimal.size(), "<%02X>",
                          static_cast<unsigned>(code + 1));
            map += "1 beginbfchar\n" + (hexadecimal.data() + (" <" + utf16(characters[code]))) +
                   ">\nendbfchar\n";
        }
        const std::size_t to_unicode = file.add_stream(
            "",
            "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
            "/CMapName /irido def\n/CMapType 2 def\n"
            "1 begincodespacerange\n<00> <FF>\nendcodespacerange\n" +
                map + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n");
        return file.add(
            "<</Type/Font/Subtype/Type3/FontBBox[-1200 -800 4000 2600]"
            "/FontMatrix[0.00048828125 0 0 0.00048828125 0 0]/Resources<<>>/CharProcs<<" +
            procedures + ">>/Encoding<</Type/Encoding/Differences[1" + differences +
            "]>>/FirstChar 1/LastChar " + std::to_string(characters.size()) + "/Widths[" + widths +
            "]/ToUnicode " + File::reference(to_unicode) + ">>");
    }

    std::map<char32_t, std::size_t> places_;
    std::u32string characters_;
};

/// Writes the page's content; y goes down, as in the drawing.
class Page {
public:
    explicit Page(File& file) : file_(file) {}

    void put(const DrawnGroup& group) {
        content += "q\n";
        if (group.clip) {
            add_lines(box_path(*group.clip).lines, true);
            content += "W n\n";
        }
        for (const auto& item : group.items)
            std::visit([this](const auto& one) { put(one); }, item);
        content += "Q\n";
    }
    std::string resources() const {
        return "<</Font" + fonts_.add_to(file_) + "/XObject<<" + images_ + ">>/ExtGState<<" +
               states_ + ">>>>";
    }

    std::string content;

private:
    void add_lines(const std::vector<std::vector<Point>>& lines, bool closed) {
        for (const std::vector<Point>& line : lines) {
            const char* command = "m\n";
            for (const Point& point : line) {
                content += number(point.x) + number(point.y) + command;
                command = "l\n";
            }
            if (closed) content += "h\n";
        }
    }

    void put(const Path& path) {
        content += "q\n";
        if (path.fill) content += color(*path.fill, "rg");
        if (path.fill && path.opacity != 1) content += "/" + opacity_state(path.opacity) + " gs\n";
        if (path.stroke) {
            content += color(*path.stroke, "RG") + number(path.width) + "w 1 j\n";
            if (!path.dash.empty()) {
                content += "[";
                for (const double length : path.dash) content += number(length);
                content += "] 0 d\n";
            }
        }
        add_lines(path.lines, path.closed);
        content += path.fill && path.stroke ? "B\nQ\n" : path.fill ? "f\nQ\n" : "S\nQ\n";
    }

    void put(const Text& text) {
        if (text.halo)
            put(Path{.lines = text_outline(text),
                     .closed = true,
                     .stroke = ink(0xffffff),
                     .width = kHaloWidth});
        double start = 0;
        if (text.anchor != Anchor::start)
            start = text_width(text.text, text.size) * (text.anchor == Anchor::end ? 1 : 0.5);
        const Point at = text.upright ? Point{text.at.x, text.at.y + start}
                                      : Point{text.at.x - start, text.at.y};
        content += "BT\n" + color(text.ink, "rg") + (text.upright ? "0 -1 -1 0 " : "1 0 0 -1 ") +
                   number(at.x) + number(at.y) + "Tm\n";
        std::size_t font = ~std::size_t{0};
        for (const char32_t character : characters_of(text.text)) {
            const std::size_t place = fonts_.place_of(character);
            if (place / kCodes != font) {
                content += (font == ~std::size_t{0} ? "/F" : ">Tj\n/F") +
                           std::to_string(place / kCodes) + " " + number(text.size) + "Tf\n<";
                font = place / kCodes;
            }
            std::array<char, 8> code{};
            std::snprintf(code.data(), code.size(), "%02X",
                          static_cast<unsigned>(place % kCodes + 1));
            content += code.data();
        }
        content += font == ~std::size_t{0} ? "ET\n" : ">Tj\nET\n";
    }

    void put(const Cells& cells) {
        std::string bytes;
        for (const Ink& ink : cells.inks)
            for (const std::uint16_t value : {ink.r, ink.g, ink.b})
                bytes += static_cast<char>((value + 128U) / 257U);
        const std::size_t image = file_.add_stream(
            "/Type/XObject/Subtype/Image/Width " + std::to_string(cells.columns) + "/Height " +
                std::to_string(cells.rows) + "/ColorSpace/DeviceRGB/BitsPerComponent 8",
            bytes);
        const std::string name = "I" + std::to_string(image);
        images_ += "/" + name + " " + File::reference(image);
        const Box& box = cells.box;
        content += "q\n" + number(box.width()) + "0 0 " + number(-box.height()) + number(box.left) +
                   number(box.bottom) + "cm\n/" + name + " Do\nQ\n";
    }

    std::string opacity_state(double opacity) {
        std::string name = "O" + std::to_string(std::lround(opacity * 1000));
        if (states_.find("/" + name + "<<") == std::string::npos)
            states_ += "/" + name + "<</ca " + number(opacity) + ">>";
        return name;
    }

    File& file_;
    Fonts fonts_;
    std::string images_, states_;
};

/// A string in the document's properties.
std::string text_string(const std::string& text) {
    std::string out = "<FEFF";
    for (const char32_t character : characters_of(schemas::well_formed(text)))
        out += utf16(character);
    return out + ">";
}

std::string write(const Drawing& drawing) {
    File file;
    Page page(file);
    page.content = number(kPoints) + "0 0 " + number(-kPoints) + "0 " +
                   number(drawing.height * kPoints) + "cm\n";
    for (const DrawnGroup& group : drawing.groups) page.put(group);
    const std::size_t content = file.add_stream("", page.content);
    const std::string resources = page.resources();
    const std::size_t pages = file.reserve();
    const std::size_t leaf =
        file.add("<</Type/Page/Parent " + File::reference(pages) + "/MediaBox[0 0 " +
                 number(drawing.width * kPoints) + number(drawing.height * kPoints) +
                 "]/Contents " + File::reference(content) + "/Resources" + resources + ">>");
    file.put(pages, "<</Type/Pages/Count 1/Kids[" + File::reference(leaf) + "]>>");
    const std::size_t root = file.add("<</Type/Catalog/Pages " + File::reference(pages) + ">>");
    std::string properties = "<</Title" + text_string(drawing.title) + "/Producer(irido)";
    if (!drawing.metadata.empty()) properties += "/Keywords" + text_string(drawing.metadata);
    return file.finish(root, file.add(properties + ">>"));
}

}  // namespace

extern const PictureFormat picture_format_pdf{
    .name = "pdf",
    .summary = "vector picture for print",
    .is_binary = true,
    .write = write,
};

}  // namespace irido::tables
