#include "cli/options/shard.hpp"

#include "cli/options/list.hpp"

namespace irido::cli {

Shard parse_shard(const std::string& text) {
    constexpr double kMostShards = 1e6;
    if (text.empty()) return {};
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos)
        throw UsageError("--shard: must be K/N, as in 3/8 (got '" + text + "')");
    const auto of = parse_whole_number("--shard", text.substr(slash + 1), 1, kMostShards);
    return {parse_whole_number("--shard", text.substr(0, slash), 1, static_cast<double>(of)), of};
}

}  // namespace irido::cli
