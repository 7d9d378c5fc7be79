// corpuscle respond: opens sources, afferents and outputs from the arguments, runs the simulation and prints the result.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/arguments/force_argument.hpp"
#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/implementations_table.hpp"
#include "cli/output/printable.hpp"
#include "cli/output/respond_outputs.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "run/afferent_plan.hpp"
#include "run/summary/nerve_limit.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/silent_afferents.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;             // Hz, sample rate of stimuli
constexpr std::size_t max_rows = 60;              // of the printed table of measures
constexpr std::size_t max_rows_with_silent = 24;  // longer tables omit afferents without spikes

/// A simulation, prepared from the arguments.
struct Job {
    std::vector<ParameterOverride> overrides;
    std::vector<AfferentPlan> afferents;  // the afferents of --afferent
    CopySpec copy_spec;
    std::vector<AfferentPlan> copies;  // the simulated afferents: all copies, or without --copies the afferents themselves
    std::vector<std::unique_ptr<ForceSource>> sources;
    RespondOptions options;
    std::vector<std::string> warnings;
};

Result<std::vector<ParameterOverride>> spread_overrides(const RespondArguments& args) {
    if (args.copies == 0 && !args.spreads.empty())
        return bad_usage(fmt::format("--spread {} needs --copies N, such as --copies 100", args.spreads[0]));
    std::vector<ParameterOverride> overrides;
    for (const auto& text : args.spreads) {
        auto parsed = parse_override(text);
        if (!parsed) return bad_usage(fmt::format("--spread '{}': write NAME.PARAMETER=DEVIATION, such as 'sa1.f_B=10%'", text));
        overrides.push_back(std::move(*parsed));
    }
    return overrides;
}

/// The overrides with their parameter names in lower case, as the parameters of netlists are.
std::vector<ParameterOverride> in_lower_case(std::vector<ParameterOverride> overrides) {
    for (auto& entry : overrides) entry.parameter = lower(entry.parameter);
    return overrides;
}

/// Fills in job.copies and job.copy_spec.
Result<void> populate(Job& job, const RespondArguments& args) {
    const auto overrides = spread_overrides(args);
    if (!overrides) return overrides.error();
    job.copy_spec.count = args.copies;
    if (args.copies == 0) job.copies = job.afferents;
    for (std::size_t a = 0; args.copies > 0 && a < job.afferents.size(); ++a) {
        const auto afferent_overrides = job.afferents[a].factory ? in_lower_case(*overrides) : *overrides;
        auto spreads = distributions_for(job.afferents[a], args.afferents[a], afferent_overrides);
        for (std::size_t k = 0; k < afferent_overrides.size(); ++k) (*overrides)[k].is_used |= afferent_overrides[k].is_used;
        if (!spreads) return spreads.error();
        auto copies = make_copies(job.afferents[a], args.copies, *spreads, args.seed);
        if (!copies) return copies.error();
        for (auto& copy : *copies)
            if (auto ok = rebuild_copy(copy, job.afferents[a]); !ok) return ok;
        std::move(copies->begin(), copies->end(), std::back_inserter(job.copies));
        std::move(spreads->begin(), spreads->end(), std::back_inserter(job.copy_spec.distributions));
    }
    std::vector<std::string_view> names;
    for (const auto& a : job.afferents) names.push_back(a.name);
    for (const auto& entry : *overrides)
        if (!entry.is_used)
            return bad_usage(fmt::format("--spread {}: there is no afferent '{}' in this run{}", entry.text(), entry.target,
                                         did_you_mean(entry.target, names)));
    return {};
}

/// Returns an error if there are more afferents than 32-bit indexes.
Result<void> check_afferent_count(const Job& job) {
    std::uint64_t count = 0;
    for (const auto& s : job.sources) count += s->channels().size() * job.copies.size();
    if (count <= std::numeric_limits<std::uint32_t>::max()) return {};
    return bad_usage(
        fmt::format("--copies {}: {} afferents over all channels are too many; use fewer copies or channels", job.copy_spec.count, count));
}

/// Returns an error if an override was not applied to any afferent or stimulus.
Result<void> check_overrides(const Job& job) {
    std::vector<std::string_view> names;
    for (const auto& a : job.afferents) names.push_back(a.name);
    for (const auto& s : job.sources) names.push_back(s->name());
    for (const auto& entry : job.overrides)
        if (!entry.is_used)
            return bad_usage(fmt::format("--set {}: there is no afferent or stimulus '{}' in this run{}", entry.text(), entry.target,
                                         did_you_mean(entry.target, names)));
    return {};
}

