#include "run/channels/channel_plan.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <limits>

#include "run/afferent_plan.hpp"

namespace corpuscle {
namespace {

/// Returns an error if one of the requested probes is in none of the netlists. `found`: for each netlist, what became of the probes.
Result<void> check_probes(std::span<const std::string> names, std::span<const std::vector<RequestedProbe>> found) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (found.empty())
            return bad_usage(fmt::format("--probe {}: there is no netlist or NIR graph in this run; try --afferent sa1-circuit", names[k]));
        if (std::none_of(found.begin(), found.end(), [&](const auto& of_netlist) { return of_netlist[k].name.has_value(); }))
            return bad_input(
                fmt::format("--probe {}: no netlist or NIR graph of this run has such a quantity{}", names[k], found.front()[k].hint));
    }
    return {};
}

/// Plans an afferent. If its name is unknown, and there is such a file, the error says how to name the file.
Result<PlannedAfferent> plan_afferent_or_file(const std::string& name, const ChannelPlanRequest& request) {
    auto planned = plan_any_afferent(name, request.overrides, request.probes);
    std::error_code status;
    if (planned || read_afferent_spec(name) || !std::filesystem::is_regular_file(name, status)) return planned;
    return bad_input(fmt::format("unknown afferent '{0}'; for the file {0} write ./{0}", name));
}

Result<void> add_afferents(ChannelPlan& plan, const ChannelPlanRequest& request) {
    std::vector<std::vector<RequestedProbe>> found;
    plan.unused.assign(request.overrides.begin(), request.overrides.end());
    for (const auto& name : request.afferents) {
        auto planned = TRY(plan_afferent_or_file(name, request));
        if (std::any_of(plan.afferents.begin(), plan.afferents.end(), [&](const auto& a) { return a.name == planned.result.name; }))
            return bad_usage(fmt::format("--afferent {}: {} is given twice", name, planned.result.name));
        keep_unused(plan.unused, planned.unused);
        plan.afferents.push_back(std::move(planned.result));
        if (!planned.probes.empty()) found.push_back(std::move(planned.probes));
    }
    return check_probes(request.probes, found);
}

Result<void> add_copies(ChannelPlan& plan, const ChannelPlanRequest& request) {
    plan.copies.count = request.copies;
    if (request.copies == 0) {
        plan.simulated = plan.afferents;
        return request.spreads.empty() ? Result<void>()
                                       : bad_usage(fmt::format("{} needs --copies N, such as --copies 100", request.spreads[0].typed));
    }
    if (request.copies > max_copies) return bad_usage(fmt::format("--copies {}: the largest number is {}", request.copies, max_copies));
    std::vector<ParameterOverride> spreads(request.spreads.begin(), request.spreads.end());  // those that no afferent so far has used
    std::vector<std::string_view> names;
    for (const auto& afferent : plan.afferents) {
        names.push_back(afferent.name);
        auto applied = TRY(distributions_for(afferent, spreads));
        spreads = std::move(applied.unused);
        auto copies = TRY(make_copies(afferent, request.copies, applied.result, request.seed));
        std::move(copies.begin(), copies.end(), std::back_inserter(plan.simulated));
        std::move(applied.result.begin(), applied.result.end(), std::back_inserter(plan.copies.distributions));
    }
    return check_all_used(spreads, names);
}

}  // namespace

Result<ChannelPlan> plan_channels(const ChannelPlanRequest& request) {
    ChannelPlan plan;
    TRY(add_afferents(plan, request));
    TRY(add_copies(plan, request));
    return plan;
}

Result<void> check_afferent_count(std::size_t afferents, std::uint32_t copies, std::size_t channels) {
    const auto count = std::uint64_t{channels} * afferents * std::max(copies, 1U);
    if (copies > max_copies || count <= std::numeric_limits<std::uint32_t>::max()) return {};  // plan_channels() refuses the first
    return bad_usage(fmt::format("--copies {}: {} afferents over all channels are too many; use fewer copies or channels", copies, count));
}

}  // namespace corpuscle
