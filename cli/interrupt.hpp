#pragma once

namespace irido {

/// SIGINT, SIGTERM and SIGHUP end the program with 128 + the signal's number and leave no temporary
/// file; a closed pipe and a file that grows too large are errors of write().
void handle_signals();

/// While it lives, the first such signal only asks the program to end.
class OrderlyEnd {
public:
    OrderlyEnd();
    ~OrderlyEnd();
    OrderlyEnd(const OrderlyEnd&) = delete;
    OrderlyEnd& operator=(const OrderlyEnd&) = delete;

    /// The signal that asked for the end; 0 if there was none.
    int signal() const;
};

}  // namespace irido
