#include "schemas/readers/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "schemas/input_error.hpp"

namespace irido::schemas {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20U;
constexpr std::size_t kLongestFlow = 64 * kMebibyte, kLongestFile = 1024 * kMebibyte;

[[noreturn]] void fail(const std::string& path, const std::string& message) {
    throw InputError(shown_path(path), "", message);
}

[[noreturn]] void fail_to_read(const std::string& path, int reason) {
    fail(path, "cannot be read: " + std::generic_category().message(reason));
}

/// A file's device and inode.
using Identity = std::pair<dev_t, ino_t>;

/// Files that were read, with a path to each: if an inode number now belongs to another file
/// because the old one is gone, the path reveals it.
struct Inputs {
    std::mutex lock;
    std::map<Identity, std::string> path_of;
};

Inputs& inputs() {
    static Inputs all;
    return all;
}

void add_input(const Identity& identity, const std::string& path) {
    Inputs& all = inputs();
    const std::scoped_lock guard(all.lock);
    all.path_of[identity] = path;
}

class OpenFile {
public:
    OpenFile(const std::string& path, TextSource source) : path_(path) {
        // without O_NONBLOCK, opening a pipe that has no writer would block
        const int flags =
            O_RDONLY | O_CLOEXEC | (source == TextSource::regular_file ? O_NONBLOCK : 0);
        descriptor_ = path == "-" ? STDIN_FILENO : open(path.c_str(), flags);
        if (descriptor_ < 0 || fstat(descriptor_, &status_) != 0) fail_to_read(path, errno);
        if (S_ISDIR(status_.st_mode)) fail_to_read(path, EISDIR);
        if (source == TextSource::regular_file && !is_regular())
            fail(path, "must be a regular file, not a pipe or a device");
    }
    ~OpenFile() {
        if (descriptor_ > STDIN_FILENO) close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    bool is_regular() const { return S_ISREG(status_.st_mode); }
    std::size_t size() const { return static_cast<std::size_t>(status_.st_size); }
    Identity identity() const { return {status_.st_dev, status_.st_ino}; }

    /// Reads to the end, or a little more than `most` bytes.
    std::string read_up_to(std::size_t most) const {
        std::string text;
        if (is_regular()) text.reserve(std::min(size(), most));
        std::array<char, 65536> block{};
        while (text.size() <= most) {
            const ssize_t count = read(descriptor_, block.data(), block.size());
            if (count < 0 && errno != EINTR) fail_to_read(path_, errno);
            if (count == 0) break;
            if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
        }
        return text;
    }

private:
    const std::string& path_;
    int descriptor_ = -1;
    struct stat status_ {};
};

}  // namespace

std::string shown_path(const std::string& path) {
    return path == "-" ? "<stdin>" : path;
}

std::string read_text(const std::string& path, TextSource source) {
    std::string text = read_bytes(path, source);
    require_no_utf16(text, shown_path(path));
    return text;
}

void require_no_utf16(std::string_view text, const std::string& file) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw InputError(file, "", "must be UTF-8 text (got UTF-16)");
}

std::string read_bytes(const std::string& path, TextSource source) {
    const OpenFile file(path, source);
    const std::size_t most = file.is_regular() ? kLongestFile : kLongestFlow;
    std::string text;
    if (file.size() <= most) text = file.read_up_to(most);
    if (std::max(text.size(), file.size()) > most)
        fail(path, "must be at most " + std::to_string(most / kMebibyte) + " MiB");
    if (file.is_regular()) add_input(file.identity(), path == "-" ? "/dev/stdin" : path);
    return text;
}

std::string read_own_file(const std::string& path) {
    const OpenFile file(path, TextSource::regular_file);
    return file.read_up_to(std::string().max_size() - 1);
}

void mark_as_input(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
        add_input({status.st_dev, status.st_ino}, path);
}

bool is_input(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return false;
    const Identity identity{status.st_dev, status.st_ino};
    Inputs& all = inputs();
    const std::scoped_lock guard(all.lock);
    const auto found = all.path_of.find(identity);
    return found != all.path_of.end() && stat(found->second.c_str(), &status) == 0 &&
           Identity{status.st_dev, status.st_ino} == identity;
}

std::string line_and_column(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const auto column = std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start),
                                      before.end(), [](char c) { return (c & 0xC0) != 0x80; }) +
                        1;
    return std::to_string(line) + ":" + std::to_string(column);
}

}  // namespace irido::schemas