/// Returns an error if there is a netlist option but no netlist, or if no netlist has one of the probes.
Result<void> check_netlist_options(const NetlistArguments& args, const NetlistOptions& netlist_options) {
    if (const auto option = first_netlist_option(args); !option.empty() && !netlist_options.is_used)
        return bad_usage(fmt::format("{}: there is no netlist in this run; try --afferent sa1-circuit", option));
    for (std::size_t k = 0; k < netlist_options.probes.size(); ++k)
        if (!netlist_options.probe_found[k])
            return bad_input(fmt::format("--probe {}: no netlist of this run has such a node or device{}", netlist_options.probes[k],
                                         netlist_options.probe_hint));
    return {};
}

Result<void> plan_afferents(Job& job, const RespondArguments& args) {
    const NetlistOptions netlist_options{netlist_overrides(args.netlists), probe_names(args.netlists)};
    for (const auto& name : args.afferents) {
        auto plan = plan_any_afferent(name, job.overrides, netlist_options);
        if (!plan) return plan.error();
        if (std::any_of(job.afferents.begin(), job.afferents.end(), [&](const auto& a) { return a.name == plan->name; }))
            return bad_usage(fmt::format("--afferent {}: given twice", name));
        job.afferents.push_back(std::move(*plan));
    }
    return check_netlist_options(args.netlists, netlist_options);
}

