#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kLongest = 10s;

void allocate() {
    std::vector<std::string> texts;
    for (const auto end = Clock::now() + 2 * kLongest; Clock::now() < end;)
        for (std::size_t i = 0; i < 10000; ++i) {
            texts.emplace_back(2000 + i, 'x');  // a size for which threads share memory
            if (texts.size() > 100) texts.clear();
        }
}

/// Starts the test program with a single test.
pid_t start_test(const char* name) {
    const pid_t child = fork();
    if (child == 0) {
        execl("/proc/self/exe", "irido_tests", name, nullptr);
        _exit(127);
    }
    return child;
}

/// The exit status of a process; kills it if it does not end.
int status_of(pid_t child) {
    int status = 0;
    for (const auto end = Clock::now() + kLongest; Clock::now() < end;) {
        if (waitpid(child, &status, WNOHANG) == child) return status;
        std::this_thread::sleep_for(2ms);
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return status;
}

}  // namespace

TEST_CASE("is stopped while its threads allocate", "[.]") {
    const std::jthread other(allocate), stopping([] {
        std::this_thread::sleep_for(50ms);
        kill(getpid(), SIGTERM);
    });
    allocate();
    CHECK(false);
}

TEST_CASE("the test program ends on SIGTERM", "[tests]") {
    for (int repeat = 0; repeat < 5; ++repeat) {
        const pid_t child = start_test("is stopped while its threads allocate");
        REQUIRE(child > 0);
        const int status = status_of(child);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == SIGTERM);
    }
}
