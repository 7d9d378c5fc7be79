#include "corpuscle/fit.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/result.hpp"
#include "core/thread_pool.hpp"
#include "fit/fit_document.hpp"
#include "fit/fit_plan.hpp"
#include "fit/spike_problem.hpp"
#include "fit/targets/target_problem.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

AfferentPlan plan_of(const FitOptions& options) {
    if (options.free.empty() && options.bounds.empty())
        throw InputError("fit: 'free' is required: the parameters to fit, such as k_A and f_B; 'corpuscle list' prints them all");
    if (!(options.hold_out >= 0 && options.hold_out <= 0.9)) throw InputError("fit: hold_out must be from 0 to 0.9");
    if (!(options.tau > 0) || !std::isfinite(options.tau)) throw InputError("fit: tau must be above 0 s");
    if (!std::isfinite(options.delay)) throw InputError("fit: delay must be a finite time");
    if (options.starts < 1 || options.evaluations < 1) throw InputError("fit: starts and evaluations must be at least 1");
    return api::result_or_throw(value_or_throw(plan_to_fit(options.afferent, value_or_throw(parse_overrides(options.settings)))),
                                options.afferent);
}

/// The samples of a view of one channel.
std::vector<double> samples_of(const ForceView& force) {
    if (force.samples.size() != 1)
        throw InputError("fit: '" + force.name + "' has " + std::to_string(force.samples.size()) +
                         " channels; an afferent is fitted to the force of one");
    std::vector<double> out(force.count);
    for (std::size_t k = 0; k < force.count; ++k) {
        out[k] = force.samples[0][static_cast<std::ptrdiff_t>(k) * force.stride];
        if (!std::isfinite(out[k])) throw InputError("fit: the force of sample " + std::to_string(k) + " is not a finite number");
    }
    return out;
}

std::vector<RecordedTrain> trains_of(const FitRecording& recording, double delay) {
    std::vector<RecordedTrain> out;
    for (const auto& times : recording.trains) {
        RecordedTrain train{.name = recording.trains.size() == 1 ? "spikes" : "repetition " + std::to_string(out.size() + 1), .times = times};
        for (double& t : train.times) {
            if (!std::isfinite(t)) throw InputError("fit: a spike time is not a finite number");
            t -= delay;
        }
        std::sort(train.times.begin(), train.times.end());
        out.push_back(std::move(train));
    }
    return out;
}

std::unique_ptr<FitProblem> spike_problem(std::span<const FitRecording> recordings, const FitOptions& options, const AfferentPlan& plan) {
    if (recordings.empty()) throw InputError("fit: there are no data; a force and its spikes are required");
    std::vector<SpikeRecording> all;
    for (const auto& r : recordings) {
        auto clock = value_or_throw(make_clock(r.force.rate));
        clock.t0 = r.force.start;
        all.push_back({.name = r.force.name,
                       .force = samples_of(r.force),
                       .clock = clock,
                       .trains = trains_of(r, options.delay),
                       .spike_file = r.spike_file,
                       .delay = options.delay});
    }
    hold_out(all, options.hold_out);
    return value_or_throw(make_spike_problem(std::move(all), {.tau = options.tau, .is_irregular = plan.traits().is_irregular}));
}

AfferentFit result_of(const FitResult& result, const FitProblem& problem) {
    AfferentFit out{.afferent = result.plan.name,
                    .parameters = {},
                    .start_score = result.start_score,
                    .score = result.score,
                    .test_score = result.test_score,
                    .settings = fitted_settings(result),
                    .is_interrupted = result.is_interrupted,
                    .warnings = result.warnings,
                    .document = document_of(result, problem.score_meaning()).dump(),
                    .settings_file = settings_file(result, "corpuscle fit afferent")};
    for (const auto& p : result.parameters)
        out.parameters.push_back({.name = p.parameter.name,
                                  .unit = p.parameter.unit,
                                  .start = p.parameter.start,
                                  .value = p.value,
                                  .low = p.low,
                                  .high = p.high,
                                  .is_at_bound = p.is_at_bound});
    return out;
}

AfferentFit search(const FitProblem& problem, const AfferentPlan& plan, const FitOptions& options) {
    const auto parameters = value_or_throw(free_parameters(plan, options.free, options.bounds));
    ThreadPool pool(options.threads);
    SearchOptions searching{
        .points = options.points, .starts = options.starts, .evaluations = options.evaluations, .seed = options.seed};
    if (options.progress) searching.should_continue = options.progress;
    return result_of(value_or_throw(fit(problem, plan, parameters, pool, searching)), problem);
}

}  // namespace

AfferentFit fit_afferent(std::span<const FitRecording> recordings, const FitOptions& options) {
    const auto plan = plan_of(options);
    return search(*spike_problem(recordings, options, plan), plan, options);
}

AfferentFit fit_targets(const std::string& path, const FitOptions& options) {
    const auto plan = plan_of(options);
    constexpr double default_rate = 10e3;  // Hz
    const double rate = options.rate == 0 ? std::max(default_rate, plan.min_rate) : options.rate;
    const auto problem = value_or_throw(make_target_problem(value_or_throw(read_targets(path)),
                                                            {.rate = rate, .seed = options.seed, .hold_out = options.hold_out}));
    return search(*problem, plan, options);
}

}  // namespace corpuscle
