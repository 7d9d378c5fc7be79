#include "fit/search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <numeric>

#include "core/random.hpp"

namespace corpuscle {
namespace {

using Point = std::vector<double>;

/// Counts evaluations and reports them, from all threads.
class SearchProgress {
    const SearchOptions& options_;
    double planned_;
    std::mutex mutex_;
    std::size_t evaluations_ = 0;
    double completed_ = 0;  // evaluations, with those that a local search did not need
    bool is_interrupted_ = false;

public:
    explicit SearchProgress(const SearchOptions& options)
        : options_(options), planned_(static_cast<double>(options.points + (options.starts * options.stages + 1) * options.evaluations)) {}

    /// Counts `evaluations`, and `skipped` ones that are not needed. Returns false if the search must end.
    bool add(std::size_t evaluations, std::size_t skipped = 0) {
        const std::lock_guard lock(mutex_);
        evaluations_ += evaluations, completed_ += static_cast<double>(evaluations + skipped);
        if (!is_interrupted_ && !options_.should_continue(std::min(1.0, completed_ / planned_))) is_interrupted_ = true;
        return !is_interrupted_;
    }
    std::size_t evaluations() const { return evaluations_; }
    bool is_interrupted() {
        const std::lock_guard lock(mutex_);
        return is_interrupted_;
    }
};

/// One local search. Remembers the best point itself, because NLopt forgets it when it is stopped.
struct LocalSearch {
    const CostFunction& cost;
    SearchProgress& progress;
    std::size_t stage = 0;
    Point best;
    double best_cost = forbidden_cost;
    nlopt_opt optimizer = nullptr;
    std::exception_ptr exception = nullptr;  // must not pass through NLopt, which is in C

    double evaluate(unsigned n, const double* x) {
        const double value = cost({x, n}, stage);
        if (value < best_cost) best_cost = value, best.assign(x, x + n);
        return value;
    }
    static double objective(unsigned n, const double* x, double*, void* self) {
        auto& search = *static_cast<LocalSearch*>(self);
        try {
            const double value = search.evaluate(n, x);
            if (!search.progress.add(1)) nlopt_force_stop(search.optimizer);
            return value;
        } catch (...) {
            search.exception = std::current_exception();
            nlopt_force_stop(search.optimizer);
            return forbidden_cost;
        }
    }
    /// Searches from `best`, with a first step of `step`.
    void run(double step, std::size_t evaluations) {
        const auto n = static_cast<unsigned>(best.size());
        const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> owner(nlopt_create(NLOPT_LN_SBPLX, n), nlopt_destroy);
        optimizer = owner.get();
        nlopt_set_lower_bounds1(optimizer, 0);
        nlopt_set_upper_bounds1(optimizer, 1);
        nlopt_set_min_objective(optimizer, objective, this);
        nlopt_set_maxeval(optimizer, static_cast<int>(evaluations));
        nlopt_set_xtol_abs1(optimizer, 1e-6);
        nlopt_set_ftol_rel(optimizer, 1e-9);
        // Steps towards the middle, so that none leaves the cube.
        Point steps(n), x = best;
        for (unsigned k = 0; k < n; ++k) steps[k] = x[k] > 0.5 ? -step : step;
        nlopt_set_initial_step(optimizer, steps.data());
        best_cost = forbidden_cost;
        double found = 0;
        nlopt_optimize(optimizer, x.data(), &found);
        const auto used = static_cast<std::size_t>(std::max(0, nlopt_get_numevals(optimizer)));
        optimizer = nullptr;
        if (exception) std::rethrow_exception(exception);
        progress.add(0, evaluations - std::min(evaluations, used));
    }
};

/// The start, and random points.
std::vector<Point> random_points(std::span<const double> start, const SearchOptions& options) {
    constexpr std::uint32_t purpose = 0x66697421;  // "fit!" in ASCII: separates these random numbers from those of other purposes
    std::vector<Point> out = {{start.begin(), start.end()}};
    for (std::size_t p = 0; p < options.points; ++p) {
        Point x;
        for (std::size_t k = 0; k < start.size(); ++k) {
            const auto w = philox({static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(k), 0, purpose}, options.seed);
            x.push_back(unit_interval(w[0], w[1]));
        }
        out.push_back(std::move(x));
    }
    return out;
}

/// The first point and the best of the others, `count` in all.
std::vector<Point> best_points(std::vector<Point> points, std::span<const double> costs, std::size_t count) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin() + 1, order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(costs[a], a) < std::pair(costs[b], b); });
    std::vector<Point> out;
    for (std::size_t k = 0; k < std::min(count, order.size()); ++k) out.push_back(std::move(points[order[k]]));
    return out;
}

}  // namespace

SearchResult search_minimum(const CostFunction& cost, std::span<const double> start, ThreadPool& pool, const SearchOptions& options) {
    SearchProgress progress(options);
    auto points = random_points(start, options);
    std::vector<double> costs(points.size(), forbidden_cost);
    pool.for_each(points.size(), [&](std::size_t k, unsigned) {
        if (progress.is_interrupted()) return;
        costs[k] = cost(points[k], 0);
        progress.add(1);
    });
    auto starts = best_points(std::move(points), costs, options.starts);
    SearchResult out{.point = starts[0], .local_costs = std::vector<double>(starts.size(), forbidden_cost)};
    pool.for_each(starts.size(), [&](std::size_t k, unsigned) {
        constexpr std::size_t promising = 2;  // the given start and the best random point. After an interrupt the others cost time only
        if (k >= promising && progress.is_interrupted()) return;
        LocalSearch local{cost, progress, 0, starts[k]};
        for (std::size_t stage = 0; stage < options.stages && !progress.is_interrupted(); ++stage) {
            local.stage = stage;
            local.run(stage == 0 ? 0.1 : 0.02, options.evaluations);
        }
        starts[k] = local.best;
        out.local_costs[k] =
            local.stage + 1 == options.stages && !progress.is_interrupted() ? local.best_cost : cost(local.best, options.stages - 1);
    });
    const auto best = static_cast<std::size_t>(std::min_element(out.local_costs.begin(), out.local_costs.end()) - out.local_costs.begin());
    out.point = starts[best], out.cost = out.local_costs[best];
    LocalSearch last{cost, progress, options.stages - 1, out.point};
    if (!progress.is_interrupted()) last.run(0.01, options.evaluations);
    if (last.best_cost < out.cost) out.point = last.best, out.cost = last.best_cost;
    if (const double at_start = cost(start, options.stages - 1); at_start < out.cost)
        out.point.assign(start.begin(), start.end()), out.cost = at_start;
    out.evaluations = progress.evaluations(), out.is_interrupted = progress.is_interrupted();
    return out;
}

}  // namespace corpuscle
