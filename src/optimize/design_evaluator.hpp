#pragma once
// Simulates designs for several searches at once, each in a thread of its own, on the lanes of one worker pool. All outcomes are written to
// a results file. A search that runs again, with the same file, receives the stored outcomes instead of simulating: so it resumes.

#include <condition_variable>
#include <mutex>

#include "core/error.hpp"
#include "optimize/design_score.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {
class WorkerPool;
}

namespace corpuscle::optimize {

struct EvaluatorOptions {
    unsigned threads = 0;  ///< 0: one for each core
    std::function<bool()> should_stop = [] { return false; };
    std::function<void(std::size_t simulations)> on_progress = [](std::size_t) {};  ///< called often, with the number since the start
};

class DesignEvaluator {
public:
    /// Searches have numbers below max_searches and evaluate designs with numbers below max_designs. They give an item its number in the
    /// results, so that it does not depend on the order in which threads ask.
    static constexpr std::int64_t max_searches = 4096, max_designs = 200'000;
    static std::int64_t item_count(const OptimizationProblem&);

    /// Prepares the problem's sweep. `results`: null: outcomes are not stored.
    static Result<std::unique_ptr<DesignEvaluator>> make(OptimizationProblem&, SweepResults* results, const EvaluatorOptions&);
    ~DesignEvaluator();

    /// Calls each function in a thread of its own, simulates the designs that they ask for, and returns when all functions have returned.
    /// Errors: interrupted, an error of the sweep or the results file, an exception of a function.
    Result<void> run(const std::vector<std::function<void()>>& searches);
    /// The scores of a design in these cases, in their order. Only within a function of run(). Empty: the search must end.
    std::vector<CaseScore> evaluate(std::int64_t search, std::int64_t number, const std::vector<double>& design,
                                    std::span<const std::size_t> cases);

    std::size_t simulated() const { return simulated_; }  ///< simulations of this run
    std::size_t reused() const { return reused_; }        ///< outcomes that were in the results file

private:
    struct Request {
        std::size_t left = 0;  // outcomes that are missing
    };
    struct Stored {
        std::vector<double> axes;
        ItemOutcome outcome;
    };

    OptimizationProblem& problem_;
    SweepResults* results_;
    EvaluatorOptions options_;
    std::mutex mutex_;
    std::condition_variable answered_;
    std::map<std::int64_t, std::vector<double>> designs_;  // by item / number of cases
    std::map<std::int64_t, Stored> stored_;                // read from the results file
    std::map<std::int64_t, CaseScore> scores_;             // of the designs that are being simulated
    std::map<std::int64_t, Request*> requests_;            // by item
    std::vector<std::int64_t> queue_;                      // items for the pool
    std::size_t running_ = 0;                              // searches
    bool is_stopping_ = false;
    Result<void> error_;
    std::size_t simulated_ = 0, reused_ = 0;

    DesignEvaluator(OptimizationProblem& problem, SweepResults* results, const EvaluatorOptions& options)
        : problem_(problem), results_(results), options_(options) {}
    sweeps::SweepPoint point(std::int64_t item);
    Result<void> read_stored();
    std::optional<CaseScore> stored_score(std::int64_t item, const std::vector<double>& design, const DesignCase&);
    void fail(const Error&);
    void deliver(const ItemOutcome&);
    Result<void> pump(WorkerPool&);
};

}  // namespace corpuscle::optimize
