#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/sample_luts.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;

TEST_CASE("numpy reads a table", "[tables][lut][slow]") {
    const TemporaryFolder folder;
    for (const LutType type : {LutType::f16, LutType::f32, LutType::f64})
        for (const std::size_t channels : {1, 3})
            for (const std::vector<std::size_t>& counts :
                 {std::vector<std::size_t>{5}, std::vector<std::size_t>{3, 4, 2}}) {
                const Lut lut = sample_lut(type, channels, counts);
                for (const char* format : {"npy", "bin"})
                    write_lut(lut, folder / "t." + format, *find_lut_format(format), {});
                const Outcome outcome = run_shell(
                    "/usr/bin/python3 -c '\n"
                    "import numpy, json\n"
                    "m = json.load(open(\"t.npy.json\"))\n"
                    "a = numpy.load(\"t.npy\")\n"
                    "shape = [x[\"count\"] for x in m[\"axes\"]]\n"
                    "if len(m[\"channels\"]) > 1: shape.append(len(m[\"channels\"]))\n"
                    "assert a.dtype == numpy.dtype(\"<\" + m[\"dtype\"].replace(\"16\", \"2\")"
                    ".replace(\"32\", \"4\").replace(\"64\", \"8\"))\n"
                    "assert list(a.shape) == shape and a.flags.c_contiguous\n"
                    "assert a.tobytes() == open(\"t.bin\", \"rb\").read()\n"
                    "numpy.save(\"again.npy\", a)\n"
                    "assert open(\"again.npy\", \"rb\").read() == open(\"t.npy\", "
                    "\"rb\").read()\n'",
                    folder.path());
                CHECK(outcome.err.empty());
                CHECK(outcome.status == 0);
            }
}
