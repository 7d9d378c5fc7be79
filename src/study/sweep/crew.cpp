#include "study/sweep/crew.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace corpuscle {
namespace {

std::size_t bytes_of(const UnitOutcome& o) {
    auto sum = sizeof(UnitOutcome) + o.why.size() + o.measures.size() * sizeof(double);
    for (const auto& train : o.spikes) sum += sizeof(train) + train.size() * sizeof(double);
    for (const auto& trace : o.traces) sum += sizeof(trace) + trace.size() * sizeof(float);
    return sum;
}

/// Turns exceptions of libraries into errors; an exception that leaves a thread ends the program.
Result<void> run_items_safely(const Sweep& sweep, const Sweep::Next& next, const Sweep::Told& on_outcome,
                              const std::function<bool()>& stop) {
    try {
        return sweep.work(next, on_outcome, stop);
    } catch (const std::exception& e) {
        return bad_input(e.what());
    }
}

}  // namespace

Crew::Crew(const Sweep& sweep, unsigned threads) : sweep_(sweep) {
    const unsigned all = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    for (unsigned t = 0; t < all; ++t) threads_.emplace_back([this] { work(); });
}

Crew::~Crew() {
    stop();
    {
        const std::lock_guard lock(guard_);
        closing_ = true;
    }
    given_.notify_all();
    room_.notify_all();
    for (auto& t : threads_) t.join();
}

void Crew::give(const std::vector<std::int64_t>& units) {
    {
        const std::lock_guard lock(guard_);
        if (stopping_) return;
        units_.insert(units_.end(), units.begin(), units.end());
    }
    given_.notify_all();
}

void Crew::stop() {
    const std::lock_guard lock(guard_);
    stopping_ = true;
    units_.clear();
}

std::vector<UnitOutcome> Crew::collect(double seconds) {
    std::unique_lock lock(guard_);
    told_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return held_ >= much || (working_ == 0 && units_.empty()); });
    std::vector<UnitOutcome> out;
    out.swap(outcomes_);
    held_ = 0;
    lock.unlock();
    room_.notify_all();
    return out;
}

std::size_t Crew::waiting() const {
    const std::lock_guard lock(guard_);
    return units_.size();
}

bool Crew::is_done() const {
    const std::lock_guard lock(guard_);
    return working_ == 0 && units_.empty() && outcomes_.empty();
}

Result<void> Crew::fault() const {
    const std::lock_guard lock(guard_);
    return fault_;
}

// A call of Sweep::work may have other items in progress when it asks for the next one, so next() does not wait. Without items the call
// returns, and the thread waits here.
void Crew::work() {
    std::unique_lock lock(guard_);
    for (;;) {
        given_.wait(lock, [&] { return closing_ || !units_.empty(); });
        if (closing_) return;
        ++working_;
        lock.unlock();
        auto ok = run_items_safely(
            sweep_, [this] { return next(); }, [this](UnitOutcome&& o) { tell(std::move(o)); }, [this] { return stopping_.load(); });
        lock.lock();
        --working_;
        if (!ok && fault_ && !stopping_) fault_ = std::move(ok);
        if (!fault_) stopping_ = true, units_.clear();
        told_.notify_all();
    }
}

std::optional<std::int64_t> Crew::next() {
    const std::lock_guard lock(guard_);
    if (units_.empty()) return {};
    const auto item = units_.front();
    units_.pop_front();
    return item;
}

void Crew::tell(UnitOutcome&& outcome) {
    const auto size = bytes_of(outcome);
    std::unique_lock lock(guard_);
    room_.wait(lock, [&] { return held_ < most_held || closing_; });
    outcomes_.push_back(std::move(outcome));
    held_ += size;
    if (held_ >= much) told_.notify_all();
}

}  // namespace corpuscle
