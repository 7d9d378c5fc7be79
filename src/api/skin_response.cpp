// The response of a skin.

#include <nlohmann/json.hpp>

#include "api/response_parts.hpp"
#include "report/skin/skin_report.hpp"
#include "run/afferent_details.hpp"
#include "run/skin/skin_outcome.hpp"
#include "run/skin/skin_simulator.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle::api {
namespace {

SkinScene scene_of(const ForceInput& input, const Simulation& simulation, Settings& settings) {
    auto scene = value_or_throw(SkinScene::make({.population = simulation.population,
                                                 .contact = simulation.contact,
                                                 .taxels = simulation.taxels,
                                                 .touch = input.touch,
                                                 .overrides = settings.all,
                                                 .seed = simulation.seed},
                                                *input.source));
    keep_unused(settings.unused, scene.unused);
    value_or_throw(check_all_used(settings.unused, override_targets(scene.innervation->plan, {"contact", input.source->name()})));
    return scene;
}

/// The sink of the report; null if there is none.
std::shared_ptr<SkinReport> make_report(ReportDetail detail) {
    if (detail == ReportDetail::none) return nullptr;
    return std::make_shared<SkinReport>(detail == ReportDetail::brief ? brief_skin_report : SkinReportLimits{});
}

/// Collects the total force on the skin.
class TotalForceCollector final : public Sink {
    Force& to_;

public:
    explicit TotalForceCollector(Force& to) : to_(to) {}
    Result<void> begin(const Input& input) override {
        to_.name = input.name, to_.rate = input.clock.rate(), to_.start = input.clock.t0;
        to_.channels = input.population.force_names(), to_.samples.resize(1);
        return {};
    }
    Result<void> block(const Input&, const RunBlock& block) override {
        to_.samples[0].insert(to_.samples[0].end(), block.force[0].begin(), block.force[0].end());
        return {};
    }
    Result<void> end(const Input&, std::int64_t, std::span<const Spike>) override { return {}; }
};

/// Sets the functions of a response, which keep the outcome.
void set_functions(Response& response, const std::shared_ptr<const SkinOutcome>& outcome, const std::shared_ptr<const SkinReport>& report) {
    response.silence_notes = [] { return std::vector<std::string>(); };  // they are among the notes
    response.summary = [outcome] { return outcome->document().dump(); };
    if (!report) return;
    response.report = [outcome, report](const std::string& command) {
        return skin_page(outcome->summary, *report, outcome->options, outcome->notes, command);
    };
}

}  // namespace

Response respond_of_skin(ForceInput input, const Simulation& simulation, Settings& settings) {
    const auto scene = scene_of(input, simulation, settings);
    auto& source = *input.source;
    ThreadPool pool(simulation.threads);
    const auto options = options_of(simulation, pool);
    SkinPopulation population(*scene.innervation, input.name);
    const auto skin = value_or_throw(Skin::make(scene.innervation, options.for_clock(source.clock()), value_or_throw(instruction_set())));
    std::vector<std::unique_ptr<BlockSimulator>> inputs;
    inputs.push_back(std::make_unique<SkinSimulator>(population, make_input(population, input.name, source), *scene.force, *skin));
    const auto outcome = std::make_shared<SkinOutcome>(scene, options);
    const auto report = make_report(simulation.report);
    Response out;
    SpikeCollector spikes(out);
    auto sinks = outcome->sinks();
    sinks.push_back(&spikes);
    if (report) sinks.push_back(report.get());
    const auto force = std::make_shared<Force>();
    TotalForceCollector collector(*force);
    if (input.is_named) sinks.push_back(&collector);
    const auto stats = value_or_throw(run(std::move(inputs), sinks, options));
    if (input.is_named) out.skin_force = force;
    outcome->finish(source, scene, stats, {simulation.population, input.has_unit});
    out.notes = outcome->notes.notes, out.warnings = outcome->notes.warnings;
    set_functions(out, outcome, report);
    out.models = [skin = scene.innervation] { return models_of(details_of(value_or_throw(SkinPopulation(*skin).plan_table()))); };
    return out;
}

}  // namespace corpuscle::api
