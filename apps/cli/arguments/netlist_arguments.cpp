#include "cli/arguments/netlist_arguments.hpp"

#include <fmt/format.h>

#include "circuit/output/saved_quantities.hpp"

namespace corpuscle {

OptionGroup netlist_options(NetlistArguments& args) {
    const auto override_of = [&args](const char* parameter) {
        return [&args, parameter](const std::string& text) {
            args.overrides.push_back({"", parameter, text, fmt::format("--{} {}", parameter, text)});
            return Result<void>();
        };
    };
    const auto read_probes = [&args](const std::string& text) {
        for (auto& probe : circuit::split_probes(text)) args.probes.push_back(std::move(probe));
        return Result<void>();
    };
    return {
        "Netlists",
        {{"--supply", override_of("supply"), "VOLTAGE", "supply voltage of the circuit (its .param supply), such as 0.65V"},
         {"--temp", override_of("temp"), "DEGREES", "temperature in degrees Celsius"},
         {"--corner", override_of("corner"), "CORNER",
          "process corner (library section): tt ss ff sf fs, or mc (--mismatch then also samples the process)"},
         {"--mismatch", override_of("mismatch"), "SEED[/CHIP]",
          "simulate one mismatched chip: random threshold and current of each transistor (replaces .mc)"},
         repeatable(
             {"--probe", read_probes, "WHAT,WHAT",
              "record these instead of the .save list (run: in addition to it): vf, v(a,b), i(vdd), i(N3B). A device current flows "
              "into the drain or the first terminal; displacement current is not included. The last part of a path is enough: rectb.o"})}};
}

}  // namespace corpuscle
