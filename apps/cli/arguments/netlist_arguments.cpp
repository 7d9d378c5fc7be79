#include "cli/arguments/netlist_arguments.hpp"

#include <fmt/format.h>

#include "circuit/output/resolve_probe.hpp"

namespace corpuscle {

OptionGroup netlist_options(NetlistArguments& args) {
    return {"Netlists",
            {{"--supply", &args.supply, "VOLTAGE", "supply voltage of the circuit (its .param supply), such as 0.65V"},
             {"--temp", &args.temp, "DEGREES", "temperature in degrees Celsius"},
             {"--corner", &args.corner, "CORNER",
              "process corner (library section): tt ss ff sf fs, or mc (--mismatch then also samples the process)"},
             {"--mismatch", &args.mismatch, "SEED[/CHIP]",
              "simulate one mismatched chip: random threshold and current of each transistor (replaces .mc)"},
             {"--probe", &args.probes, "WHAT,WHAT",
              "record these instead of the .save list (run: in addition to it): vf, v(a,b), i(vdd), i(N3B). A device current flows into "
              "the drain or the first terminal; displacement current is not included. The last part of a path is enough: rectb.o"}}};
}

std::vector<ParameterOverride> netlist_overrides(const NetlistArguments& args) {
    std::vector<ParameterOverride> out;
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value) out.push_back({"", name, *value, fmt::format("--{} {}", name, *value)});
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

}  // namespace corpuscle
