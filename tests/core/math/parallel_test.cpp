#include "core/math/parallel.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

using namespace irido;

TEST_CASE("parallel_for does every piece of work once") {
    for (const unsigned threads : {0U, 1U, 2U, 7U}) {
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
            std::vector<int> calls(count, 0);
            parallel_for(count, threads, [&](std::size_t i) { ++calls[i]; });
            CHECK(calls == std::vector<int>(count, 1));
        }
    }
}

TEST_CASE("parallel_for hands on the first exception and stops") {
    for (const unsigned threads : {1U, 4U}) {
        std::atomic<int> calls = 0;
        const auto work = [&](std::size_t i) {
            ++calls;
            if (i == 3) throw std::runtime_error("three");
        };
        CHECK_THROWS_WITH(parallel_for(100000000, threads, work), "three");
        CHECK(calls < 100000000);
    }
}
