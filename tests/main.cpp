// Catch2's signal handler allocates and prints: if a signal arrives during an allocation it
// deadlocks. Without it, signals end the tests as they end any program.
#define CATCH_CONFIG_NO_POSIX_SIGNALS
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
