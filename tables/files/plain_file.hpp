#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace irido::tables {

/// An open file that reports failures as OutputError and closes itself.
class PlainFile {
public:
    enum class Use { read, write, create };  ///< `create`: write, creating the file if needed

    /// Errors name `shown` instead of the path, if given.
    PlainFile(const std::string& path, Use use, const std::string& shown = "");
    ~PlainFile();
    PlainFile(const PlainFile&) = delete;
    PlainFile& operator=(const PlainFile&) = delete;

    int descriptor() const { return descriptor_; }
    std::uint64_t size() const;
    /// Fills the buffer. Premature end of file is an error.
    void read_at(std::uint64_t offset, std::string& buffer) const;
    void write_at(std::uint64_t offset, std::string_view bytes) const;
    void cut(std::uint64_t size) const;
    /// Flushes the file to the disk.
    void sync() const;

private:
    std::string shown_;
    int descriptor_;
};

}  // namespace irido::tables
