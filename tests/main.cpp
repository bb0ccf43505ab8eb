// Catch2's handler of signals allocates and prints: where a signal comes while memory is allocated
// it waits for itself without end. Signals end the tests as they end any program.
#define CATCH_CONFIG_NO_POSIX_SIGNALS
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
