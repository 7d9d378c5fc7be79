// Plans a run of afferents on channels: reads the options, plans the afferents and their copies, and opens the sources.

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <limits>

#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/respond/channel_run.hpp"
#include "core/text/ascii_text.hpp"
#include "run/afferent_plan.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;  // Hz, sample rate of stimuli

/// Fills in job.copies and job.copy_spec.
Result<void> populate(ChannelJob& job, const RespondArguments& args) {
    if (args.copies == 0 && !args.spreads.empty())
        return bad_usage(fmt::format("{} needs --copies N, such as --copies 100", args.spreads[0].typed));
    auto unused = args.spreads;
    job.copy_spec.count = args.copies;
    if (args.copies == 0) job.copies = job.afferents;
    for (std::size_t a = 0; args.copies > 0 && a < job.afferents.size(); ++a) {
        auto spreads = TRY(distributions_for(job.afferents[a], args.afferents[a], args.spreads));
        keep_unused(unused, spreads.unused);
        auto copies = TRY(make_copies(job.afferents[a], args.copies, spreads.result, args.simulation.seed));
        std::move(copies.begin(), copies.end(), std::back_inserter(job.copies));
        std::move(spreads.result.begin(), spreads.result.end(), std::back_inserter(job.copy_spec.distributions));
    }
    std::vector<std::string_view> names;
    for (const auto& a : job.afferents) names.push_back(a.name);
    return check_all_used(unused, names);
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
    return check_all_used(job.unused, names);
}

/// Returns an error if one of the requested probes is in none of the netlists. `found`: for each netlist, what became of the probes.
Result<void> check_probes(std::span<const std::string> names, std::span<const std::vector<RequestedProbe>> found) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (found.empty())
            return bad_usage(fmt::format("--probe {}: there is no netlist in this run; try --afferent sa1-circuit", names[k]));
        if (std::none_of(found.begin(), found.end(), [&](const auto& of_netlist) { return of_netlist[k].name.has_value(); }))
            return bad_input(
                fmt::format("--probe {}: no netlist of this run has such a node or device{}", names[k], found.front()[k].hint));
    }
    return {};
}

Result<void> plan_afferents(ChannelJob& job, const RespondArguments& args) {
    const auto& probes = args.netlists.probes;
    std::vector<std::vector<RequestedProbe>> found;
    for (const auto& name : args.afferents) {
        auto planned = TRY(plan_any_afferent(name, job.overrides, probes));
        if (std::any_of(job.afferents.begin(), job.afferents.end(), [&](const auto& a) { return a.name == planned.result.name; }))
            return bad_usage(fmt::format("--afferent {}: given twice", name));
        keep_unused(job.unused, planned.unused);
        job.afferents.push_back(std::move(planned.result));
        if (!planned.probes.empty()) found.push_back(std::move(planned.probes));
    }
    return check_probes(probes, found);
}

/// Opens every FORCE, and keeps the overrides that they have not used.
Result<void> open_sources(ChannelJob& job, const RespondArguments& args, bool quiet) {
    for (const auto& force : args.forces) {
        auto source = TRY(open_source(force, args, job.overrides, default_rate, quiet));
        keep_unused(job.unused, source.unused);
        job.sources.push_back(std::move(source.result));
    }
    return {};
}

}  // namespace

Result<ChannelJob> plan_channel_job(const RespondArguments& args, bool quiet) {
    ChannelJob job;
    job.options = args.simulation;
    if (args.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    job.overrides = args.netlists.overrides;  // first, so that a setting for one netlist takes precedence
    job.overrides.insert(job.overrides.end(), args.settings.begin(), args.settings.end());
    job.unused = job.overrides;
    TRY(plan_afferents(job, args));
    TRY(populate(job, args));
    TRY(open_sources(job, args, quiet));
    TRY(check_overrides(job));
    TRY(check_afferent_count(job));
    job.warnings = rate_warnings(job.sources, job.afferents);
    for (auto& warning : noise_warnings(job.afferents, job.options.noise)) job.warnings.push_back(std::move(warning));
    return job;
}

}  // namespace corpuscle
