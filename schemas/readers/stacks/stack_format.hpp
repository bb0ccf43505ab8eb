#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// Choices that files of other programs leave open.
struct StackReadOptions {
    std::string coating;     ///< which coating of a file with several; "" for the only one
    double primary_nm = 0;   ///< wavelength of thicknesses in waves, 0 if none is given
    bool is_mirror = false;  ///< the last layer is the substrate
    std::string folder;  ///< folder of material files, relative to the file's own; "" for that one
    std::set<std::string> media = {};  ///< names of media that are defined elsewhere
};

/// A stack of another program.
struct StackFile {
    nlohmann::json document;  ///< follows stack.schema.json; material files named as in the text
    std::vector<std::string> notes;  ///< assumptions and omissions
};

struct StackWriteOptions {
    std::string name;                  ///< of the coating, "" if it has none
    WavelengthRange range{300, 2500};  ///< of tables of dispersive materials, nm
};

/// A stack for another program.
struct WrittenStack {
    struct Beside {
        std::string name;  ///< name in the same folder
        std::string text;
    };
    std::string text;
    std::vector<Beside> beside = {};
    std::vector<std::string> losses = {};  ///< what the format cannot express, one entry each
};

/// A format of stacks of another program.
struct StackFormat {
    std::string_view name;     ///< value of --format
    std::string_view ending;   ///< file extension, in lower case, with its dot
    std::string_view program;  ///< in messages
    /// Throws InputError with file `file`.
    StackFile (*read)(std::string_view text, const std::string& file,
                      const StackReadOptions& options);
    /// Throws InputError where a note would not be enough.
    WrittenStack (*write)(const Stack& stack, const StackWriteOptions& options);
};

std::span<const StackFormat> stack_formats();

/// The format of a file by its extension, in either case; nullptr if it is none of these.
const StackFormat* stack_format_of(const std::string& path);

}  // namespace irido::schemas
