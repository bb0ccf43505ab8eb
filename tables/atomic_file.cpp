#include "tables/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace irido {

namespace {

/// The temporary file's name while it exists; plain bytes, so that a signal handler may read it.
std::array<char, 4096> unfinished_name{};
volatile std::sig_atomic_t is_unfinished = 0;

[[noreturn]] void fail(const std::string& path, int error) {
    throw OutputError(path + ": cannot be written: " + std::strerror(error));
}

/// 0, or the system's error number.
int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

void write_directly(const std::string& path, std::string_view bytes) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path, errno);
    int error = write_all(descriptor, bytes);
    if (close(descriptor) != 0 && error == 0) error = errno;
    if (error == EPIPE) throw BrokenPipe{};
    if (error != 0) fail(path, error);
}

/// Writes and closes a new file; 0, or the system's error number.
int write_new(int descriptor, mode_t mode, std::string_view bytes) {
    int error = fchmod(descriptor, mode) == 0 ? write_all(descriptor, bytes) : errno;
    if (error == 0 && fsync(descriptor) != 0) error = errno;
    if (close(descriptor) != 0 && error == 0) error = errno;
    return error;
}

mode_t default_mode() {
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

}  // namespace

void write_file(const std::string& path, std::string_view bytes) {
    std::error_code ignored;
    std::string target = path;
    if (std::filesystem::is_symlink(path, ignored)) {
        const auto real = std::filesystem::canonical(path, ignored);
        if (!ignored) target = real.string();
    }
    struct stat existing {};
    const bool exists = stat(target.c_str(), &existing) == 0;
    if (exists && S_ISDIR(existing.st_mode)) fail(path, EISDIR);
    if (exists && !S_ISREG(existing.st_mode)) return write_directly(path, bytes);
    if (exists && access(target.c_str(), W_OK) != 0) fail(path, errno);

    const std::string temporary = target + ".part" + std::to_string(getpid());
    if (temporary.size() >= unfinished_name.size()) fail(path, ENAMETOOLONG);
    std::memcpy(unfinished_name.data(), temporary.c_str(), temporary.size() + 1);
    const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) fail(path, errno);
    is_unfinished = 1;
    int error = write_new(descriptor, exists ? existing.st_mode & 07777 : default_mode(), bytes);
    if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) unlink(temporary.c_str());
    is_unfinished = 0;
    if (error != 0) fail(path, error);
}

void write_stdout(std::string_view bytes) {
    const int error = write_all(STDOUT_FILENO, bytes);
    if (error == EPIPE) throw BrokenPipe{};
    if (error != 0) fail("standard output", error);
}

void remove_unfinished_file() noexcept {
    if (is_unfinished) unlink(unfinished_name.data());
}

}  // namespace irido
