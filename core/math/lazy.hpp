#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace irido {

/// A value that is made when it is first asked for, by the first thread that does.
template <class T>
class Lazy {
public:
    /// `make` returns a std::unique_ptr<T>; `lock` is the same in every call, and `make` does not
    /// need it.
    template <class Make>
    T& get(std::mutex& lock, const Make& make) {
        if (T* ready = ready_.load(std::memory_order_acquire)) return *ready;
        const std::scoped_lock guard(lock);
        if (!value_) {
            value_ = make();
            ready_.store(value_.get(), std::memory_order_release);
        }
        return *value_;
    }

private:
    std::atomic<T*> ready_ = nullptr;
    std::unique_ptr<T> value_;
};

}  // namespace irido
