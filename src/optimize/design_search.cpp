#include "optimize/design_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "optimize/local_search.hpp"
#include "optimize/variable_limits.hpp"
#include "sweep/spec/sampling.hpp"

namespace corpuscle::optimize {
namespace {

constexpr std::size_t point_threads = 16;                  // designs of the first stage that are simulated at once
constexpr double first_step = 0.15, shortest_step = 0.02;  // of a local search in its first round; fraction of a variable's range
constexpr std::size_t kept_designs = 2;                    // designs from which the next round begins
constexpr int line_parts = 8;                              // of the line between two designs
constexpr std::uint32_t shifted_designs = 4;               // that must be within the limits, too, before a design counts as found
constexpr double max_shift = 2e-3;                         // of their variables; fraction of a variable's range
constexpr double settled_gain = 1e-3;                      // a round that improves the merit by less is the last one, if no case fails

constexpr std::uint32_t shift_purpose = 0x6f707401;  // of the random shifts

// The numbers of the searches that are not local, see DesignEvaluator.
constexpr std::int64_t all_cases_search = 0, points_search = 1, first_local_search = 2;

/// By merit; equal ones by their values, so that the order is unique.
bool is_better(const ScoredDesign& a, const ScoredDesign& b) { return a.merit != b.merit ? a.merit < b.merit : a.values < b.values; }

class DesignSearch {
    OptimizationProblem& problem_;
    DesignEvaluator& evaluator_;
    const SearchSettings& settings_;
    std::vector<std::size_t> all_, active_;  // cases
    std::int64_t all_cases_designs_ = 0, next_search_ = first_local_search;
    double reference_ = 1;
    OptimizationResult out_;
    ScoredDesign best_;

    ScoredDesign scored(std::vector<double> values, std::vector<CaseScore> scores) const {
        ScoredDesign out{std::move(values), score_design(problem_, all_, scores), std::move(scores), 0};
        out.merit = merit(problem_, out.score, reference_);
        return out;
    }

    /// Simulates designs in all cases.
    Result<std::vector<ScoredDesign>> score_all(const std::vector<std::vector<double>>& designs) {
        std::vector<std::vector<CaseScore>> scores(designs.size());
        std::vector<std::function<void()>> searches;
        for (std::size_t k = 0; k < designs.size(); ++k)
            searches.push_back(
                [&, k, number = all_cases_designs_++] { scores[k] = evaluator_.evaluate(all_cases_search, number, designs[k], all_); });
        TRY(evaluator_.run(searches));
        std::vector<ScoredDesign> out;
        for (std::size_t k = 0; k < designs.size(); ++k) out.push_back(scored(designs[k], std::move(scores[k])));
        return out;
    }

    /// The design with each of its continuous variables at a random position up to max_shift away.
    std::vector<double> shifted(const std::vector<double>& design, std::uint32_t number) const {
        auto out = design;
        for (std::uint32_t k = 0; k < out.size(); ++k) {
            const auto& v = problem_.variables[k];
            const double shift = max_shift * (philox({k, number, 0, shift_purpose}, problem_.seed)[0] * 0x1p-31 - 1);
            if (!v.is_integer) out[k] = v.value(std::clamp(v.position(design[k]) + shift, 0.0, 1.0));
        }
        return out;
    }

    /// True if small changes of the design do not leave the limits. A design that barely fires in a case may not fire with other
    /// tolerances.
    Result<bool> is_robust(const ScoredDesign& design) {
        std::vector<std::vector<double>> designs;
        for (std::uint32_t k = 0; k < shifted_designs; ++k) designs.push_back(shifted(design.values, k));
        const auto scored_designs = TRY(score_all(designs));
        return std::ranges::all_of(scored_designs, [](const ScoredDesign& d) { return d.score.is_within; });
    }

    /// Takes the best of the designs that is better than the present best one, and robust if it is within the limits.
    Result<void> take_best_of(std::vector<ScoredDesign> designs) {
        std::ranges::sort(designs, is_better);
        for (auto& d : designs) {
            if (!(d.merit < best_.merit)) break;
            if (d.score.is_within && !TRY(is_robust(d))) continue;
            best_ = std::move(d);
            break;
        }
        return {};
    }

