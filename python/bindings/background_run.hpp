#pragma once
// Runs a long computation in a thread of its own, while Python's thread reports progress and notices Ctrl-C.

#include <atomic>
#include <chrono>
#include <exception>
#include <future>

#include "bindings/bindings.hpp"

namespace corpuscle::python {

/// Calls run(progress) and returns its result; `progress` may be called from any thread. Meanwhile the function of Python (or None) is called
/// 20 times a second with the latest fraction, and `progress` returns false if the function says so. After Ctrl-C, or if the function
/// throws, it returns false too, and the exception is thrown when the run has ended.
template <class Run>
auto run_in_background(const py::object& function, Run run) {
    std::atomic<double> latest = 0;
    std::atomic<bool> is_stopped = false;
    std::exception_ptr exception;
    py::gil_scoped_release released;
    auto result = std::async(std::launch::async, [&] {
        return run([&](double fraction) { return latest = fraction, !is_stopped; });
    });
    while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
        if (is_stopped) continue;
        py::gil_scoped_acquire lock;
        try {
            is_stopped = !call_progress(function, latest);
        } catch (...) {
            exception = std::current_exception(), is_stopped = true;
        }
    }
    if (exception) {
        result.wait();
        std::rethrow_exception(exception);
    }
    return result.get();
}

}  // namespace corpuscle::python
