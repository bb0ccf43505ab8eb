#pragma once

#include <cstdint>
#include <string>

namespace irido::cli {

/// Shard K of N.
struct Shard {
    std::uint64_t number = 1, of = 1;
};

/// The shard of "K/N", 1/1 for "". Throws UsageError.
Shard parse_shard(const std::string& text);

}  // namespace irido::cli