    /// Adds to the active cases those in which a design is nearest to its limits, or furthest outside; returns their number.
    /// `only_failing`: only cases outside.
    std::size_t activate(const ScoredDesign& design, std::size_t count, bool only_failing) {
        auto order = all_;
        const auto excess = [&](std::size_t c) { return design.cases[c].excess; };
        std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return excess(a) != excess(b) ? excess(a) > excess(b) : a < b; });
        std::size_t added = 0;
        for (const auto c : order) {
            if (added == count || (only_failing && design.cases[c].is_within)) break;
            if (std::ranges::find(active_, c) != active_.end()) continue;
            active_.push_back(c), ++added;
        }
        std::ranges::sort(active_);
        return added;
    }

    /// Quasi-random designs, with their merit in the active cases.
    Result<std::vector<std::vector<double>>> starting_designs() {
        std::vector<std::vector<double>> designs(settings_.points);
        for (std::size_t k = 0; k < problem_.variables.size(); ++k) {
            const auto& v = problem_.variables[k];
            const sweeps::UniformNumbers numbers(sweeps::Sampling::sobol, problem_.seed, v.name(), k, settings_.points);
            for (std::size_t p = 0; p < designs.size(); ++p) designs[p].push_back(v.value(numbers.at(p)));
        }
        std::vector<double> merits(designs.size());
        std::vector<std::function<void()>> searches;
        for (std::size_t t = 0; t < std::min(point_threads, designs.size()); ++t)
            searches.push_back([&, t] {
                for (auto p = t; p < designs.size(); p += point_threads) {
                    const auto scores = evaluator_.evaluate(points_search, static_cast<std::int64_t>(p), designs[p], active_);
                    if (scores.empty()) return;
                    merits[p] = merit(problem_, score_design(problem_, active_, scores), reference_);
                }
            });
        TRY(evaluator_.run(searches));
        out_.designs += designs.size();
        std::vector<std::size_t> order(designs.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return merits[a] != merits[b] ? merits[a] < merits[b] : a < b; });
        std::vector<std::vector<double>> out = {problem_.start()};
        for (std::size_t k = 0; k < order.size() && out.size() < settings_.starts; ++k) out.push_back(designs[order[k]]);
        return out;
    }

    /// One local search from each design. Returns the designs they find, without repetitions.
    Result<std::vector<std::vector<double>>> search_from(const std::vector<std::vector<double>>& starts, double step) {
        std::vector<LocalSearch> searches;
        for (std::size_t k = 0; k < starts.size(); ++k) searches.emplace_back(problem_, evaluator_, next_search_++, active_, reference_);
        std::vector<std::function<void()>> functions;
        for (std::size_t k = 0; k < starts.size(); ++k)
            functions.push_back([&, k] { searches[k].run(starts[k], step, settings_.evaluations); });
        TRY(evaluator_.run(functions));
        std::vector<std::vector<double>> out;
        for (const auto& s : searches) {
            out_.designs += s.evaluations();
            if (std::ranges::find(out, s.best()) == out.end()) out.push_back(s.best());
        }
        return out;
    }

    /// Designs on the straight line from the best design, which is within the limits, to others that are not, or not robust: those near the
    /// best one are often within the limits, too.
    Result<void> search_between(std::span<const ScoredDesign> others) {
        if (!best_.score.is_within) return {};
        std::vector<std::vector<double>> designs;
        for (const auto& other : others) {
            if (!(other.merit < best_.merit) && other.score.is_within) continue;
            for (int part = 1; part < line_parts; ++part) {
                auto& design = designs.emplace_back();
                for (std::size_t k = 0; k < problem_.variables.size(); ++k) {
                    const auto& v = problem_.variables[k];
                    const double from = v.position(best_.values[k]), to = v.position(other.values[k]);
                    design.push_back(v.value(from + (to - from) * part / line_parts));
                }
            }
        }
        return take_best_of(TRY(score_all(designs)));
    }

    /// Rounds of local searches, until no case outside the active ones fails for the best designs.
    Result<void> search_rounds() {
        auto starts = TRY(starting_designs());
        for (double step = first_step; out_.rounds < settings_.rounds && !out_.is_settled; step = std::max(step / 2, shortest_step)) {
            const auto found = TRY(search_from(starts, step));
            auto designs = TRY(score_all(found));
            ++out_.rounds;
            std::ranges::sort(designs, is_better);
            std::size_t failing = 0;
            const double merit_before = best_.merit;
            const auto kept = std::span(designs).first(std::min(kept_designs, designs.size()));
            for (const auto& d : kept)
                if (!d.score.is_within) failing += activate(d, std::max<std::size_t>(settings_.cases / 2, 1), true);
            TRY(take_best_of(designs));
            TRY(search_between(kept));
            out_.is_settled = failing == 0 && !(merit_before - best_.merit > settled_gain * std::abs(best_.merit));
            starts = {best_.values};
            for (const auto& d : designs)
                if (starts.size() < kept_designs + 1 && d.values != best_.values) starts.push_back(d.values);
        }
        return {};
    }

    /// The effect of a step of each variable away from the best design.
    Result<void> probe() {
        const auto steps = steps_from(problem_, best_.values);
        std::vector<std::vector<double>> designs;
        for (const auto& s : steps) designs.push_back(s.design);
        const auto scored_designs = TRY(score_all(designs));
        out_.limits = variable_limits(problem_, best_, steps, scored_designs);
        return {};
    }

