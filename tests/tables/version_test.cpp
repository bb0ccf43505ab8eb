#include "tables/version.hpp"

#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/program.hpp"

using namespace irido;
using namespace irido::tables;
using namespace irido::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

/// The lines that the build script writes for a folder.
std::string version_of(const std::string& folder, const std::string& git,
                       const std::string& header) {
    const Outcome outcome = run_shell(
        "cmake -DSOURCE=" + folder + " -DVERSION=1.2.3 -DGIT=" + git + " -DHEADER=" + header +
            " '-DROOMS=room;list' -P tables/version.cmake && cat " + header,
        IRIDO_SOURCE_DIR);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    return outcome.out;
}

std::string version_of(const std::string& folder, const std::string& git = "git") {
    const TemporaryFolder made;
    return version_of(folder, git, made / "version.inc");
}

std::string header_with(const std::string& commit) {
    return "#define IRIDO_VERSION \"1.2.3\"\n#define IRIDO_COMMIT \"" + commit + "\"\n";
}

}  // namespace

TEST_CASE("a build is told by version and commit", "[version]") {
    CHECK(version_text({"1.2.3", "0123456789ab"}) == "1.2.3 (0123456789ab)");
    CHECK(version_text({"1.2.3", ""}) == "1.2.3");
    const Build& build = this_build();
    CHECK(std::regex_match(build.version, std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")));
    CHECK(std::regex_match(build.commit, std::regex("([0-9a-f]{12,40}(-dirty-[0-9a-f]{8})?)?")));
    CHECK_THAT(run_irido({"--version"}).out, StartsWith("irido " + version_text(build) + ", "));
}

TEST_CASE("the commit is that of a checkout, its changes counted in", "[version][slow]") {
    const TemporaryFolder folder;
    const std::string& at = folder.path();
    const auto git = [&](const std::string& command) {
        const Outcome outcome = run_shell(
            "git -c user.name=a -c user.email=a@b.c -c core.hooksPath=/dev/null " + command, at);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return outcome.out.substr(0, outcome.out.find('\n'));
    };
    CHECK(version_of(at) == header_with(""));
    git("init -q");
    CHECK(version_of(at) == header_with(""));  // no commit yet
    run_shell("mkdir room other && echo 1 > room/a && echo 1 > other/a", at);
    git("add room other");
    git("commit -qm one");
    const std::string commit = git("rev-parse --short=12 HEAD");
    CHECK(version_of(at) == header_with(commit));
    CHECK(version_of(at, "") == header_with(""));
    CHECK(version_of(at + "/room") == header_with(""));  // a folder inside another checkout
    write_text(folder / "other/a", "2\n");               // not part of the program
    CHECK(version_of(at) == header_with(commit));
    write_text(folder / "room/a", "2\n");
    const std::string changed = version_of(at);
    CHECK_THAT(changed, Contains(commit + "-dirty-"));
    write_text(folder / "room/a", "3\n");
    CHECK_THAT(version_of(at), Contains(commit + "-dirty-"));
    CHECK(version_of(at) != changed);
    write_text(folder / "room/a", "1\n");
    CHECK(version_of(at) == header_with(commit));
    write_text(folder / "room/b", "");  // not yet tracked by git
    CHECK_THAT(version_of(at), Contains(commit + "-dirty-"));
}

TEST_CASE("a header that says it already is not written again", "[version]") {
    const TemporaryFolder folder;
    version_of(folder.path(), "git", folder / "version.inc");
    const Outcome same = run_shell("touch -d 2001-01-01 version.inc", folder.path());
    version_of(folder.path(), "git", folder / "version.inc");
    CHECK(run_shell("find version.inc -newermt 2002-01-01", folder.path()).out.empty());
    CHECK(same.status == 0);
}
