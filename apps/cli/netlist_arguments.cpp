#include "netlist_arguments.hpp"

#include <fmt/format.h>

#include "circuit/resolve_probe.hpp"

namespace corpuscle {

std::vector<circuit::NetlistOverride> netlist_overrides(const NetlistArguments& w) {
    std::vector<circuit::NetlistOverride> out;
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value) out.push_back({name, *value, fmt::format("--{} {}", name, *value), true});
    };
    add("supply", w.supply), add("temp", w.temp), add("corner", w.corner), add("mismatch", w.mismatch);
    return out;
}

std::vector<std::string> probe_names(const NetlistArguments& w) {
    std::vector<std::string> out;
    for (const auto& text : w.probes)
        for (auto& probe : circuit::split_probes(text)) out.push_back(std::move(probe));
    return out;
}

std::string first_netlist_option(const NetlistArguments& w) {
    const auto overrides = netlist_overrides(w);
    return !overrides.empty() ? overrides[0].text : !w.probes.empty() ? "--probe " + w.probes[0] : "";
}

}  // namespace corpuscle
