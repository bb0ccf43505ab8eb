#include "schemas/documents/varied_stack.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"

using namespace irido;
using namespace irido::schemas;
using nlohmann::json;

namespace {

StackSource mirror() {
    return load_stack({"1 | (1.5@100 | 2@80)^10 | 1.3@300 | BK7", {}});
}

Stack with(const std::vector<std::string>& set) {
    return read_stack({"1 | (1.5@100 | 2@80)^10 | 1.3@300 | BK7", set}).stack;
}

template <class Function>
std::string error_of(const Function& function) {
    try {
        function();
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("thicknesses vary without reading the document again", "[varied]") {
    const VariedStack stack(mirror(), {"layers.0.layers.1.thickness_nm", "layers.1.thickness_nm"});
    CHECK(stack.varies_thickness_only());
    const std::array values{85.5, 300.0};
    CHECK(stack.at(values) == with({"layers.0.layers.1.thickness_nm=85.5"}));
    CHECK_THROWS_AS(stack.at(std::array{-1.0, 300.0}), InputError);
}

TEST_CASE("any other number of the document varies, too", "[varied]") {
    const VariedStack index(mirror(), {"layers.1.material"});
    CHECK_FALSE(index.varies_thickness_only());
    CHECK(index.at(std::array{1.7}) == with({"layers.1.material=1.7"}));
    const VariedStack repeat(mirror(), {"layers.0.repeat"});
    CHECK(repeat.at(std::array{20.0}) == with({"layers.0.repeat=20"}));
    CHECK_THROWS_AS(repeat.at(std::array{0.5}), InputError);
}

TEST_CASE("paths that lead nowhere are refused", "[varied]") {
    for (const std::string path : {"layers.7.thickness_nm", "layers.1.layers.0.thickness_nm",
                                   "layers.x.thickness_nm", "substrat", "layers.0.thickness_nm"}) {
        CAPTURE(path);
        CHECK_THROWS_AS(VariedStack(mirror(), {path}).at(std::array{1.0}), InputError);
    }
}

TEST_CASE("values of any type vary", "[varied]") {
    const VariedStack stack(mirror(), {"substrate", "layers.1.thickness_nm"});
    CHECK_FALSE(stack.varies_thickness_only());
    const auto at = [&](const json& substrate, const json& thickness_nm) {
        return stack.document(std::vector<json>{substrate, thickness_nm});
    };
    CHECK(at("Ag", 20).stack == with({"substrate=Ag", "layers.1.thickness_nm=20"}));
    CHECK(at({{"n", 1.9}, {"k", 1.5}}, 20).stack ==
          with({"substrate=1.9+1.5i", "layers.1.thickness_nm=20"}));
    CHECK(at(1.5, 300).stack == with({"substrate=1.5"}));
    CHECK(at(1.5, 300).file == mirror().file);
    const std::string file = mirror().file + ": ";
    CHECK(error_of([&] { at("Agg", 20); }) ==
          file + "/substrate: unknown material \"Agg\" (did you mean \"Ag\"?)");
    CHECK(error_of([&] { at("Ag", -20); }) ==
          file + "layers.1.thickness_nm: must be in [0, 1e9] (got -20)");
    CHECK(error_of([&] { at("Ag", "20 nm"); }) ==
          file + "/layers/1/thickness_nm: must be a number in [0, 1e9] (got \"20 nm\")");
    CHECK(at("Ag", 20).stack == with({"substrate=Ag", "layers.1.thickness_nm=20"}));  // still
}

TEST_CASE("thicknesses alone vary to the same as with all else", "[varied]") {
    const VariedStack stack(mirror(), {"layers.1.thickness_nm"});
    CHECK(stack.varies_thickness_only());
    CHECK(stack.document(std::vector<json>{85}).stack == with({"layers.1.thickness_nm=85"}));
    CHECK(error_of([&] { stack.document(std::vector<json>{1e10}); }) ==
          mirror().file + ": layers.1.thickness_nm: must be in [0, 1e9] (got 1e+10)");
    CHECK(error_of([&] { stack.document(std::vector<json>{"x"}); }) ==
          mirror().file + ": /layers/1/thickness_nm: must be a number in [0, 1e9] (got \"x\")");
}

TEST_CASE("whole layers vary, and keys that are not there yet", "[varied]") {
    const VariedStack layer(mirror(), {"layers.1", "layers.0.layers.0.coherent"});
    const json glass = {{"material", 1.7}, {"thickness_nm", 5}};
    CHECK(layer.document(std::vector<json>{glass, false}).stack ==
          with({"layers.1.material=1.7", "layers.1.thickness_nm=5",
                "layers.0.layers.0.coherent=false"}));
    CHECK(error_of([&] {
              layer.document(std::vector<json>{3, true});
          }).starts_with(mirror().file + ": /layers/1: must be a layer "));
    const VariedStack repeat(mirror(), {"layers.1.repeat"});
    CHECK(error_of([&] { repeat.document(std::vector<json>{2}); }) ==
          mirror().file + ": /layers/1/repeat: unknown key");
    const VariedStack incident(mirror(), {"incident"});
    CHECK(error_of([&] {
              incident.document(std::vector<json>{{{"n", 1}, {"k", 1}}});
          }).starts_with(mirror().file + ": /incident: must be transparent"));
}

TEST_CASE("many threads may ask for documents at once", "[varied]") {
    const VariedStack stack(mirror(), {"layers.1.material", "layers.0.repeat"});
    const auto values_of = [](std::size_t i) {
        return std::vector<json>{i % 7 == 0 ? json("Ag") : json(1 + 0.001 * static_cast<double>(i)),
                                 1 + i % 5};
    };
    std::vector<Stack> stacks(400);
    const auto fill = [&](std::size_t first) {
        for (std::size_t i = first; i < stacks.size(); i += 4)
            stacks[i] = stack.document(values_of(i)).stack;
    };
    std::vector<std::thread> threads;
    for (std::size_t first = 0; first < 4; ++first) threads.emplace_back(fill, first);
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        StackSource source = mirror();
        set_value(source.document, "layers.1.material", values_of(i)[0]);
        set_value(source.document, "layers.0.repeat", values_of(i)[1]);
        CHECK(stacks[i] == read_stack(source.document, source.file, source.folder).stack);
    }
}

TEST_CASE("files of materials are read once", "[varied]") {
    const std::string folder = std::filesystem::temp_directory_path().string();
    const std::string path = folder + "/irido-varied.csv";
    std::ofstream(path) << "400,1.5\n700,1.4\n";
    StackSource source = mirror();
    source.folder = folder;
    set_value(source.document, "layers.1.material", {{"file", "irido-varied.csv"}});
    const VariedStack stack(source, {"substrate"});
    std::filesystem::remove(path);
    const Stack varied = stack.document(std::vector<json>{2}).stack;
    const std::size_t film = std::get<Layer>(varied.elements[1].value).material;
    CHECK(index_at(varied.materials[film], 700) == Complex(1.4));
}

TEST_CASE("paths of which one is a part of another are refused", "[varied][refused]") {
    CHECK(error_of([] {
              VariedStack(mirror(), {"substrate", "substrate"});
          }) == "substrate: is varied twice");
    CHECK(error_of([] {
              VariedStack(mirror(), {"layers.1.material", "layers.1"});
          }) == "layers.1.material: is inside \"layers.1\", which also varies");
    CHECK_NOTHROW(VariedStack(mirror(), {"layers.1.thickness_nm", "layers.1.thickness_sigma_nm"}));
    CHECK(error_of([] { VariedStack(mirror(), {"substrate.n"}); }) ==
          "substrate.n: the value before \"n\" has no members");
}

TEST_CASE("a thickness is known by its path", "[varied]") {
    for (const std::string path : {"layers.0.thickness_nm", "layers.12.layers.3.thickness_nm"}) {
        CAPTURE(path);
        CHECK(VariedStack::is_thickness(path));
    }
    for (const std::string path :
         {"thickness_nm", "layers.thickness_nm", "layers.0.thickness_sigma_nm", "layers.0",
          "layers..thickness_nm", "layers.0.", "layers.x.thickness_nm", "layers.0x.thickness_nm",
          "layers.-1.thickness_nm", "layers.0.material.thickness_nm", "layers.0.layers",
          "layers.99999999999999999999.thickness_nm", ""}) {
        CAPTURE(path);
        CHECK_FALSE(VariedStack::is_thickness(path));
    }
    Stack stack = with({});
    CHECK(VariedStack::layer_at(stack, "layers.1.thickness_nm")->thickness_nm == 300);
    CHECK(VariedStack::layer_at(stack, "layers.0.layers.1.thickness_nm")->thickness_nm == 80);
    for (const std::string path :
         {"layers.0.thickness_nm", "layers.2.thickness_nm", "layers.1.layers.0.thickness_nm",
          "layers.0.layers.2.thickness_nm", "layers.1.material", "substrate"}) {
        CAPTURE(path);
        CHECK(VariedStack::layer_at(stack, path) == nullptr);
    }
}

TEST_CASE("no path at all is the stack itself", "[varied]") {
    CHECK(VariedStack(mirror(), {}).at({}) == with({"layers.1.thickness_nm=300"}));
}
