// corpuscle respond: plans a run from the arguments, opens its outputs, simulates it, and writes and prints the result.

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "cli/respond/channel_run.hpp"
#include "cli/respond/skin_run.hpp"
#include "cli/respond/trial_table.hpp"
#include "run/population_exceptions.hpp"
#include "run/sink.hpp"
#include "run/trials/trial_option_group.hpp"

namespace corpuscle {
namespace {

/// Collects the spikes of every afferent for the JSON document on standard output.
class SpikeTimes final : public Sink {
    struct Train {
        std::string afferent, channel;
        std::vector<double> times = {};  // s, on the clock of the input
    };
    std::vector<Train> trains_;  // of all afferents of all inputs
    std::string input_name_;
    bool is_skin_ = false;
    std::size_t count_ = 0;  // spikes of all afferents

    void add(const Input&, std::span<const Spike>);

public:
    static constexpr std::size_t max_spikes = 10'000'000;  ///< of a skin; if there are more, document() is null

    Result<void> begin(const Input&) override;
    Result<void> block(const Input& input, const RunBlock& block) override { return add(input, block.spikes), Result<void>(); }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike> last) override { return add(input, last), Result<void>(); }
    /// True if a skin had more spikes than max_spikes.
    bool is_over_limit() const { return is_skin_ && count_ > max_spikes; }
    const std::string& input_name() const { return input_name_; }  ///< of the last input
    /// An array with afferent, channel and times_s of each afferent, of a skin only those that fired, named as in spikes.csv. null if there
    /// are too many spikes.
    nlohmann::ordered_json document() const;
};

Result<void> SpikeTimes::begin(const Input& input) {
    input_name_ = input.name, is_skin_ = input.population.skin() != nullptr;
    for (std::size_t u = 0; u < input.population.size(); ++u)
        trains_.push_back({input.population.afferent_name(u), input.population.channel_name(u)});
    return {};
}

void SpikeTimes::add(const Input& input, std::span<const Spike> spikes) {
    count_ += spikes.size();
    if (is_over_limit()) return trains_.clear();
    for (const auto& s : spikes) trains_[s.afferent_index].times.push_back(input.clock.time(s.step, s.offset));
}

nlohmann::ordered_json SpikeTimes::document() const {
    if (is_over_limit()) return nullptr;
    auto out = nlohmann::ordered_json::array();
    for (const auto& train : trains_)
        if (!is_skin_ || !train.times.empty())
            out.push_back({{"afferent", train.afferent}, {"channel", train.channel}, {"times_s", train.times}});
    return out;
}

/// Returns an error, with the reason and a remedy, for an option that does not apply to this kind of population.
Result<void> check_population_options(const RespondArguments& args, const CommonArguments& common) {
    const auto kind = args.population.empty() ? PopulationKind::channels : PopulationKind::skin;
    for (const auto& typed : common.typed)
        if (const auto* exception = find_exception(kind, typed.name)) return exception_error(*exception);
    return {};
}

Result<std::unique_ptr<PlannedRun>> plan_run(const RespondArguments& args, const CommonArguments& common, Ranks* ranks) {
    std::unique_ptr<PlannedRun> run;
    if (args.population.empty())
        run = std::make_unique<ChannelRun>(args, common);
    else
        run = std::make_unique<SkinRun>(args, common, ranks);
    TRY(run->plan());
    TRY(run->plan_trials());
    return run;
}

/// Simulates the run with a progress bar.
Result<RunStats> simulate_run(PlannedRun& run, std::span<Sink* const> sinks, const std::string& checkpoint, std::uint32_t threads,
                              bool quiet) {
    ThreadPool pool(threads);
    auto simulators = TRY(run.simulators());
    auto options = run.options();
    options.pool = &pool;
    Progress progress(quiet);
    options.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    auto stats = corpuscle::run(std::move(simulators), sinks, options);
    if (stats || stats.error().code != ErrorCode::interrupted || checkpoint.empty()) return stats;
    return Error{ErrorCode::interrupted, fmt::format("interrupted; the same command resumes from {}", checkpoint)};
}

void print_result(const PlannedRun& run, const RunOutputs& outputs, nlohmann::ordered_json document, const SpikeTimes& times,
                  const CommonArguments& common) {
    if (common.json && times.is_over_limit())
        print_warning(fmt::format("{}: more than {} million spikes, which are too many for --json; --out DIR writes them to spikes.csv",
                                  times.input_name(), SpikeTimes::max_spikes / 1'000'000));
    if (common.json) {
        document["spikes"] = times.document();
        if (run.trials()) document["trials"] = run.trials()->document(run.trial_bin());
        fmt::print("{}\n", json_text(document));
    } else if (!common.quiet) {
        print_text(run.table() + (run.trials() ? trial_table(*run.trials()) : "") + outputs.written_text());
    }
}

/// Simulates a planned run, and writes and prints its result.
Result<void> respond_with(PlannedRun& run, const OutputArguments& args, std::uint32_t threads, const CommonArguments& common) {
    RunOutputs outputs;
    TRY(outputs.open(args, run, common));
    SpikeTimes times;
    auto sinks = run.summaries();
    if (run.trials()) sinks.push_back(run.trials());
    outputs.add_sinks(sinks);
    if (common.json) sinks.push_back(&times);
    const auto stats = TRY(simulate_run(run, sinks, args.checkpoint, threads, common.quiet));
    auto document = run.summarize(stats);
    if (run.trials()) {
        TRY(run.trials()->responses.histograms(run.trial_bin(), run.trials()->options().window));  // too many bins are an error
        if (!common.quiet)
            for (const auto& note : run.trials()->notes) print_message(note);
        document["trials"] = run.trials()->document();
    }
    document["files"] = outputs.file_names();
    TRY(outputs.commit(run, document));
    const auto finished = run.finish(stats);
    print_result(run, outputs, std::move(document), times, common);
    return finished;
}

/// With --probe, the probes are recorded in probes.csv or on the report page.
Result<void> request_probes(RespondArguments& args) {
    if (args.netlists.probes.empty()) return {};
    if (args.outputs.directory.empty() && !args.outputs.page)
        return bad_usage(fmt::format("--probe {} needs --out DIR or --report", args.netlists.probes[0]));
    if (!args.outputs.directory.empty()) args.outputs.formats.try_emplace("--probe-files");  // as if the user had given it
    return {};
}

/// Prints an error; under mpirun in one process only. Returns the exit status.

}  // namespace

