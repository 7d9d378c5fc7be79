#include "netlist_words.hpp"

#include <fmt/format.h>

#include "circuit/resolve_probe.hpp"

namespace corpuscle {

std::vector<circuit::NetlistOverride> knobs_of(const NetlistWords& w) {
    std::vector<circuit::NetlistOverride> out;
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value) out.push_back({name, *value, fmt::format("--{} {}", name, *value), true});
    };
    add("supply", w.supply), add("temp", w.temp), add("corner", w.corner), add("mismatch", w.mismatch);
    return out;
}

std::vector<std::string> traces_of(const NetlistWords& w) {
    std::vector<std::string> out;
    for (const auto& text : w.traces)
        for (auto& probe : circuit::split_probes(text)) out.push_back(std::move(probe));
    return out;
}

std::string said_of(const NetlistWords& w) {
    const auto overrides = knobs_of(w);
    return !overrides.empty() ? overrides[0].text : !w.traces.empty() ? "--trace " + w.traces[0] : "";
}

}  // namespace corpuscle
