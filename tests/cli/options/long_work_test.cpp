#include "cli/options/long_work.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::schemas;
using namespace irido::cli;
using namespace irido::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinRel;

TEST_CASE("long work is known from a trial of a tenth of a second", "[cli][long-work]") {
    std::vector<double> trials;
    const auto with = [&](double unit_s) {
        trials.clear();
        return [&trials, unit_s](double units) {
            trials.push_back(units);
            return unit_s * units;
        };
    };
    CHECK_THAT(tried_seconds(1e6, 1, with(1e-3)), WithinRel(1e3, 1e-12));
    CHECK(trials.back() == 128);  // the first power of two that takes a tenth of a second
    CHECK(tried_seconds(1e6, 1, with(1e-6)) < kLongWork_s);
    CHECK(trials.size() == 1);
    // if a single unit is slow, a fraction of it is timed
    CHECK_THAT(tried_seconds(20, kFirstShare, with(100)), WithinRel(2000.0, 1e-12));
    CHECK(trials == std::vector{kFirstShare, 2 * kFirstShare});
    // a trial is never a large part of the work
    CHECK(tried_seconds(3, 1, with(1e3)) == 0);
    CHECK(trials.empty());
    // errors are left to the work itself
    CHECK(tried_seconds(1e6, 1, [](double) -> double { throw std::runtime_error(""); }) == 0);
}

TEST_CASE("a trial that took a while at first is tried further", "[cli][long-work]") {
    const auto with_start = [](double units) { return 0.05 + 1e-7 * units; };
    CHECK(tried_seconds(1e6, 1, with_start) < kLongWork_s);
}

TEST_CASE("times are said in one or two digits", "[cli][long-work]") {
    CHECK(coarse_time(0.02) == "1 s");
    CHECK(coarse_time(7.4) == "7 s");
    CHECK(coarse_time(31.2) == "31 s");
    CHECK(coarse_time(60) == "1 minute");
    CHECK(coarse_time(200) == "3 minutes");
    CHECK(coarse_time(3600) == "1 hour");
    CHECK(coarse_time(36000) == "10 hours");
    CHECK(coarse_time(1e6) == "12 days");
    CHECK(coarse_time(1.234e9) == "14000 days");
}

TEST_CASE("what is not long is not announced", "[cli][long-work]") {
    std::vector<std::string> said;
    const auto say = [&](const std::string& text) { said.push_back(text); };
    note_long_work(59, false, say);
    CHECK(said.empty());
    note_long_work(120, false, say);
    note_long_work(7200, true, say);
    CHECK(said == std::vector<std::string>{"this will take about 2 minutes",
                                           "this will take about 2 hours, or longer"});
}

namespace {

// Requests of many hours, stopped once they have announced it.
class Long {
public:
    Long() {
        write_text(folder_ / "two.json", stack(2));
        write_text(folder_ / "three.json", stack(3));
        write_text(folder_ / "scene.json",
                   R"({"materials": [{"name": "a", "stack": "three.json", "shading": "color"}]})");
    }

    void check(const std::string& command) const {
        CAPTURE(command);
        const std::string err = begun(command);
        CHECK_THAT(err, StartsWith("irido: note: "));
        CHECK_THAT(err, Contains("hours") || Contains("days"));
        CHECK(std::ranges::count(err, '\n') == 1);
    }

    /// The output of a command until it says something, or for so many times 20 ms.
    std::string begun(const std::string& command, const std::string& tries = "500") const {
        run_shell("rm -f said\n\"$IRIDO\" " + command + " > out 2> said &\np=$!\nfor i in $(seq " +
                      tries + "); do [ -s said ] && break; sleep 0.02; done\nkill -9 $p",
                  folder_.path());
        return read_file(folder_ / "said");
    }

private:
    /// Of distributions that are cut at zero: means over these take longest.
    static std::string stack(int spread) {
        std::string layers;
        for (int i = 0; i < spread; ++i)
            layers += std::string(i > 0 ? ", " : "") +
                      R"({"material": 1.46, "thickness_nm": 300, "thickness_sigma_nm": 80},)"
                      R"({"material": 2.4, "thickness_nm": 80})";
        return R"({"incident": 1, "layers": [)" + layers + R"(], "substrate": 3.5})";
    }

    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("spectra and colours that take long say so first", "[cli][long-work][slow]") {
    const Long work;
    work.check("spectrum two.json -w 400:700/20000 -a 0:80/20000");
    work.check("color three.json -a 0:80/20000");
    CHECK(work.begun("color three.json -a 0:80/2000 --quiet", "30").empty());
}

TEST_CASE("sweeps that take long say so first", "[cli][long-work]") {
    const Long work;
    work.check("sweep three.json --compute color --vary layers.0.thickness_nm=100:400/50000");
}

TEST_CASE("tables that take long say so first", "[cli][long-work]") {
    const Long work;
    work.check("lut color two.json --cos 0:1/8192 --vary layers.0.thickness_nm=100:400/8192");
    work.check("lut albedo three.json --tolerance 0.1");
    work.check("bake scene.json -o baked");
}