Result<std::unique_ptr<ForceSource>> PlannedRun::open_source(const ForceArgument& force, double rate) {
    auto recording = args_.recording;
    Progress progress(common_.quiet);
    recording.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    auto source = TRY(force.open(recording, overrides_, rate, options_.seed));
    keep_unused(unused_, source.unused);
    return std::move(source.result);
}

Result<void> PlannedRun::plan_trials() {
    if (!args_.trials.is_used()) return check_trial_options(args_.trials);
    if (!args_.outputs.checkpoint.empty())
        return bad_usage("--checkpoint cannot be used with trials, which need the complete run; remove it, or --trials, --align and --window");
    TRY(check_trial_options(args_.trials));
    trials_ = TRY(make_trial_collector(args_.trials));
    return {};
}

double PlannedRun::trial_bin() const {
    const auto bin = args_.outputs.formats.find("--bin");
    return bin == args_.outputs.formats.end() ? trials_->responses.default_bin(args_.trials.window) : *parse_quantity(bin->second, "s");
}

int respond(const RespondArguments& given, const CommonArguments& common) {
    catch_interrupt();
    auto args = given;
    if (auto ok = check_population_options(args, common); !ok) return report_error_once(ok.error());
    if (auto ok = check_recording_arguments(common, args.forces); !ok) return report_error_once(ok.error());
    if (auto ok = request_probes(args); !ok) return report_error_once(ok.error());
    auto ranks = args.population.empty() ? Result<std::unique_ptr<Ranks>>(nullptr) : Ranks::join();
    if (!ranks) return report_error_once(ranks.error());
    auto* const group = ranks->get();
    if (group && group->rank() > 0) {
        auto quiet = common;
        quiet.quiet = true;
        const auto worked = without_exceptions([&]() -> Result<void> { return SkinRun(args, quiet, group).work(), Result<void>(); });
        if (!worked) group->send_error(worked.error());
        return 0;
    }
    const auto threads = group ? std::max(1U, args.threads) : args.threads;
    const auto respond_here = [&]() -> Result<void> {
        const auto run = TRY(plan_run(args, common, group));
        return respond_with(*run, args.outputs, threads, common);
    };
    const auto done = group ? without_exceptions(respond_here) : respond_here();
    if (done) return 0;
    const int code = report_error(done.error());
    if (group) group->abort(code);
    return code;
}

}  // namespace corpuscle
