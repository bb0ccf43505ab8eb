#pragma once

namespace irido::cli {

/// SIGINT, SIGTERM and SIGHUP end the program with 128 + the signal's number and leave no temporary
/// file; a closed pipe and a file that grows too large are errors of write().
void handle_signals();

/// While it lives, such a signal only asks the program to end; another one, a second later or more,
/// ends it at once. (Some send a signal to a process and to its group.)
class OrderlyEnd {
public:
    OrderlyEnd();
    ~OrderlyEnd();
    OrderlyEnd(const OrderlyEnd&) = delete;
    OrderlyEnd& operator=(const OrderlyEnd&) = delete;

    /// The signal that asked for the end; 0 if there was none.
    int signal() const;
};

}  // namespace irido::cli
