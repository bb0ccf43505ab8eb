#include "cli/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

#include "tables/files/atomic_file.hpp"

namespace irido::cli {

namespace {

volatile std::sig_atomic_t is_orderly = 0, asked = 0;
std::atomic<time_t> asked_at{0};
static_assert(std::atomic<time_t>::is_always_lock_free);

extern "C" void stop_on_signal(int signal) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (is_orderly && (!asked || now.tv_sec - asked_at <= 1)) {
        if (!asked) asked_at = now.tv_sec;
        asked = signal;
        return;
    }
    tables::remove_unfinished_file();
    _exit(128 + signal);
}

}  // namespace

void handle_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, stop_on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

OrderlyEnd::OrderlyEnd() {
    is_orderly = 1;
}

OrderlyEnd::~OrderlyEnd() {
    is_orderly = 0;
}

int OrderlyEnd::signal() const {
    return asked;
}

}  // namespace irido::cli
