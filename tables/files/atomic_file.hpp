#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace irido::tables {

/// Output that could not be written; the text names the file and the system's reason.
struct OutputError : Error {
    using Error::Error;
};

/// Nobody reads standard output any more.
struct BrokenPipe {};

/// What stands at a path that is to be written.
struct OutputTarget {
    std::string path;     ///< of the file itself, where the path is a symbolic link to one
    bool is_file = true;  ///< a regular file with a name, perhaps one to come; else a device, a
                          ///< pipe, or a file without a name such as /dev/stdout may be
    mode_t mode = 0;      ///< permissions of the file, kept or by default
};

/// Throws OutputError if it is a folder, an input (see schemas/readers/text_file.hpp) or a symbolic
/// link to nothing, or must not be written.
OutputTarget output_target(const std::string& path);

/// The path itself, or where a symbolic link leads.
std::string resolved_path(const std::string& path);

/// Throws OutputError if a path is an input, whatever it is called.
void require_no_input(const std::string& path);

/// To be called before the first of several files is written: throws OutputError if any of them
/// must not be, or if two of them are the same file.
void check_outputs(const std::vector<std::string>& paths);

/// Throws "PATH: cannot be written: REASON", or BrokenPipe.
[[noreturn]] void fail_to_write(const std::string& path, int error);

/// 0, or the system's error number.
int write_all(int descriptor, std::string_view bytes);

/// A file under a temporary name in the folder of `path`, one at a time in a process; commit()
/// gives it its name, else it is removed.
class NewFile {
public:
    /// Throws OutputError.
    NewFile(const std::string& path, const OutputTarget& target);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    int descriptor() const { return descriptor_; }
    const std::string& name() const { return name_; }
    /// Throws OutputError.
    void commit();

private:
    std::string path_;
    OutputTarget target_;
    std::string name_;
    int descriptor_;
};

/// Writes a file whole or not at all: a temporary name in the same folder, then a rename; an
/// existing file keeps its permissions. Devices and pipes are written to directly. Throws
/// OutputError.
void write_file(const std::string& path, std::string_view bytes);

/// Writes to standard output. Throws OutputError, or BrokenPipe.
void write_stdout(std::string_view bytes);

/// Throws OutputError if standard output is a terminal.
void check_binary_stdout();

/// Removes the temporary file of a NewFile or write_file() that is under way. For signal handlers.
void remove_unfinished_file() noexcept;

}  // namespace irido::tables
