#!/usr/bin/env python3
"""Writes glyphs.inc: outlines and advance widths of the characters that pictures draw.

    python3 glyphs.py /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf > glyphs.inc

Reads the tables cmap, hmtx, loca and glyf of a TrueType font (ISO/IEC 14496-22). Coordinates are in
units of 1/2048 of the font size, y upwards; M, L and Q (quadratic) as in SVG, every contour closed.
"""
import struct
import sys

CHARACTERS = [
    *range(0x20, 0x7F), *range(0xA0, 0x180),  # Latin
    *range(0x391, 0x3AA), *range(0x3B1, 0x3CA), 0x3D5, 0x3F5,  # Greek
    *range(0x401, 0x460),  # Cyrillic
    *range(0x2010, 0x2016), *range(0x2018, 0x2020), 0x2020, 0x2022, 0x2026, 0x2030, 0x2032, 0x2033,
    0x2070, *range(0x2074, 0x208F),  # superscripts and subscripts
    0x20AC, 0x2113, 0x212B, *range(0x2190, 0x2196), 0x2202, 0x2206, 0x2211, 0x2212, 0x221A, 0x221E,
    0x222B, 0x2248, 0x2260, 0x2264, 0x2265, 0x22C5, 0xFFFD,
]


class Font:
    def __init__(self, data):
        self.data = data
        count = struct.unpack_from(">H", data, 4)[0]
        self.tables = {}
        for i in range(count):
            tag, _, offset, _ = struct.unpack_from(">4sIII", data, 12 + 16 * i)
            self.tables[tag.decode()] = offset
        head = self.tables["head"]
        self.units, = struct.unpack_from(">H", data, head + 18)
        self.long_offsets, = struct.unpack_from(">h", data, head + 50)
        self.metrics, = struct.unpack_from(">H", data, self.tables["hhea"] + 34)
        self.names = self.read_characters()

    def read_characters(self):
        cmap = self.tables["cmap"]
        for i in range(struct.unpack_from(">H", self.data, cmap + 2)[0]):
            offset = cmap + struct.unpack_from(">HHI", self.data, cmap + 4 + 8 * i)[2]
            if struct.unpack_from(">H", self.data, offset)[0] == 12:
                groups, = struct.unpack_from(">I", self.data, offset + 12)
                names = {}
                for g in range(groups):
                    first, last, glyph = struct.unpack_from(">III", self.data, offset + 16 + 12 * g)
                    names.update((c, glyph + c - first) for c in range(first, last + 1))
                return names
        raise SystemExit("no cmap of format 12")

    def advance(self, glyph):
        glyph = min(glyph, self.metrics - 1)
        return struct.unpack_from(">H", self.data, self.tables["hmtx"] + 4 * glyph)[0]

    def contours(self, glyph):
        """Lists of (x, y, on the curve)."""
        loca, kind, size = self.tables["loca"], *((">I", 4) if self.long_offsets else (">H", 2))
        begin, end = (struct.unpack_from(kind, self.data, loca + size * (glyph + i))[0]
                      * (1 if self.long_offsets else 2) for i in (0, 1))
        if begin == end:
            return []
        at = self.tables["glyf"] + begin
        count, = struct.unpack_from(">h", self.data, at)
        return self.simple(at + 10, count) if count >= 0 else self.composite(at + 10)

    def simple(self, at, count):
        ends = struct.unpack_from(">%dH" % count, self.data, at)
        at += 2 * count
        at += 2 + struct.unpack_from(">H", self.data, at)[0]
        points, flags = ends[-1] + 1, []
        while len(flags) < points:
            flag = self.data[at]
            at += 1
            flags.append(flag)
            if flag & 8:
                flags += [flag] * self.data[at]
                at += 1
        columns = []
        for short, same in ((2, 16), (4, 32)):
            value, column = 0, []
            for flag in flags:
                if flag & short:
                    value += self.data[at] if flag & same else -self.data[at]
                    at += 1
                elif not flag & same:
                    value += struct.unpack_from(">h", self.data, at)[0]
                    at += 2
                column.append(value)
            columns.append(column)
        whole = [(x, y, bool(f & 1)) for x, y, f in zip(*columns, flags)]
        starts = (0, *(e + 1 for e in ends[:-1]))
        return [whole[s:e + 1] for s, e in zip(starts, ends)]

    def composite(self, at):
        contours, more = [], True
        while more:
            flags, glyph = struct.unpack_from(">HH", self.data, at)
            at += 4
            dx, dy = struct.unpack_from(">hh" if flags & 1 else ">bb", self.data, at)
            at += 4 if flags & 1 else 2
            a, b, c, d = 1.0, 0.0, 0.0, 1.0
            if flags & 8:
                a = d = struct.unpack_from(">h", self.data, at)[0] / 16384
                at += 2
            elif flags & 64:
                a, d = (v / 16384 for v in struct.unpack_from(">hh", self.data, at))
                at += 4
            elif flags & 128:
                a, b, c, d = (v / 16384 for v in struct.unpack_from(">hhhh", self.data, at))
                at += 8
            assert flags & 2, "parts are placed by offsets"
            for contour in self.contours(glyph):
                contours.append([(round(a * x + c * y) + dx, round(b * x + d * y) + dy, on)
                                 for x, y, on in contour])
            more = flags & 32
        return contours


def path(contour):
    whole = []  # a point on the curve between any two controls
    for i, (x, y, on) in enumerate(contour):
        px, py, before = contour[i - 1]
        if not on and not before:
            whole.append(((px + x) // 2, (py + y) // 2, True))
        whole.append((x, y, on))
    first = next(i for i, p in enumerate(whole) if p[2])
    whole = whole[first:] + whole[:first + 1]
    text, i = "M%d %d" % whole[0][:2], 1
    while i < len(whole):
        if whole[i][2]:
            text += "L%d %d" % whole[i][:2]
            i += 1
        else:
            text += "Q%d %d %d %d" % (*whole[i][:2], *whole[i + 1][:2])
            i += 2
    return text


def main():
    font = Font(open(sys.argv[1], "rb").read())
    assert font.units == 2048
    print("// Code point (hexadecimal), advance, outline. Written by glyphs.py from DejaVu Sans")
    print("// 2.37, whose licence is in LICENSE-DejaVu.txt.")
    for character in sorted(set(CHARACTERS)):
        glyph = font.names.get(character)
        if glyph is not None:
            outline = "".join(path(contour) for contour in font.contours(glyph))
            print('"%X %d %s\\n"' % (character, font.advance(glyph), outline))


main()
