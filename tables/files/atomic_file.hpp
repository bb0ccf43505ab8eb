#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace irido::tables {

/// Output could not be written; the text names the file and the system's reason.
struct OutputError : Error {
    using Error::Error;
};

/// Thrown when the reader of standard output has gone away.
struct BrokenPipe {};

/// A path to be written to.
struct OutputTarget {
    std::string path;     ///< with symbolic links resolved
    bool is_file = true;  ///< a named regular file, existing or not; else a device, a pipe or an
                          ///< unnamed file, as /dev/stdout may be
    mode_t mode = 0;      ///< permissions: those of the existing file, else the default
};

/// Resolves a path to be written. Throws OutputError for a folder, an input file (see
/// schemas/readers/text_file.hpp), a dangling symbolic link, or a file without write permission.
OutputTarget output_target(const std::string& path);

/// The path with symbolic links resolved.
std::string resolved_path(const std::string& path);

/// Throws OutputError if a path leads to an input file, under any name.
void require_no_input(const std::string& path);

/// Checks several paths before any is written. Throws OutputError if one cannot be written or if
/// two of them are the same file.
void check_outputs(const std::vector<std::string>& paths);

/// Throws "PATH: cannot be written: REASON", or BrokenPipe.
[[noreturn]] void fail_to_write(const std::string& path, int error);

/// Writes all bytes to a descriptor; returns 0 or the system's error number.
int write_all(int descriptor, std::string_view bytes);

/// A file under a temporary name in the folder of `path`, at most one per process at a time;
/// commit() renames it to `path`, otherwise it is removed. Those that killed processes left there
/// for the same path are removed first.
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

/// Writes a file atomically: under a temporary name in the same folder, then renamed; an existing
/// file's permissions are kept. Devices and pipes are written to directly. Throws OutputError.
void write_file(const std::string& path, std::string_view bytes);

/// Writes to standard output. Throws OutputError, or BrokenPipe.
void write_stdout(std::string_view bytes);

/// Throws OutputError if standard output is a terminal.
void check_binary_stdout();

/// Removes the temporary file of an unfinished NewFile or write_file(). For signal handlers.
void remove_unfinished_file() noexcept;

}  // namespace irido::tables
