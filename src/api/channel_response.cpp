// The response of afferents on channels.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/response_parts.hpp"
#include "report/respond/respond_report.hpp"
#include "run/afferent_details.hpp"
#include "run/channels/channel_outcome.hpp"

namespace corpuscle::api {
namespace {

/// The number of threads of a run. `samples`: of the force, over all channels; 0 if unknown. A short run of equations takes less time than
/// the start of a thread.
unsigned threads_for(const Simulation& simulation, std::span<const AfferentPlan> plans, std::size_t samples) {
    constexpr std::size_t short_run = 20'000;  // afferents times samples: some 0.2 ms
    const bool is_short = samples > 0 && samples < short_run && plans.size() * samples < short_run &&
                          std::all_of(plans.begin(), plans.end(), [](const AfferentPlan& p) { return p.traits().can_use_lanes; });
    return is_short ? 1 : simulation.threads;
}

ChannelPlan plan_of(const Simulation& simulation, Settings& settings, const ForceSource& source) {
    value_or_throw(check_afferent_count(simulation.afferents.size(), simulation.copies, source.channels().size()));
    const auto spreads = value_or_throw(parse_overrides(simulation.spreads));
    auto plan = value_or_throw(plan_channels({.afferents = simulation.afferents,
                                              .overrides = settings.all,
                                              .copies = simulation.copies,
                                              .spreads = spreads,
                                              .seed = simulation.seed}));
    keep_unused(settings.unused, plan.unused);
    std::vector<std::string_view> names = {source.name()};
    for (const auto& a : plan.afferents) names.push_back(a.name);
    value_or_throw(check_all_used(settings.unused, names));
    return plan;
}

/// The sink of the report; null if there is none.
std::shared_ptr<RespondReport> make_report(const Simulation& simulation, const ChannelPlan& plan) {
    if (simulation.report == ReportDetail::none) return nullptr;
    const bool is_brief = simulation.report == ReportDetail::brief;
    return std::make_shared<RespondReport>(is_brief ? RespondReport::max_brief_points : RespondReport::max_total_points, plan.copies,
                                           !simulation.single_precision);
}

/// Sets the functions of a response, which keep the outcome.
void set_functions(Response& response, const std::shared_ptr<const ChannelOutcome>& outcome,
                   const std::shared_ptr<const RespondReport>& report, ReportDetail detail) {
    response.silence_notes = [outcome] { return outcome->silence_notes(outcome->silent_classes()); };
    response.summary = [outcome] { return outcome->document(outcome->silent_classes()).dump(); };
    if (!report) return;
    const auto max_bytes = detail == ReportDetail::brief ? RespondReport::max_brief_bytes : RespondReport::unlimited;
    response.report = [outcome, report, max_bytes](const std::string& command) {
        const auto costs = outcome->document({}).value("costs", nlohmann::ordered_json::array());
        return report->page(outcome->summary, outcome->afferents, command, outcome->warnings, costs, max_bytes);
    };
}

}  // namespace

Response respond_on_channels(ForceInput input, const Simulation& simulation, Settings& settings) {
    const std::array sources{std::move(input.source)};
    auto plan = plan_of(simulation, settings, *sources[0]);
    ThreadPool pool(threads_for(simulation, plan.simulated, input.samples));
    const auto options = options_of(simulation, pool);
    const auto outcome = std::make_shared<ChannelOutcome>(plan, options);
    const auto report = make_report(simulation, plan);
    Response out;
    SpikeCollector spikes(out);
    auto sinks = outcome->sinks();
    sinks.push_back(&spikes);
    if (report) sinks.push_back(report.get());
    outcome->start(sources);
    auto stats = value_or_throw(run(sources, plan.simulated, sinks, options));
    if (!stats.diverged.empty()) throw_error(stats.diverged[0]);
    outcome->finish(sources, stats);
    out.notes = outcome->notes, out.warnings = outcome->warnings;
    set_functions(out, outcome, report, simulation.report);
    out.models = [plans = std::make_shared<const std::vector<AfferentPlan>>(std::move(plan.simulated)), count = out.afferents.size()] {
        PlanTable table{*plans, std::vector<std::uint32_t>(count)};
        for (std::size_t u = 0; u < count; ++u) table.plan_of[u] = static_cast<std::uint32_t>(u % plans->size());
        return models_of(details_of(table));
    };
    return out;
}

}  // namespace corpuscle::api
