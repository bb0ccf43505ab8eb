#include "tables/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>
#include <utility>

#include "schemas/readers/text_file.hpp"

namespace irido::tables {

namespace {

/// The temporary file's name while it exists, as plain bytes that a signal handler may read.
std::array<char, 4096> unfinished_name{};
volatile std::sig_atomic_t is_unfinished = 0;

void write_directly(const std::string& path, std::string_view bytes) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail_to_write(path, errno);
    int error = write_all(descriptor, bytes);
    if (close(descriptor) != 0 && error == 0) error = errno;
    if (error != 0) fail_to_write(path, error);
}

mode_t default_mode() {
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

/// The process that wrote a temporary file, from what follows ".part" in its name.
std::optional<pid_t> writer_of(std::string_view ending) {
    const std::size_t dash = std::min(ending.find('-'), ending.size());
    const bool is_numbered = ending.find_first_not_of("0123456789", dash + 1) == ending.npos;
    pid_t writer = 0;
    const char* const end = ending.data() + dash;
    const auto [stop, error] = std::from_chars(ending.data(), end, writer);
    if (error != std::errc() || stop != end || writer <= 0 || !is_numbered) return std::nullopt;
    return writer;
}

bool is_locked_or_young(int descriptor) {
    constexpr time_t kYoung_s = 10;  // a new file is not locked at once
    struct stat status {};
    if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != geteuid() ||
        time(nullptr) - status.st_mtime < kYoung_s)
        return true;
    struct flock lock {};
    lock.l_type = F_WRLCK;
    return fcntl(descriptor, F_SETLK, &lock) != 0;
}

/// Removes temporary files of a target that killed processes left behind. The lock tells whether
/// one is being written on another machine or in another container, where numbers of processes
/// mean others.
void remove_stale_parts(const std::filesystem::path& target) {
    const std::string beginning = target.filename().string() + ".part";
    std::error_code error;
    for (std::filesystem::directory_iterator file(folder_of(target), error), end;
         !error && file != end; file.increment(error)) {
        const std::string name = file->path().filename().string();
        if (!name.starts_with(beginning)) continue;
        const auto writer = writer_of(std::string_view(name).substr(beginning.size()));
        if (!writer || kill(*writer, 0) == 0 || errno != ESRCH) continue;
        const int descriptor =
            open(file->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (descriptor < 0) continue;
        if (!is_locked_or_young(descriptor)) unlink(file->path().c_str());
        close(descriptor);
    }
}

/// Whether both paths lead to the same regular file, which need not exist yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    if (std::filesystem::exists(a, ignored) || std::filesystem::exists(b, ignored))
        return std::filesystem::equivalent(a, b, ignored) &&
               std::filesystem::is_regular_file(a, ignored);
    return a.filename() == b.filename() &&
           std::filesystem::equivalent(folder_of(a), folder_of(b), ignored);
}

}  // namespace

void fail_to_write(const std::string& path, int error) {
    if (error == EPIPE) throw BrokenPipe{};
    throw OutputError(path + ": cannot be written: " + std::strerror(error));
}

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

std::string resolved_path(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_symlink(path, ignored)) return path;
    const auto real = std::filesystem::canonical(path, ignored);
    return ignored ? path : real.string();
}

void require_no_input(const std::string& path) {
    if (schemas::is_input(path))
        throw OutputError(path + ": is one of the inputs: name another file");
}

void check_outputs(const std::vector<std::string>& paths) {
    for (auto path = paths.begin(); path != paths.end(); ++path) {
        output_target(*path);
        for (auto other = paths.begin(); other != path; ++other)
            if (is_same_file(*path, *other))
                throw OutputError(*path + ": is the same file as " + *other +
                                  ", which is also written: name another file");
    }
}

OutputTarget output_target(const std::string& path) {
    require_no_input(path);
    OutputTarget target{resolved_path(path)};
    std::error_code ignored;
    const bool is_link = std::filesystem::is_symlink(path, ignored);
    struct stat existing {};
    if (stat(target.path.c_str(), &existing) != 0) {
        if (is_link) throw OutputError(path + ": cannot be written: dangling symbolic link");
        target.mode = default_mode();
        return target;
    }
    if (S_ISDIR(existing.st_mode)) fail_to_write(path, EISDIR);
    target.is_file = S_ISREG(existing.st_mode) && !(is_link && target.path == path);
    target.mode = existing.st_mode & 07777;
    if (target.is_file && access(target.path.c_str(), W_OK) != 0) fail_to_write(path, errno);
    return target;
}

NewFile::NewFile(const std::string& path, const OutputTarget& target)
    : path_(path), target_(target), descriptor_(-1) {
    remove_stale_parts(target.path);
    // a killed process may have left the name of this one's number behind
    constexpr int kMostNames = 100;
    const std::string name = target.path + ".part" + std::to_string(getpid());
    for (int i = 0; descriptor_ < 0 && i < kMostNames; ++i) {
        name_ = i == 0 ? name : name + "-" + std::to_string(i);
        if (name_.size() >= unfinished_name.size()) fail_to_write(path, ENAMETOOLONG);
        descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0) fail_to_write(path, errno);
    struct flock lock {};
    lock.l_type = F_WRLCK;
    fcntl(descriptor_, F_SETLK, &lock);  // see remove_stale_parts()
    std::memcpy(unfinished_name.data(), name_.c_str(), name_.size() + 1);
    is_unfinished = 1;
}

NewFile::~NewFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (is_unfinished) unlink(name_.c_str());
    is_unfinished = 0;
}

void NewFile::commit() {
    if (fchmod(descriptor_, target_.mode) != 0 || fsync(descriptor_) != 0)
        fail_to_write(path_, errno);
    if (close(std::exchange(descriptor_, -1)) != 0) fail_to_write(path_, errno);
    if (std::rename(name_.c_str(), target_.path.c_str()) != 0) fail_to_write(path_, errno);
    is_unfinished = 0;
}

void write_file(const std::string& path, std::string_view bytes) {
    const OutputTarget target = output_target(path);
    if (!target.is_file) return write_directly(path, bytes);
    NewFile file(path, target);
    if (const int error = write_all(file.descriptor(), bytes)) fail_to_write(path, error);
    file.commit();
}

void write_stdout(std::string_view bytes) {
    require_no_input("/dev/stdout");
    if (const int error = write_all(STDOUT_FILENO, bytes)) fail_to_write("standard output", error);
}

void check_binary_stdout() {
    if (isatty(STDOUT_FILENO))
        throw OutputError("--format: binary data must not go to a terminal; use --output FILE");
}

void remove_unfinished_file() noexcept {
    if (is_unfinished) unlink(unfinished_name.data());
}

}  // namespace irido::tables
