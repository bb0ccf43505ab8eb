#include "tables/files/hash.hpp"

#include <nettle/sha2.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "tables/files/plain_file.hpp"

namespace irido::tables {

namespace {

class Sha256 {
public:
    Sha256() { sha256_init(&context_); }

    void add(std::string_view bytes) {
        sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    }

    std::string digits() {
        std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
        sha256_digest(&context_, digest.size(), digest.data());
        constexpr std::string_view kDigits = "0123456789abcdef";
        std::string text;
        for (const unsigned byte : digest) {
            text += kDigits[byte >> 4U];
            text += kDigits[byte & 15U];
        }
        return text;
    }

private:
    sha256_ctx context_{};
};

constexpr std::uint64_t kBufferBytes = 1U << 20U;

}  // namespace

std::string sha256_of(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digits();
}

std::string sha256_of_file(const std::string& path) {
    const PlainFile file(path, PlainFile::Use::read);
    Sha256 hash;
    std::string buffer;
    const std::uint64_t size = file.size();
    for (std::uint64_t at = 0; at < size; at += buffer.size()) {
        buffer.resize(std::min(kBufferBytes, size - at));
        file.read_at(at, buffer);
        hash.add(buffer);
    }
    return hash.digits();
}

}  // namespace irido::tables
