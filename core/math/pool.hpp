#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace irido {

/// Scratch objects that callers borrow, one each, and hand back for reuse. Thread-safe.
template <class T>
class Pool {
public:
    class Loan {
    public:
        explicit Loan(Pool& pool) : pool_(pool), object_(pool.take()) {}
        ~Loan() {
            const std::scoped_lock guard(pool_.lock_);
            pool_.idle_.push_back(std::move(object_));
        }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;
        T& operator*() const { return *object_; }
        T* operator->() const { return object_.get(); }

    private:
        Pool& pool_;
        std::unique_ptr<T> object_;
    };

    Loan borrow() { return Loan(*this); }

private:
    std::unique_ptr<T> take() {
        const std::scoped_lock guard(lock_);
        if (idle_.empty()) return std::make_unique<T>();
        std::unique_ptr<T> object = std::move(idle_.back());
        idle_.pop_back();
        return object;
    }

    std::mutex lock_;
    std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace irido
