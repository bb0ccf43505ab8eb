#pragma once

#include "cli/options/command.hpp"
#include "cli/options/picture_options.hpp"
#include "tables/lut/lut_format.hpp"
#include "tables/lut/lut_maker.hpp"

namespace irido::cli {

/// How a table is sampled and stored, as typed; "" if not typed.
struct TableOptions {
    std::string type, size, tolerance;
    bool any_size = false;
    tables::LutLayout layout;
};

/// Everything typed about a table and where it goes.
struct TableOutput {
    TableOptions table;
    PictureOptions picture;
    OutputOptions output;
    unsigned threads = 0;
    bool quiet = false;
};

/// --dtype; `usual` is what it is if not typed, as the help has it.
void add_dtype_option(CLI::App& command, std::string& type, const std::string& usual);

/// --dtype, --size, --tolerance, --any-size, --zstd, --layers; the output's stand between the
/// last two and these.
void add_table_size_options(CLI::App& command, TableOptions& options, const std::string& usual);
void add_table_layout_options(CLI::App& command, TableOptions& options);

/// "csv, ktx2, png [csv]": what --format of a table may be, for --help.
std::string table_formats_text();

/// The table's format. Throws UsageError, which names pictures among the others if they are drawn.
const tables::LutFormat& resolved_lut_format(const OutputOptions& output, bool has_pictures = true);

tables::LutType parse_type(std::string_view text);

/// What was typed for a table of that many axes. Throws UsageError.
///   format     nullptr for pictures
///   text_type  number format of CSV if none was typed
tables::LutMaking making_of(const TableOptions& options, const tables::LutFormat* format,
                            std::string_view text_type, std::size_t axes);

/// Writes a table to its files, or as CSV to standard output; notes what readers should know.
void write_table(const tables::Lut& lut, const tables::LutFormat& format,
                 const tables::LutLayout& layout, const OutputOptions& output, bool quiet);

/// Makes a table, with progress and notes, and writes it or draws its picture. Returns the exit
/// status: kCheckFailed, with a message, if no size meets the tolerance. Throws UsageError.
///   kind          of the table
///   plan          the function that the table samples
///   typed         size, format and place of the output
///   title         of the picture
///   is_announced  whether the time that it takes is foreseen and noted
///   gain          multiplies the colours of a picture
int make_table(const tables::LutKind& kind, tables::LutPlan plan, const TableOutput& typed,
               const std::string& title, bool is_announced, double gain = 1);

}  // namespace irido::cli
