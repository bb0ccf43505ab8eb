#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tables/lut/lut.hpp"

namespace irido::tables {

/// A table that a format cannot hold, or a file that is not what it should be: one line of text.
struct LutError : Error {
    using Error::Error;
};

/// How a table is laid out in files, beyond what follows from the table.
struct LutLayout {
    bool zstd = false;    ///< ktx2: Zstandard supercompression
    bool layers = false;  ///< ktx2: a third axis as array layers, not as depth
};

/// A file of a table: what is added to the name that was asked for, and the bytes.
struct LutFile {
    std::string suffix;  ///< "" or ".json"
    std::string bytes;
};

/// A way to write tables as files and to read them back. Every file, with its companion, has the
/// whole metadata.
struct LutFormat {
    std::string_view name;     ///< as --format and as a file's extension
    std::string_view summary;  ///< for --help, one line
    bool is_binary = true;
    /// Throws LutError naming what the format cannot hold.
    std::vector<LutFile> (*write)(const Lut&, const LutLayout&) = nullptr;
    /// The table in the bytes of a file and of its companion ("" if the format has none or it is
    /// not there), values as stored. Throws LutError for what is truncated, foreign or
    /// inconsistent; the checksum is left to the caller (checksum_of).
    Lut (*read)(std::string_view bytes, std::string_view companion) = nullptr;
};

/// All formats, by name. The list is made from the files in tables/lut/formats/.
std::span<const LutFormat* const> lut_formats();

/// nullptr if there is none of that name.
const LutFormat* find_lut_format(std::string_view name);

/// The metadata of a table: the facts and what follows from axes, channels, type and values, with
/// the checksum. Source of every key: schemas/lut.schema.json.
nlohmann::json metadata_of(const Lut& lut);

/// metadata_of() as text: one line, keys sorted.
std::string metadata_text(const Lut& lut);

/// A table without values from its metadata, checked against lut.schema.json. Throws LutError.
Lut lut_from_metadata(std::string_view text);

/// "sha256:" and 64 hexadecimal digits of the values as little-endian numbers of the table's type,
/// in the table's own order, whatever the file's layout.
std::string checksum_of(const Lut& lut);

}  // namespace irido::tables
