#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tables/lut/lut_file.hpp"

namespace irido::test {

using namespace tables;

/// A table with linear axes a, b, c of these counts, and values over the whole range of its type,
/// including 0, -0 and subnormal numbers.
///   type      number format of the values
///   channels  number of channels
///   counts    samples per axis
///   mips      whether the first axis counts mip levels
Lut sample_lut(LutType type, std::size_t channels, const std::vector<std::size_t>& counts,
               bool mips = false);

/// Its files, as written by a format.
struct Files {
    std::string bytes, companion;
};

Files files_of(const Lut& lut, const LutFormat& format, const LutLayout& layout = {});
Files files_of(const Lut& lut, const std::string& format, const LutLayout& layout = {});

/// The text of the LutError that `run` throws, or "" if it throws none.
template <class Run>
std::string refusal(Run run) {
    try {
        run();
    } catch (const LutError& error) {
        return error.what();
    }
    return "";
}

}  // namespace irido::test
