#pragma once
// The common parts of runs on channels and in a skin.

#include "api/result.hpp"
#include "core/force_source.hpp"
#include "core/parameter_override.hpp"
#include "corpuscle/respond.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

struct NamedTouch;
struct AfferentDetails;

namespace api {

/// The settings of a simulation, and those that nothing has used so far.
struct Settings {
    std::vector<ParameterOverride> all, unused;
    explicit Settings(const Simulation& simulation) : all(value_or_throw(parse_overrides(simulation.settings))), unused(all) {}
};

/// The force of a run. `name` is that of a touch, if it is one.
struct ForceInput {
    std::unique_ptr<ForceSource> source;
    std::string name;
    const NamedTouch* touch = nullptr;
    bool is_named = false;    ///< a stimulus or touch, not a force of the caller
    bool has_unit = false;    ///< the unit of a recording was given
    std::size_t samples = 0;  ///< over all channels; 0 if unknown
};

Response respond_on_channels(ForceInput, const Simulation&, Settings&);
Response respond_of_skin(ForceInput, const Simulation&, Settings&);

RespondOptions options_of(const Simulation&, ThreadPool&);

AfferentModels models_of(AfferentDetails);

/// Collects the spikes of a run.
class SpikeCollector final : public Sink {
    Response& to_;

    void add(const Input&, std::span<const Spike>);

public:
    explicit SpikeCollector(Response& to) : to_(to) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input& input, const RunBlock& block) override { return add(input, block.spikes), Result<void>(); }
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;
};

}  // namespace api
}  // namespace corpuscle
