#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;

namespace {

struct Shape {
    std::string name;
    std::vector<std::size_t> counts;
    bool mips = false, layers = false;
};

const std::vector<Shape> kShapes{
    {"8", {8}},
    {"4x8", {4, 8}},
    {"3x4x8", {3, 4, 8}},
    {"1x4x8", {1, 4, 8}},
    {"3x4x8-layers", {3, 4, 8}, false, true},
    {"1x4x8-layers", {1, 4, 8}, false, true},
    {"3x8-mips", {3, 8}, true},
    {"3x4x8-mips", {3, 4, 8}, true},
};

void write_as(const char* format, const Lut& lut, const std::string& name,
              const LutLayout& layout = {}) {
    write_lut(lut, name + "." + format, *find_lut_format(format), layout);
}

}  // namespace

// Hidden: run by tests/consumers, which reads the files with other programs.
TEST_CASE("files of every layout for other programs", "[.consumers]") {
    const char* const folder = std::getenv("IRIDO_SAMPLES");
    if (!folder) return;
    for (const LutType type : {LutType::f16, LutType::f32})
        for (const std::size_t channels : {1, 2, 3, 4, 6})
            for (const auto& [shape, counts, mips, layers] : kShapes) {
                const Lut lut = sample_lut(type, channels, counts, mips);
                const std::string name = folder + ("/" + std::string(name_of(type))) + "-" +
                                         std::to_string(channels) + "-" + shape;
                write_as("bin", lut, name);
                write_as("ktx2", lut, name, {false, layers});
                write_as("bin", lut, name + "-zstd");
                write_as("ktx2", lut, name + "-zstd", {true, layers});
                if (!mips && !layers) write_as("exr", lut, name);
            }
}
