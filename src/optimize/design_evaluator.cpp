#include "optimize/design_evaluator.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "sweep/parallel/worker_pool.hpp"

namespace corpuscle::optimize {
namespace {

constexpr double collect_interval = 0.02, write_interval = 1;  // s
constexpr double iteration_limit = 4;  // times the iterations of the nominal circuit: a design that fires without end is not followed

/// True if two lists of values are equal; NaN is equal to NaN.
bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

std::int64_t DesignEvaluator::item_count(const OptimizationProblem& problem) {
    return max_searches * max_designs * static_cast<std::int64_t>(problem.cases.size());
}

Result<std::unique_ptr<DesignEvaluator>> DesignEvaluator::make(OptimizationProblem& problem, SweepResults* results,
                                                               const EvaluatorOptions& options) {
    auto out = std::unique_ptr<DesignEvaluator>(new DesignEvaluator(problem, results, options));
    problem.sweep->set_points([evaluator = out.get()](std::int64_t item) { return evaluator->point(item); }, item_count(problem),
                              iteration_limit);
    TRY(out->read_stored());
    return out;
}

DesignEvaluator::~DesignEvaluator() = default;

sweeps::SweepPoint DesignEvaluator::point(std::int64_t item) {
    const auto cases = static_cast<std::int64_t>(problem_.cases.size());
    const auto& c = problem_.cases[static_cast<std::size_t>(item % cases)];
    const std::lock_guard lock(mutex_);
    return {problem_.axis_values(designs_.at(item / cases), c), c.chip};
}

Result<void> DesignEvaluator::read_stored() {
    if (!results_) return {};
    TRY(results_->for_each_row([&](const std::vector<double>& axes, const ItemOutcome& outcome) {
        stored_.emplace(outcome.item, Stored{axes, outcome});
        return true;
    }));
    if (problem_.sweep->train_names.empty()) return {};
    for (auto& [item, stored] : stored_) stored.outcome.spikes = {TRY(results_->spikes(item, 0))};
    return {};
}

std::optional<CaseScore> DesignEvaluator::stored_score(std::int64_t item, const std::vector<double>& design, const DesignCase& at) {
    const auto found = stored_.find(item);
    if (found == stored_.end()) return {};
    auto values = found->second.axes;
    values.resize(std::min(values.size(), problem_.sweep->plan().axes.size()));  // without the deviates of the process
    if (!same_values(values, problem_.axis_values(design, at))) {
        fail(
            bad_input("holds other designs than this search asks for: it was written by another version of the program. Remove it, or give "
                      "another file with --results",
                      {results_->path()}));
        return {};
    }
    ++reused_;
    return score_case(problem_, static_cast<std::size_t>(&at - problem_.cases.data()), found->second.outcome);
}

/// Call with the mutex locked.
void DesignEvaluator::fail(const Error& error) {
    if (!is_stopping_) error_ = error;
    is_stopping_ = true;
    answered_.notify_all();
}

std::vector<CaseScore> DesignEvaluator::evaluate(std::int64_t search, std::int64_t number, const std::vector<double>& design,
                                                 std::span<const std::size_t> cases) {
    const auto count = static_cast<std::int64_t>(problem_.cases.size());
    const auto design_number = search * max_designs + number;
    std::vector<CaseScore> out(cases.size());
    std::unique_lock lock(mutex_);
    designs_[design_number] = design;
    Request request;
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < cases.size() && !is_stopping_; ++k) {
        const auto item = design_number * count + static_cast<std::int64_t>(cases[k]);
        if (auto known = stored_score(item, design, problem_.cases[cases[k]])) {
            out[k] = std::move(*known);
            continue;
        }
        if (is_stopping_) break;
        missing.push_back(k), requests_[item] = &request, queue_.push_back(item);
    }
    request.left = missing.size();
    answered_.wait(lock, [&] { return is_stopping_ || request.left == 0; });
    if (is_stopping_) return {};
    for (const auto k : missing) {
        const auto found = scores_.extract(design_number * count + static_cast<std::int64_t>(cases[k]));
        out[k] = found.mapped();
    }
    return out;
}

void DesignEvaluator::deliver(const ItemOutcome& outcome) {
    auto score = score_case(problem_, static_cast<std::size_t>(outcome.item) % problem_.cases.size(), outcome);
    const std::lock_guard lock(mutex_);
    if (is_stopping_) return;  // the searches no longer wait for it
    ++simulated_;
    const auto request = requests_.extract(outcome.item);
    scores_.emplace(outcome.item, std::move(score));
    if (--request.mapped()->left == 0) answered_.notify_all();
}

/// Passes items to the pool and outcomes to the searches until no search runs.
Result<void> DesignEvaluator::pump(WorkerPool& pool) {
    using Clock = std::chrono::steady_clock;
    std::vector<ItemOutcome> unwritten;
    auto last_write = Clock::now();
    const auto write = [&]() -> Result<void> {
        last_write = Clock::now();
        if (!results_ || unwritten.empty()) return unwritten.clear(), Result<void>();
        return results_->add(*problem_.sweep, std::exchange(unwritten, {}));
    };
    for (;;) {
        std::vector<std::int64_t> items;
        {
            const std::lock_guard lock(mutex_);
            items.swap(queue_);
            if (is_stopping_ || (running_ == 0 && items.empty())) break;
        }
        if (!items.empty()) pool.add(items);
        if (pool.is_done()) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the searches are computing
        auto outcomes = pool.collect(collect_interval);
        for (const auto& o : outcomes) deliver(o);
        unwritten.insert(unwritten.end(), std::make_move_iterator(outcomes.begin()), std::make_move_iterator(outcomes.end()));
        TRY(pool.sweep_error());
        options_.on_progress(simulated_ + reused_);
        if (options_.should_stop()) {
            TRY(write());
            return interrupted_error();
        }
        if (std::chrono::duration<double>(Clock::now() - last_write).count() > write_interval) TRY(write());
    }
    return write();
}

Result<void> DesignEvaluator::run(const std::vector<std::function<void()>>& searches) {
    running_ = searches.size();
    WorkerPool pool(*problem_.sweep, options_.threads);
    std::vector<std::thread> threads;
    for (const auto& search : searches)
        threads.emplace_back([&] {
            std::optional<Error> failed;
            try {
                search();
            } catch (const std::exception& e) {
                failed = bad_input(e.what());
            }
            const std::lock_guard lock(mutex_);
            if (failed) fail(*failed);
            --running_;
        });
    auto pumped = pump(pool);
    {
        const std::lock_guard lock(mutex_);
        if (!pumped) fail(pumped.error());
        pool.stop();
    }
    for (auto& t : threads) t.join();
    return is_stopping_ ? error_ : Result<void>();
}

}  // namespace corpuscle::optimize
