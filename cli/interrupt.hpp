#pragma once

namespace irido::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program with 128 + the signal's number, without leaving
/// a temporary file; a closed pipe and exceeding the file size limit become errors of write().
void handle_signals();

/// While an object exists, such a signal only requests an orderly end; another one, a second or
/// more later, ends the program at once. (Some senders signal both a process and its group.)
class OrderlyEnd {
public:
    OrderlyEnd();
    ~OrderlyEnd();
    OrderlyEnd(const OrderlyEnd&) = delete;
    OrderlyEnd& operator=(const OrderlyEnd&) = delete;

    /// The signal that requested the end; 0 if there was none.
    int signal() const;
};

}  // namespace irido::cli
