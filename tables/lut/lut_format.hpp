#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tables/lut/lut.hpp"

namespace irido::tables {

/// Thrown for tables that a format cannot represent, and for damaged or foreign files.
struct LutError : Error {
    using Error::Error;
};

/// Options of the file layout.
struct LutLayout {
    bool zstd = false;    ///< ktx2: Zstandard supercompression
    bool layers = false;  ///< ktx2: a third axis as array layers instead of depth
};

/// One of the files of a table.
struct LutFile {
    std::string suffix;  ///< added to the requested name: "" or ".json"
    std::string bytes;
};

/// A file format of tables. Every file, or its companion, holds the complete metadata.
struct LutFormat {
    std::string_view name;     ///< value of --format, and the file extension
    std::string_view summary;  ///< for --help, one line
    bool is_binary = true;
    /// Throws LutError, which names what the format cannot represent.
    std::vector<LutFile> (*write)(const Lut&, const LutLayout&) = nullptr;
    /// Reads a table, values as stored, from the bytes of a file and of its companion ("" if the
    /// format has none or it is missing). Throws LutError for truncated, foreign or inconsistent
    /// files; does not verify the checksum (see checksum_of).
    Lut (*read)(std::string_view bytes, std::string_view companion) = nullptr;
};

/// All formats, by name. The list is made from the files in tables/lut/formats/.
std::span<const LutFormat* const> lut_formats();

/// nullptr if there is no format of that name.
const LutFormat* find_lut_format(std::string_view name);

/// The complete metadata of a table: its facts, axes, channels, type and checksums. Defined by
/// schemas/lut.schema.json.
nlohmann::json metadata_of(const Lut& lut);

/// metadata_of() as text: one line, keys sorted.
std::string metadata_text(const Lut& lut);

/// A table without values, from its metadata after a check against lut.schema.json. Throws
/// LutError.
Lut lut_from_metadata(std::string_view text);

/// "sha256:" and 64 hexadecimal digits of the values as little-endian numbers of the table's type,
/// in the table's own order, independent of the file's layout.
std::string checksum_of(const Lut& lut);

}  // namespace irido::tables
