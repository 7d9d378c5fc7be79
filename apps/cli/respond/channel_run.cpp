#include "cli/respond/channel_run.hpp"

#include "cli/output/terminal.hpp"
#include "io/recording/trial_recordings.hpp"
#include "run/summary/grouped_notes.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;  // Hz, sample rate of stimuli

}  // namespace

/// Returns an error if an override was not applied to any afferent or stimulus.
Result<void> ChannelRun::check_overrides() const {
    std::vector<std::string_view> names;
    for (const auto& a : plan_.afferents) names.push_back(a.name);
    for (const auto& s : sources_) names.push_back(s->name());
    return check_all_used(unused_, names);
}

std::size_t ChannelRun::channel_count() const {
    std::size_t count = 0;
    for (const auto& s : sources_) count += s->channels().size();
    return count;
}

/// Opens each trial of a recording as a source.
Result<void> ChannelRun::open_trials(const ForceArgument& force) {
    if (force.is_stimulus) return bad_usage(fmt::format("--by {}: {} is a stimulus, which has no columns", args_.trials.by[0], force.text));
    auto recording = args_.recording;
    recording.should_continue = [](double) { return !interrupted(); };
    for (auto& trial : TRY(open_trial_recordings(force.path(), recording, {args_.trials.by, args_.trials.label})))
        sources_.push_back(std::move(trial.source)), labels_.push_back(std::move(trial.label));
    return {};
}

Result<void> ChannelRun::open_sources() {
    for (const auto& force : args_.forces)
        if (args_.trials.by.empty())
            sources_.push_back(TRY(open_source(force, default_rate)));
        else
            TRY(open_trials(force));
    return {};
}

Result<void> ChannelRun::plan_trials() {
    TRY(PlannedRun::plan_trials());
    if (trials_) trials_->input_labels = labels_;
    return {};
}

Result<void> ChannelRun::plan() {
    if (args_.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    overrides_ = args_.netlists.overrides;  // first, so that a setting for one netlist takes precedence
    overrides_.insert(overrides_.end(), args_.settings.begin(), args_.settings.end());
    plan_ = TRY(plan_channels({.afferents = args_.afferents,
                               .overrides = overrides_,
                               .probes = args_.netlists.probes,
                               .copies = args_.copies,
                               .spreads = args_.spreads,
                               .seed = options_.seed}));
    unused_ = plan_.unused;
    TRY(open_sources());
    TRY(check_overrides());
    TRY(check_afferent_count(plan_.afferents.size(), args_.copies, channel_count()));
    outcome_.emplace(plan_, options_);
    outcome_->start(sources_);
    return {};
}

OutputRequest ChannelRun::output_request() const {
    return {.inputs = sources_.size(), .channels = channel_count(), .plans = plan_.simulated, .copies = plan_.copies};
}

Sink& ChannelRun::start_report() {
    const bool is_float = options_.precision == Precision::single_precision;  // records no probes
    return report_.emplace(RespondReport::max_total_points, plan_.copies, !is_float, !trials_);
}

/// Also prints the notes and warnings that are known before the run.
Result<std::vector<std::unique_ptr<BlockSimulator>>> ChannelRun::simulators() {
    print_new_notes();
    return make_channel_simulators(sources_, plan_.simulated);
}

/// Prints the notes and warnings that have not been printed.
void ChannelRun::print_new_notes() {
    const auto &notes = outcome_->notes, &warnings = outcome_->warnings;
    for (const auto& note : grouped_notes(std::span(notes).subspan(std::exchange(printed_notes_, notes.size()))))
        if (!common_.quiet) print_message(note);
    for (const auto& warning : grouped_notes(std::span(warnings).subspan(std::exchange(printed_warnings_, warnings.size()))))
        print_warning(warning);
}

nlohmann::ordered_json ChannelRun::summarize(const RunStats& stats) {
    outcome_->finish(sources_, stats);
    print_new_notes();
    const auto silent = outcome_->silent_classes();
    for (const auto& note : outcome_->silence_notes(silent))
        if (!common_.quiet) print_message(note);
    return outcome_->document(silent);
}

std::string ChannelRun::page(const nlohmann::ordered_json& document) const {
    const auto costs = document.value("costs", nlohmann::ordered_json::array());
    return report_->page(outcome_->summary, plan_.afferents, common_.command, outcome_->warnings, costs, RespondReport::unlimited,
                         trials_ ? trials_document(*trials_, trial_bin()) : nlohmann::ordered_json());
}

/// The number of simulated netlists: one for each copy on each channel of each source.
std::size_t ChannelRun::netlist_count() const {
    std::size_t count = 0;
    for (const auto& s : sources_)
        for (const auto& a : plan_.simulated) count += a.traits().may_diverge ? s->channels().size() : 0;
    return count;
}

Result<void> ChannelRun::finish(const RunStats& stats) {
    if (stats.diverged.empty()) return {};
    auto error = stats.diverged[0];
    error.message = fmt::format("{} of {} netlists did not converge; the first: {}", stats.diverged.size(), netlist_count(), error.message);
    return error;
}

}  // namespace corpuscle