/// Prepares the simulation: reads the options, plans the afferents and opens the sources.
Result<Job> prepare(const RespondArguments& args, bool quiet) {
    Job job;
    if (args.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    for (const auto& text : args.settings) {
        auto parsed = parse_override(text);
        if (!parsed) return parsed.error();
        job.overrides.push_back(std::move(*parsed));
    }
    if (auto ok = plan_afferents(job, args); !ok) return ok.error();
    if (auto ok = populate(job, args); !ok) return ok.error();
    auto options = recording_options(args);
    if (!options) return options.error();
    Progress progress(quiet);
    options->should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    for (const auto& force : args.forces) {
        auto source = open_force(force, *options, job.overrides, default_rate, args.seed);
        if (!source) return source.error();
        job.sources.push_back(std::move(*source));
    }
    if (auto ok = check_overrides(job); !ok) return ok.error();
    if (auto ok = check_recording_arguments(args); !ok) return ok.error();
    if (auto ok = check_afferent_count(job); !ok) return ok.error();
    if (args.vectors && !args.out.empty() &&
        std::all_of(job.afferents.begin(), job.afferents.end(), [](const auto& a) { return a.converter.empty(); }))
        return bad_usage(fmt::format("--vectors: {} has no converter, and so no fixed-point values; try 'adc+{}'", job.afferents[0].name,
                                     job.afferents[0].name));
    job.options.method = args.method == "exact" ? Method::exact : Method::backward_euler;
    job.options.sampled = args.sampled;
    job.options.precision = args.use_float ? Precision::single_precision : Precision::double_precision;
    const auto noise = optional_quantity(args.noise, "A", "--noise");
    if (!noise) return noise.error();
    if (noise->value_or(0) < 0)
        return bad_usage(fmt::format("--noise '{}' is negative; write a standard deviation, such as '50 nA'", *args.noise));
    job.options.noise = noise->value_or(0);
    job.options.seed = args.seed;
    job.warnings = rate_warnings(job.sources, job.afferents);
    for (auto& warning : noise_warnings(job.afferents, job.options.noise)) job.warnings.push_back(std::move(warning));
    return job;
}

std::string cell(const MeasureInfo& m, double x) { return std::isnan(x) ? "-" : fmt::format("{:.{}f}", x, m.decimals); }

/// The cell of measure m in a row: the value of one afferent or, for copies, mean and standard deviation with at least one decimal.
std::string cell(const MeasureRow& row, std::size_t m) {
    if (row.copy_statistics.empty()) return cell(measures[m], row.values[m]);
    const int decimals = std::max(measures[m].decimals, 1);
    const double mean = row.copy_statistics[m].mean(), deviation = row.copy_statistics[m].standard_deviation();
    if (std::isnan(mean)) return "-";
    return fmt::format("{:.{}f}", mean, decimals) + (std::isnan(deviation) ? "" : fmt::format(" +- {:.{}f}", deviation, decimals));
}

/// One line for each input. It shows sample rate, duration and range of force, so that the user notices a wrong unit or rate.
std::string inputs_table(const RunSummary& summary) {
    std::string text;
    for (const auto& i : summary.inputs())
        text += fmt::format("{}: {}{} samples at {}, {}, {:.4g} to {:.4g} N\n", printable(i.name),
                            i.channels.size() == 1 ? "" : fmt::format("{} channels, ", i.channels.size()), i.samples,
                            format_quantity(i.clock.rate(), "Hz"), format_quantity(static_cast<double>(i.samples) * i.clock.T(), "s"),
                            i.min_force + 0.0, i.max_force + 0.0);  // no -0
    return text;
}

std::string copies_line(const CopySpec& spec) {
    if (spec.count == 0) return "";
    return spec.count == 1
               ? "1 copy of each afferent\n"
               : fmt::format("{} copies of each afferent; mean +- standard deviation over copies that have a value\n", spec.count);
}

/// The table of rates and other measures. A long table omits afferents that did not fire.
std::string rate_table(const RunSummary& summary) {
    std::map<std::pair<std::string, std::string>, double> spikes;  // by afferent and channel, over all phases
    for (const auto& r : summary.rows()) spikes[{r.afferent, r.channel}] += r.values[measure_index<SpikeCount>];
    const bool shows_silent = summary.rows().size() <= max_rows_with_silent;
    std::vector<std::vector<std::string>> rows = {{"afferent", "channel", "phase"}};
    const auto columns = summary.columns();
    for (const auto c : columns) rows[0].push_back(column_heading(measures[c]));
    std::size_t omitted = 0;
    for (const auto& r : summary.rows()) {
        if (!shows_silent && spikes[{r.afferent, r.channel}] == 0) continue;
        if (rows.size() > max_rows) {
            ++omitted;
            continue;
        }
        rows.push_back({r.afferent, r.channel, r.phase});
        for (const auto c : columns) rows.back().push_back(cell(r, c));
    }
    auto text = format_table(rows);
    if (omitted > 0) text += fmt::format("... and {} more rows; --out writes all of them to summary.json\n", omitted);
    const auto silent = std::count_if(spikes.begin(), spikes.end(), [](const auto& s) { return s.second == 0; });
    if (!shows_silent && silent > 0)
        text += fmt::format("Not shown: {} of {} afferents without spikes (counted once per channel).\n", silent, spikes.size());
    return text;
}

/// Prints the warnings that are known before the run and, unless `quiet`, the notes of the sources.
void print_notes(const Job& job, bool quiet) {
    for (const auto& s : job.sources)
        for (const auto& r : quiet ? std::vector<std::string>{} : s->notes()) print_message(fmt::format("{}: {}", s->name(), r));
    for (const auto& warning : job.warnings) print_warning(warning);
}

/// Prints a warning and keeps it for summary and report page.
void warn(Job& job, std::string message) {
    print_warning(message);
    job.warnings.push_back(std::move(message));
}

/// Prints the findings about the quality of the recordings, which are known only after the run.
void print_quality(Job& job, const RunSummary& summary, bool quiet) {
    for (const auto& i : summary.inputs()) {
        for (const auto& s : quiet ? std::vector<std::string>{} : i.quality.descriptions) print_message(fmt::format("{}: {}", i.name, s));
        for (const auto& s : i.quality.warnings) warn(job, fmt::format("{}: {}", i.name, s));
    }
}

/// Warns of afferents that fire faster than a nerve fibre can; for each of them, the warning names the channel with the highest rate.
void warn_of_rates(Job& job, const RunSummary& summary) {
    constexpr auto peak = measure_index<PeakRate>;
    for (const auto& plan : job.afferents) {
        const MeasureRow* fastest = nullptr;
        double rate = max_nerve_rate;
        for (const auto& row : summary.rows())
            if (const double r = row.copy_statistics.empty() ? row.values[peak] : row.copy_statistics[peak].max;
                row.afferent == plan.name && r > rate)
                fastest = &row, rate = r;
        if (fastest) warn(job, fmt::format("{}: on {} {}", plan.name, fastest->channel, excessive_rate_warning(rate, plan, plan.name)));
    }
}

/// The number of simulated netlists: one for each copy on each channel of each source.
std::size_t netlist_count(const Job& job) {
    std::size_t count = 0;
    for (const auto& s : job.sources)
        for (const auto& a : job.copies) count += a.factory ? s->channels().size() : 0;
    return count;
}

/// Collects the spikes of every afferent for the JSON document on standard output.
class SpikeTimes final : public ResponseSink {
    nlohmann::ordered_json trains_ = nlohmann::ordered_json::array();
    std::size_t first_ = 0;  // index in trains_ of the first train of the current input

public:
    Result<void> begin(const Input& input) override {
        first_ = trains_.size();
        for (std::size_t u = 0; u < input.afferent_count(); ++u)
            trains_.push_back({{"afferent", input.plan_of(u).name},
                               {"channel", input.channel_name(input.channel_of(u))},
                               {"times_s", nlohmann::ordered_json::array()}});
        return {};
    }
    Result<void> block(const Input& input, const RunBlock& response) override {
        for (const auto& s : response.spikes)
            trains_[first_ + s.afferent_index - input.first_afferent]["times_s"].push_back(input.source.clock().time(s.step, s.offset));
        return {};
    }
    const nlohmann::ordered_json& document() const { return trains_; }
};

/// The names of the files that exist once for each input, afferent or channel. They are created during the run.
std::vector<std::string> later_names(const Job& job, const RespondArguments& args) {
    std::vector<std::string> all;
    std::size_t channels = 0;
    for (std::size_t k = 0; k < job.sources.size(); ++k) {
        const auto number = k == 0 ? "" : fmt::format("-{}", k + 1);
        if (args.probe_files) all.push_back(fmt::format("probes{}.csv", number));
        if (args.wav) all.push_back(fmt::format("spikes{}.wav", number));
        channels += job.sources[k]->channels().size();
    }
    for (const auto& a : job.copies) {
        if (!args.vectors || a.converter.empty()) continue;
        all.push_back(fmt::format("rom-{}.csv", a.name));
        for (std::size_t c = 1; c <= channels; ++c)
            all.push_back(fmt::format("vectors-{}{}.csv", a.name, c == 1 ? "" : fmt::format("-{}", c)));
    }
    return all;
}

Result<void> run(const RespondArguments& args, const CommonArguments& common) {
    auto job = prepare(args, common.quiet);
    if (!job) return job.error();
    RespondOutputs outputs;
    OutputCheck check(common.overwrite);
    if (auto ok = outputs.open(args, job->copy_spec, later_names(*job, args), check); !ok) return ok;
    print_notes(*job, common.quiet);

    ThreadPool pool(args.threads);
    job->options.pool = &pool;
    RunSummary summary;
    SilenceDetector silence;
    std::vector<ResponseSink*> sinks = {&summary, &silence};
    outputs.add_sinks(sinks);
    SpikeTimes times;
    if (common.json) sinks.push_back(&times);
    Result<RunStats> stats = [&] {
        Progress progress(common.quiet);
        job->options.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
        return respond(job->sources, job->copies, sinks, job->options);
    }();
    if (!stats) return stats.error();
    print_quality(*job, summary, common.quiet);
    for (const auto& warning : response_warnings(*stats)) warn(*job, warning);
    warn_of_rates(*job, summary);
    const auto silent = silence.silent_afferents(job->copies, job->options);
    for (const auto& s : common.quiet ? std::vector<SilentAfferent>{} : silent) print_message(silence_message(s));
    auto result = summary.document(job->afferents, *stats, job->options, args.seed, job->warnings);
    if (job->copy_spec.count > 0) result["copies"] = document_of(job->copy_spec);
    for (const auto& s : silent)
        result["silent"].push_back({{"afferent", s.name},
                                    {"force_max_N", s.force},
                                    {"factor_to_fire", s.factor ? nlohmann::ordered_json(*s.factor) : nlohmann::ordered_json(nullptr)}});
    const auto costs = result.value("costs", nlohmann::ordered_json::array());
    result["files"] = outputs.file_names();
    const auto document = json_text(result) + "\n";
    if (auto ok = outputs.commit(summary, job->afferents, job->warnings, document, common.command, costs); !ok) return ok;
    if (common.json) result["spikes"] = times.document();
    if (common.json)
        fmt::print("{}\n", json_text(result));
    else if (!common.quiet)
        print_text(inputs_table(summary) + copies_line(job->copy_spec) + rate_table(summary) +
                   implementations_table(summary.comparisons()) + outputs.written_text());
    if (!stats->diverged.empty()) {
        auto error = stats->diverged[0];
        error.message =
            fmt::format("{} of {} netlists did not converge; the first: {}", stats->diverged.size(), netlist_count(*job), error.message);
        return error;
    }
    return {};
}

}  // namespace

int respond(const RespondArguments& given, const CommonArguments& common) {
    if (!given.population.empty()) return respond_skin(given, common);
    catch_interrupt();
    auto args = given;
    // The probes of --probe are recorded in probes.csv or on the report page.
    if (!args.netlists.probes.empty()) {
        if (args.out.empty() && !args.has_report)
            return report_error(
                bad_usage(fmt::format("{} needs --out DIR or --report", first_netlist_option({{}, {}, {}, {}, args.netlists.probes}))));
        args.probe_files |= !args.out.empty();
    }
    const auto done = run(args, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
