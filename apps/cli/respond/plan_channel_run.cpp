// Plans a run of afferents on channels: reads the options, plans the afferents and their copies, and opens the sources.

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <limits>

#include "cli/respond/channel_run.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;  // Hz, sample rate of stimuli

/// Makes the copies of the afferents. Each of job.spreads is for one afferent.
Result<void> add_copies(ChannelJob& job) {
    if (job.copy_spec.count == 0) {
        job.copies = job.afferents;
        return job.spreads.empty() ? Result<void>()
                                   : bad_usage(fmt::format("{} needs --copies N, such as --copies 100", job.spreads[0].typed));
    }
    std::vector<std::string_view> names;
    for (const auto& afferent : job.afferents) {
        names.push_back(afferent.name);
        auto applied = TRY(distributions_for(afferent, job.spreads));
        job.spreads = std::move(applied.unused);
        auto copies = TRY(make_copies(afferent, job.copy_spec.count, applied.result, job.options.seed));
        std::move(copies.begin(), copies.end(), std::back_inserter(job.copies));
        std::move(applied.result.begin(), applied.result.end(), std::back_inserter(job.copy_spec.distributions));
    }
    return check_all_used(job.spreads, names);
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

Result<void> plan_afferents(ChannelJob& job, std::span<const std::shared_ptr<const AfferentSpec>> specs,
                            std::span<const std::string> probes) {
    std::vector<std::vector<RequestedProbe>> found;
    for (const auto& spec : specs) {
        auto planned = TRY(spec->plan(job.overrides, probes));
        if (std::any_of(job.afferents.begin(), job.afferents.end(), [&](const auto& a) { return a.name == planned.result.name; }))
            return bad_usage(fmt::format("--afferent {}: given twice", spec->text()));
        keep_unused(job.unused, planned.unused);
        job.afferents.push_back(std::move(planned.result));
        if (!planned.probes.empty()) found.push_back(std::move(planned.probes));
    }
    return check_probes(probes, found);
}

Result<void> open_sources(ChannelJob& job, std::span<const ForceArgument> forces, const RecordingOptions& recording, bool quiet) {
    for (const auto& force : forces) job.sources.push_back(TRY(open_source(job, force, recording, default_rate, quiet)));
    return {};
}

}  // namespace

Result<ChannelJob> plan_channel_job(const RespondArguments& args, bool quiet) {
    if (args.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    ChannelJob job;
    job.options = args.simulation;
    job.spreads = args.spreads;
    job.copy_spec.count = args.copies;
    job.overrides = args.netlists.overrides;  // first, so that a setting for one netlist takes precedence
    job.overrides.insert(job.overrides.end(), args.settings.begin(), args.settings.end());
    job.unused = job.overrides;
    TRY(plan_afferents(job, args.afferents, args.netlists.probes));
    TRY(add_copies(job));
    TRY(open_sources(job, args.forces, args.recording, quiet));
    TRY(check_overrides(job));
    TRY(check_afferent_count(job));
    job.warnings = rate_warnings(job.sources, job.afferents);
    for (auto& warning : noise_warnings(job.afferents, job.options.noise)) job.warnings.push_back(std::move(warning));
    return job;
}

}  // namespace corpuscle
