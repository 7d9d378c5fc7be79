#include "cli/arguments/shared_arguments.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "circuit/output/saved_quantities.hpp"
#include "core/stimulus/stimuli.hpp"

namespace corpuscle {
namespace {

bool is_file(const std::string& path) {
    std::error_code status;
    return path == "-" || std::filesystem::exists(path, status);
}

}  // namespace

ForceArgument read_force(std::string text) {
    const auto all = named_touches();
    const auto touch = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == text; });
    const bool is_of_catalog = is_stimulus(text);
    return {std::move(text), is_of_catalog, touch == all.end() ? nullptr : &*touch};
}

bool is_force(const std::string& argument) {
    const auto force = read_force(argument);
    return force.is_stimulus || force.touch || is_file(argument);
}

Result<Applied<std::unique_ptr<ForceSource>>> ForceArgument::open(const RecordingOptions& options,
                                                                  std::span<const ParameterOverride> overrides, double rate,
                                                                  std::uint64_t seed) const {
    if (is_stimulus) return make_stimulus(text, overrides, options.rate.value_or(rate), seed);
    if (!is_file(text) && text.find_first_of("./") == std::string::npos) {
        auto error = make_stimulus(text, rate, seed).error();
        error.message += fmt::format(" (and no file '{}' exists)", text.substr(0, 64));
        return error;
    }
    auto recording = TRY(open_recording(path(), options));
    return Applied<std::unique_ptr<ForceSource>>{std::move(recording), {overrides.begin(), overrides.end()}};
}

std::vector<std::string> given_recording_options(const CommonArguments& common) {
    RecordingOptions unused;
    const auto group = recording_option_group(unused);
    std::vector<std::string> given;
    for (const auto& row : group.rows)
        for (const auto& typed : common.typed)
            if (row.names.substr(0, row.names.find(',')) == typed.name) given.push_back(typed.name);
    return given;
}

Result<void> check_recording_arguments(const CommonArguments& common, std::span<const ForceArgument> forces) {
    for (const auto& f : forces)
        if (f.text.find('=') != std::string::npos && !is_force(f.text))
            return bad_usage(fmt::format("{0}: neither a stimulus nor a file; each setting needs its own option: --set {0}", f.text));
    if (forces.empty() || !std::all_of(forces.begin(), forces.end(), [](const auto& f) { return f.is_stimulus; })) return {};
    const auto options = given_recording_options(common);
    if (options.empty()) return {};
    return bad_usage(
        fmt::format("{0} is for recordings, but {1} is a stimulus; change it by --set {1}.PARAMETER=VALUE", options[0], forces[0].text));
}

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
