// Plans a run of afferents on channels: reads the options, plans the afferents and their copies, and opens the sources.

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <limits>

#include "cli/arguments/force_argument.hpp"
#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "cli/respond/channel_run.hpp"
#include "core/text/ascii_text.hpp"
#include "run/afferent_plan.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;  // Hz, sample rate of stimuli

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
Result<void> populate(ChannelJob& job, const RespondArguments& args) {
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
Result<void> check_afferent_count(const ChannelJob& job) {
    std::uint64_t count = 0;
    for (const auto& s : job.sources) count += s->channels().size() * job.copies.size();
    if (count <= std::numeric_limits<std::uint32_t>::max()) return {};
    return bad_usage(
        fmt::format("--copies {}: {} afferents over all channels are too many; use fewer copies or channels", job.copy_spec.count, count));
}

/// Returns an error if an override was not applied to any afferent or stimulus.
Result<void> check_overrides(const ChannelJob& job) {
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

Result<void> plan_afferents(ChannelJob& job, const RespondArguments& args) {
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

Result<void> open_sources(ChannelJob& job, const RespondArguments& args, bool quiet) {
    auto options = recording_options(args);
    if (!options) return options.error();
    Progress progress(quiet);
    options->should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    for (const auto& force : args.forces) {
        auto source = open_force(force, *options, job.overrides, default_rate, args.seed);
        if (!source) return source.error();
        job.sources.push_back(std::move(*source));
    }
    return {};
}

}  // namespace

Result<ChannelJob> plan_channel_job(const RespondArguments& args, bool quiet) {
    ChannelJob job;
    if (args.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    auto overrides = parse_overrides(args.settings);
    if (!overrides) return overrides.error();
    job.overrides = std::move(*overrides);
    if (auto ok = plan_afferents(job, args); !ok) return ok.error();
    if (auto ok = populate(job, args); !ok) return ok.error();
    if (auto ok = open_sources(job, args, quiet); !ok) return ok.error();
    if (auto ok = check_overrides(job); !ok) return ok.error();
    if (auto ok = check_recording_arguments(args, args.forces); !ok) return ok.error();
    if (auto ok = check_afferent_count(job); !ok) return ok.error();
    if (auto ok = read_run_options(job.options, args); !ok) return ok.error();
    job.warnings = rate_warnings(job.sources, job.afferents);
    for (auto& warning : noise_warnings(job.afferents, job.options.noise)) job.warnings.push_back(std::move(warning));
    return job;
}

}  // namespace corpuscle
