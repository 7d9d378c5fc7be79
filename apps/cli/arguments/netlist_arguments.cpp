#include "cli/arguments/netlist_arguments.hpp"

#include <fmt/format.h>

#include "circuit/output/resolve_probe.hpp"

namespace corpuscle {

std::vector<circuit::NetlistOverride> netlist_overrides(const NetlistArguments& args) {
    std::vector<circuit::NetlistOverride> out;
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value) out.push_back({name, *value, fmt::format("--{} {}", name, *value), /* is_parameter_only = */ true});
    };
    add("supply", args.supply), add("temp", args.temp), add("corner", args.corner), add("mismatch", args.mismatch);
    return out;
}

std::vector<std::string> probe_names(const NetlistArguments& args) {
    std::vector<std::string> out;
    for (const auto& text : args.probes)
        for (auto& probe : circuit::split_probes(text)) out.push_back(std::move(probe));
    return out;
}

std::string first_netlist_option(const NetlistArguments& args) {
    const auto overrides = netlist_overrides(args);
    return !overrides.empty() ? overrides[0].text : !args.probes.empty() ? "--probe " + args.probes[0] : "";
}

}  // namespace corpuscle
