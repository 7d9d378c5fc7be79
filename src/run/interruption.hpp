#pragma once
// The interruption of a run within a block that takes long, as a block of a slow circuit can.

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <utility>

namespace corpuscle {

/// Asks RespondOptions::should_continue within a block. Only the thread of the run asks; the others read the last answer.
class Interruption {
    using Clock = std::chrono::steady_clock;
    static constexpr auto interval = std::chrono::milliseconds(50);  // between two questions

    std::function<bool()> should_continue_;
    Clock::time_point last_ = Clock::now();
    std::atomic<bool> is_stopped_ = false;
    std::exception_ptr exception_;  // of should_continue_

public:
    /// Begins a block.
    void begin(std::function<bool()> should_continue) { should_continue_ = std::move(should_continue), last_ = Clock::now(); }

    /// For the thread of the run: asks if the interval is over. Returns true if the run is stopped.
    bool ask() {
        if (is_stopped_ || Clock::now() - last_ < interval) return is_stopped_;
        try {
            is_stopped_ = !should_continue_();
        } catch (...) {
            exception_ = std::current_exception(), is_stopped_ = true;
        }
        last_ = Clock::now();
        return is_stopped_;
    }
    /// For any thread.
    bool is_stopped() const { return is_stopped_; }
    /// For the thread of the run, at the end of a block: throws the exception that has stopped it, if there was one.
    void rethrow() {
        if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
    }
};

}  // namespace corpuscle
