#pragma once
// The outcome of a run of afferents on channels: its summary, notes and warnings, the same for the command line and for programs.

#include "run/channels/channel_plan.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/silent_afferents.hpp"

namespace corpuscle {

class ChannelOutcome {
public:
    using Sources = std::span<const std::unique_ptr<ForceSource>>;

    std::vector<AfferentPlan> afferents = {};  ///< as requested, without copies
    CopySpec copies = {};
    RespondOptions options = {};
    RunSummary summary = {};
    RunStats stats = {};
    /// About sources and response; each note begins with the name of its source.
    std::vector<std::string> notes = {}, warnings = {};

    ChannelOutcome(const ChannelPlan&, const RespondOptions&);
    /// The sinks that the run must have.
    std::vector<Sink*> sinks() { return {&summary, &silence_}; }
    /// Adds the notes and warnings that are known before the run.
    void start(Sources);
    /// Adds those that are known after the run.
    void finish(Sources, const RunStats&);

    // The following are valid after finish().
    /// The afferents that never fired. Each is simulated some ten times, to find the force that it needs.
    std::vector<SilentClass> silent_classes() const { return silence_.silent_classes(options); }
    /// Notes about them.
    std::vector<std::string> silence_notes(std::span<const SilentClass>) const;
    /// The document of summary.json, without its list of files.
    nlohmann::ordered_json document(std::span<const SilentClass>) const;

private:
    SilenceDetector silence_ = {};

    void add_quality();
    void add_sensor_noise_warnings(Sources);
    void add_rate_warnings(double T);
};

}  // namespace corpuscle
