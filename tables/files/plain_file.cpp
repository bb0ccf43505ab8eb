#include "tables/files/plain_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tables/files/atomic_file.hpp"

namespace irido::tables {

namespace {

int flags_of(PlainFile::Use use) {
    // a pipe in place of a file then reads as empty instead of blocking
    if (use == PlainFile::Use::read) return O_RDONLY | O_CLOEXEC | O_NONBLOCK;
    // do not follow a link planted by somebody else
    return O_RDWR | O_CLOEXEC | O_NOFOLLOW | (use == PlainFile::Use::create ? O_CREAT : 0);
}

[[noreturn]] void fail_to_read(const std::string& path, const char* reason) {
    throw OutputError(path + ": cannot be read: " + reason);
}

}  // namespace

PlainFile::PlainFile(const std::string& path, Use use, const std::string& shown)
    : shown_(shown.empty() ? path : shown), descriptor_(open(path.c_str(), flags_of(use), 0600)) {
    if (descriptor_ >= 0) return;
    if (use == Use::read) fail_to_read(shown_, std::strerror(errno));
    fail_to_write(shown_, errno);
}

PlainFile::~PlainFile() {
    close(descriptor_);
}

std::uint64_t PlainFile::size() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) fail_to_read(shown_, std::strerror(errno));
    return static_cast<std::uint64_t>(status.st_size);
}

void PlainFile::read_at(std::uint64_t offset, std::string& buffer) const {
    for (std::size_t done = 0; done < buffer.size();) {
        const ssize_t count = pread(descriptor_, &buffer[done], buffer.size() - done,
                                    static_cast<off_t>(offset + done));
        if (count == 0) fail_to_read(shown_, "unexpected end of file");
        if (count < 0 && errno != EINTR) fail_to_read(shown_, std::strerror(errno));
        if (count > 0) done += static_cast<std::size_t>(count);
    }
}

void PlainFile::write_at(std::uint64_t offset, std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t count =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno != EINTR) fail_to_write(shown_, errno);
        if (count <= 0) continue;
        bytes.remove_prefix(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
}

void PlainFile::cut(std::uint64_t size) const {
    if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail_to_write(shown_, errno);
}

void PlainFile::sync() const {
    if (fsync(descriptor_) != 0) fail_to_write(shown_, errno);
}

}  // namespace irido::tables
