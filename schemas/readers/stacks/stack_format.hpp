#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// What files of other programs leave to their reader.
struct StackReadOptions {
    std::string coating;     ///< which one of a file with several; "" for the only one
    double primary_nm = 0;   ///< wavelength of thicknesses in waves, 0 if none is given
    bool is_mirror = false;  ///< the last layer is the substrate
    std::string folder;      ///< of material files, relative to the file's own; "" for that one
    std::set<std::string> media = {};  ///< names of media that are given otherwise
};

/// A stack of another program.
struct StackFile {
    nlohmann::json document;         ///< as stack.schema.json says; material files as in the text
    std::vector<std::string> notes;  ///< what was assumed, and what was left out
};

struct StackWriteOptions {
    std::string name;                  ///< of the coating, "" if it has none
    WavelengthRange range{300, 2500};  ///< of tables of dispersive materials, nm
};

/// A stack for another program.
struct WrittenStack {
    struct Beside {
        std::string name;  ///< of a file in the same folder
        std::string text;
    };
    std::string text;
    std::vector<Beside> beside = {};
    std::vector<std::string> losses = {};  ///< what the format cannot hold, one entry each
};

/// A format of stacks of another program.
struct StackFormat {
    std::string_view name;     ///< as --format
    std::string_view ending;   ///< of files, in lower case, with its dot
    std::string_view program;  ///< in messages
    /// Throws InputError with file `file`.
    StackFile (*read)(std::string_view text, const std::string& file,
                      const StackReadOptions& options);
    /// Throws InputError for what no note could make up for.
    WrittenStack (*write)(const Stack& stack, const StackWriteOptions& options);
};

std::span<const StackFormat> stack_formats();

/// The format of a file by its ending, in capitals or not; nullptr if it is none of these.
const StackFormat* stack_format_of(const std::string& path);

}  // namespace irido::schemas
