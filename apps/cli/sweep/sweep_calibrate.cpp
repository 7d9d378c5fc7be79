// corpuscle sweep calibrate: trims simulated chips of one netlist to match a model; prints the yield for each number of trim bits.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "circuit/variant/netlist_variants.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"
#include "sweep/calibrate/calibrate.hpp"

namespace corpuscle {
namespace {

constexpr const char* calibrate_examples =
    "Each chip is simulated with the stimulus. It passes if the spike count of each phase differs from\n"
    "the model's by at most a quarter (or one spike), if no spike precedes the force, and if the first\n"
    "spike is within the time of --first-spike. A chip that fails is trimmed, coarse steps first, and\n"
    "simulated again.\n\n"
    "Examples:\n  corpuscle sweep calibrate sa1-circuit\n  corpuscle sweep calibrate fa1-circuit --samples 200 --bits 6 --separately\n"
    "  corpuscle sweep calibrate sa1-circuit --set hv_membrane=0 --first-spike 20ms\n"
    "  corpuscle sweep calibrate own.cir --like sa1 --trim i_leak=50% --trim x1.m3.m+x1.m4.m=25%";

struct SweepCalibrateArguments {
    std::string netlist, like, force = "press", corner = "mc";
    std::vector<std::string> trims, settings;
    double max_first_spike_error = 10e-3;  // s, between the first spikes of chip and model
    int bits = 4;                          // maximum number of bits of each trim
    std::int64_t samples = 64;             // number of chips
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;  // 0: one per core
    bool separately = false;    // also evaluate each trim alone
};

/// The default trims of a built-in circuit, and the model that it must match.
struct DefaultTrims {
    const char *netlist, *model, *trims[3];
};
constexpr DefaultTrims default_trims[] = {
    {"sa1-circuit", "sa1", {"i_leak=100%", "i_biasb=25%", "summer.n3b.m=50%"}},
    {"fa1-circuit", "fa1", {"i_leak=100%", "i_biasb=25%", "rect.p1b.m+rect.n2b.m=50%"}},
};

/// Parses "rect.p1b.m+rect.n2b.m=50%": names of parameters that are trimmed together, and the range, by which the highest code increases
/// their value. If the first name is a multiplier (.m), the values are integers.
Result<Trim> parse_trim(const std::string& text, const ChipCalibration& calibration) {
    const auto equals = text.find('=');
    const auto range = equals == std::string::npos ? std::nullopt : std::optional(text.substr(equals + 1));
    char* end = nullptr;
    const double percent = range ? std::strtod(range->c_str(), &end) : 0;
    if (!range || end == range->c_str() || std::string(end) != "%" || !(percent > 0 && percent <= 1000))
        return bad_usage(
            fmt::format("--trim {}: write NAME=RANGE, such as i_leak=50%: the highest code increases the value by 50 %", text));
    const auto parts = split(std::string_view(text).substr(0, equals), '+');
    std::vector<std::string> names(parts.begin(), parts.end());
    if (names[0].empty()) return bad_usage(fmt::format("--trim {}: the name before = is missing", text));
    const bool is_integer = names[0].ends_with(".m");
    return trim_of(calibration.netlist, calibration.overrides, std::move(names), percent / 100, is_integer);
}

/// Sets the stimulus, and derives the pass limits from the response of the model in each phase and between the phases.
Result<void> set_target(ChipCalibration& calibration, const std::string& model, const SweepCalibrateArguments& args) {
    const auto stimulus = TRY(make_stimulus(args.force, 10e3, 0));
    auto force = TRY(read_channel(*stimulus));
    const auto& clock = stimulus->clock();
    const auto plan = TRY(plan_any_afferent(model));
    const auto response = TRY(simulate(*make_afferent(plan.result, {clock.T()}), force));
    calibration.force = std::move(force), calibration.T = clock.T();
    std::vector<TimeWindow> phases;
    double from = 0;
    for (const auto& p : stimulus->phases()) {
        if (p.from > from) phases.push_back({from, p.from});
        phases.push_back({p.from, p.to}), from = p.to;
    }
    const double end = static_cast<double>(calibration.force.size()) * calibration.T;
    if (end > from) phases.push_back({from, end});
    calibration.limits = FiringLimits::around(spike_times(response.spikes, clock), phases, args.max_first_spike_error);
    return {};
}

/// Calibrates the same chips with all trims and, with --separately, also with each trim alone.
Result<std::vector<CalibrationResult>> run_calibrations(ChipCalibration& calibration, const std::vector<Trim>& trims,
                                                        const SweepCalibrateArguments& args) {
    const circuit::ChipSpec sampler{static_cast<double>(args.samples), args.seed};
    std::vector<circuit::ChipSample> chips;
    for (std::int64_t k = 0; k < args.samples; ++k) chips.push_back(sampler.sample(static_cast<std::uint64_t>(k)));
    std::vector<std::vector<Trim>> sets = {trims};
    if (args.separately && trims.size() > 1)
        for (const auto& t : trims) sets.push_back({t});
    std::vector<CalibrationResult> out;
    for (const auto& set : sets) {
        calibration.trims = set;
        auto done = TRY(calibrate(calibration, chips));
        out.push_back({set, std::move(done)});
    }
    return out;
}

Result<void> calibrate_netlist(const SweepCalibrateArguments& args, const CommonArguments& common) {
    const DefaultTrims* defaults = nullptr;
    for (const auto& d : default_trims)
        if (args.netlist == d.netlist) defaults = &d;
    if (!defaults && (args.trims.empty() || args.like.empty()))
        return bad_usage(fmt::format("sweep calibrate {}: --like MODEL and --trim NAME=RANGE are required for this netlist", args.netlist));
    if (args.samples < 1 || args.samples > 1'000'000)
        return bad_usage(fmt::format("--samples {}: must be from 1 to 1000000", args.samples));
    ChipCalibration calibration;
    calibration.netlist = args.netlist, calibration.bits = args.bits, calibration.threads = args.threads;
    calibration.overrides = {{"", "corner", args.corner, "--corner " + args.corner}};
    for (const auto& text : args.settings)
        calibration.overrides.push_back(TRY(circuit::parse_netlist_override(args.netlist, text, "--set")));
    calibration.batch.max_iterations = 60'000;
    calibration.batch.should_stop = interrupted;
    TRY(set_target(calibration, args.like.empty() ? defaults->model : args.like, args));
    std::vector<Trim> trims;
    for (const auto& text :
         args.trims.empty() ? std::vector<std::string>(std::begin(defaults->trims), std::end(defaults->trims)) : args.trims) {
        trims.push_back(TRY(parse_trim(text, calibration)));
    }
    auto done = [&] {
        Progress progress(common.quiet);
        calibration.on_progress = [&](std::size_t left, std::size_t) {
            progress.update(1 - static_cast<double>(left) / static_cast<double>(args.samples));
        };
        return run_calibrations(calibration, trims, args);
    }();
    if (!done) return done.error();
    if (common.json)
        fmt::print("{}\n", json_text(document_of(calibration, *done)));
    else if (!common.quiet)
        print_text(format_calibration(calibration, *done));
    return {};
}

}  // namespace

Verb make_sweep_calibrate_verb() {
    const auto args = std::make_shared<SweepCalibrateArguments>();
    return {
        .name = "calibrate",
        .description = "trim simulated chips to match a model -> yield for each number of trim bits",
        .examples = calibrate_examples,
        .options = {{"",
                     {suggesting(netlist_names, required({"NETLIST", &args->netlist, "",
                                                          "sa1-circuit, fa1-circuit, or a netlist with a force input and a spike output"})),
                      suggesting(afferent_names, {"--like", &args->like, "AFFERENT",
                                                  "the model to match (default: sa1 for sa1-circuit, fa1 for fa1-circuit)"}),
                      counted(1, any_number_of_values,
                              {"--trim", &args->trims, "NAME=RANGE",
                               "a trimmed .param or device parameter (several are joined by +) and its range: the increase at the highest "
                               "code. The multiplier .m is trimmed in integer steps (default: I_LEAK, I_BIASB and one gain)"}),
                      counted(1, any_number_of_values,
                              {"--set,-s", &args->settings, "NAME=VALUE", "set a .param or a device parameter of all chips, as for run"}),
                      with_default("10ms", {"--first-spike", above_zero_reader(args->max_first_spike_error, "s"), "TIME",
                                            "largest difference between the first spikes of chip and model"}),
                      {"--bits", &args->bits, "N", "maximum number of bits of each trim", std::pair(1, 12)},
                      {"--samples", &args->samples, "N", "number of chips", OptionSign::positive},
                      {"--seed", &args->seed, "N", "random seed of process and mismatch"},
                      {"--corner", &args->corner, "", "process corner; mc includes process variation"},
                      suggesting(stimulus_names, {"--force", &args->force, "STIMULUS", "the stimulus"}),
                      {"--separately", &args->separately, "", "also evaluate each trim alone"},
                      {"--threads,-j", &args->threads, "N", "number of threads (0: one per core); results do not depend on it",
                       std::pair(0U, 1024U)}}}},
        .reports = true,
        .run = interruptible(args, calibrate_netlist)};
}

}  // namespace corpuscle
