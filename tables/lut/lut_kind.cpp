#include "tables/lut/lut_kind.hpp"

#include <algorithm>
#include <array>

#define IRIDO_DECLARE(name) extern const LutKind name;
namespace irido::tables {
#include "lut_kinds.inc"

namespace {

constexpr std::array kKinds{IRIDO_ALL};
#undef IRIDO_DECLARE
#undef IRIDO_ALL

}  // namespace

std::span<const LutKind* const> lut_kinds() {
    return kKinds;
}

const LutKind* find_lut_kind(std::string_view name) {
    const auto* found = std::ranges::find(kKinds, name, &LutKind::name);
    return found == kKinds.end() ? nullptr : *found;
}

std::vector<std::string> paths_of(std::span<const VariedValue> vary) {
    std::vector<std::string> paths;
    for (const VariedValue& one : vary) paths.push_back(one.path);
    return paths;
}

const std::vector<double>& LutRequest::list(std::string_view name) const {
    return std::get<std::vector<double>>(options.find(name)->second);
}

double LutRequest::number(std::string_view name) const {
    return std::get<double>(options.find(name)->second);
}

const std::string& LutRequest::word(std::string_view name) const {
    return std::get<std::string>(options.find(name)->second);
}

}  // namespace irido::tables
