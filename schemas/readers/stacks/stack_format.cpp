#include "schemas/readers/stacks/stack_format.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "schemas/readers/stacks/layer_list.hpp"
#include "schemas/readers/stacks/openfilters.hpp"
#include "schemas/readers/stacks/zemax.hpp"

namespace irido::schemas {

namespace {

constexpr std::array kStackFormats{
    StackFormat{"zemax", ".dat", "COATING.DAT", read_zemax, write_zemax},
    StackFormat{"openfilters", ".ofp", "an OpenFilters project", read_openfilters,
                write_openfilters},
    StackFormat{"csv", ".csv", "a list of layers", read_layer_list, write_layer_list},
};

}  // namespace

std::span<const StackFormat> stack_formats() {
    return kStackFormats;
}

const StackFormat* stack_format_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const auto* const found = std::ranges::find(kStackFormats, ending, &StackFormat::ending);
    return found == kStackFormats.end() ? nullptr : found;
}

}  // namespace irido::schemas