public:
    DesignSearch(OptimizationProblem& problem, DesignEvaluator& evaluator)
        : problem_(problem), evaluator_(evaluator), settings_(problem.search), all_(problem.cases.size()) {
        std::iota(all_.begin(), all_.end(), std::size_t{0});
    }

    Result<OptimizationResult> run() {
        auto first = TRY(score_all({problem_.start()}));
        if (const double goal = std::abs(first[0].score.goal); goal > 0) reference_ = goal;  // false for NaN
        out_.start = scored(problem_.start(), first[0].cases), best_ = out_.start;
        active_ = {0};
        // The yield needs all chips; other goals begin with the most critical cases.
        if (problem_.goal.kind == DesignGoal::Kind::yield) active_ = all_;
        if (problem_.goal.over != DesignGoal::Over::first)
            for (std::size_t c = 1; c < problem_.condition_count; ++c) active_.push_back(c);
        activate(out_.start, settings_.cases - 1, false);
        TRY(search_rounds());
        TRY(probe());
        out_.active_cases = active_.size();
        out_.found = std::move(best_);
        out_.simulated = evaluator_.simulated(), out_.reused = evaluator_.reused();
        return std::move(out_);
    }
};

/// The largest number of simulations of a search, for its progress.
double max_simulations(const OptimizationProblem& problem) {
    const auto& s = problem.search;
    const auto all = static_cast<double>(problem.cases.size()), active = std::min(static_cast<double>(s.cases), all);
    const auto variables = static_cast<double>(problem.variables.size());
    const auto starts = static_cast<double>(s.starts), rounds = static_cast<double>(s.rounds),
               evaluations = static_cast<double>(s.evaluations);
    const double later = (rounds - 1) * (kept_designs + 1) * evaluations * std::min(2 * active, all);
    return all * (1 + starts + rounds * (kept_designs * (line_parts - 1) + shifted_designs) + (rounds - 1) * (kept_designs + 1) +
                  2 * variables) +
           active * (static_cast<double>(s.points) + starts * evaluations) + later;
}

}  // namespace

Result<OptimizationResult> optimize_design(OptimizationProblem& problem, SweepResults* results, const SearchCallbacks& callbacks) {
    EvaluatorOptions options{callbacks.threads, callbacks.should_stop, {}};
    const double max = max_simulations(problem);
    options.on_progress = [&](std::size_t simulations) { callbacks.on_progress(std::min(1.0, static_cast<double>(simulations) / max)); };
    const auto evaluator = TRY(DesignEvaluator::make(problem, results, options));
    return DesignSearch(problem, *evaluator).run();
}

}  // namespace corpuscle::optimize
