#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace irido {

/// A value constructed on first use, by whichever thread gets there first.
template <class T>
class Lazy {
public:
    /// `make` returns a std::unique_ptr<T>. Every call must pass the same `lock`, which `make`
    /// itself must not take.
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
