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

/// Newtons per unit of the readings: "0.002", "10%", or with a unit, "2mN".
Result<double> parse_scale(const std::string& text) {
    auto plain = parse_quantity(text, ""), scale = plain ? plain : parse_quantity(text, "N");
    return scale ? scale : bad_usage(fmt::format("'{}': write newtons per unit of the readings: 0.002, or 2mN", text));
}

/// "LO..HI".
Result<std::pair<double, double>> parse_range(const std::string& text) {
    const auto dots = text.find("..");
    const auto low = parse_quantity(text.substr(0, dots), ""),
               high = dots == std::string::npos ? low : parse_quantity(text.substr(dots + 2), "");
    if (dots == std::string::npos || !low || !high || !(*low < *high))
        return bad_usage(fmt::format("{}: write LO..HI with LO below HI, in the unit of the readings, such as 0..4095", text));
    return std::pair(*low, *high);
}

Result<BadFields> parse_bad_fields(const std::string& text) {
    return text == "error" ? BadFields::error : text == "drop" ? BadFields::drop : BadFields::interpolate;
}

Result<DespikeOptions> parse_despike(const std::string& text) {
    if (text == "auto") return DespikeOptions{};
    const auto limit = parse_quantity(text, "");
    if (!limit || !(*limit > 0)) return bad_usage(fmt::format("{}: write 'auto', or a limit above 0 in the unit of the readings", text));
    return DespikeOptions{*limit};
}

/// Half the width of the band, N.
Result<DeadbandOptions> parse_deadband(const std::string& text) {
    if (text == "auto") return DeadbandOptions{};
    const auto band = parse_quantity(text, "N");
    if (!band || !(*band > 0)) return bad_usage(fmt::format("{}: write 'auto', or a force above 0, such as 20mN", text));
    return DeadbandOptions{*band};
}

Result<Interpolation> parse_interpolation(const std::string& text) {
    return text == "smooth" ? Interpolation::smooth : Interpolation::linear;
}

Result<std::size_t> parse_count(const std::string& text) { return std::stoul(text); }

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
    auto recording = TRY(open_recording(text == "-" ? "/dev/stdin" : text, options));
    return Applied<std::unique_ptr<ForceSource>>{std::move(recording), {overrides.begin(), overrides.end()}};
}

OptionGroup recording_option_group(RecordingOptions& options) {
    return {"Recordings",
            {{"--channel,-c", &options.channels, "CHANNEL",
              "channels of a recording: names, or numbers and ranges (2-5) that count all columns except time"},
             {"--dataset", &options.table.dataset, "NAME", "array to read from a file with several (HDF5, NPZ), by path or name"},
             {"--transpose", &options.table.transpose, "", "rows of a recording are channels"},
             excluding("--transpose", {"--no-transpose", &options.table.transpose, "",
                                       "rows of a recording are samples, even if there are fewer rows than channels"}),
             {"--skip", value_reader(options.table.skip_lines, parse_count), "LINES",
              "number of lines to skip at the beginning of a text file", std::pair(0U, 1'000'000U)},
             {"--time", &options.time, "COLUMN", "time column of a recording by name or number, or 'none'"},
             {"--time-unit", &options.time_unit, "UNIT", "unit of the time column, if the header has none: s, ms, us, ns"},
             {"--unit", &options.unit, "UNIT", "unit of the recording: N, mN, gf, kgf, or raw (with --scale)"},
             {"--scale", value_reader(options.scale, parse_scale), "S", "newtons per unit of the recording: 0.002, 2mN"},
             {"--abs", &options.absolute, "", "use the absolute value of each reading"},
             {"--offset", quantity_reader(options.offset, ""), "X", "reading at zero force, subtracted before --scale"},
             {"--range", value_reader(options.range, parse_range), "LO..HI",
              "valid range of readings; --bad-fields says what happens to others"},
             {"--bad-fields", value_reader(options.bad_fields, parse_bad_fields), "WHAT",
              "what to do with fields that are not numbers and readings out of --range: error (default for fields), drop the row, "
              "interpolate (default for readings)",
              one_of("error", "drop", "interpolate")},
             {"--despike", value_reader(options.despike, parse_despike), "LIMIT",
              "outlier limit: readings further than this from the median of 25 neighbours are bad (auto is 6 standard deviations)"},
             repeatable({"--notch", list_reader(options.notch, quantity_of("Hz")), "FREQUENCY",
                         "remove mains hum: 50Hz, with a bandwidth of 4 Hz (repeatable)"}),
             {"--lowpass", quantity_reader(options.lowpass, "Hz"), "FREQUENCY",
              "low-pass filter at this frequency (Butterworth, second order)"},
             {"--zero", refuse_if([&options] { return !(*options.zero > 0); }, "must be above 0", quantity_reader(options.zero, "s")),
              "TIME", "subtract the level of each channel at rest: its median during the first TIME, in which the force is taken as 0"},
             {"--deadband", value_reader(options.deadband, parse_deadband), "BAND",
              "remove the sensor's noise: the force follows changes beyond +-BAND only, such as 20mN (auto: 4 times the noise of each "
              "channel during --zero TIME)"},
             {"--layout", &options.layout, "FILE", "CSV table of sensor names and positions: channel,name,x_mm,y_mm"},
             {"--resample", quantity_reader(options.resample, "Hz"), "FREQUENCY", "resample a recording to this rate by interpolation"},
             {"--interpolation", value_reader(options.interpolation, parse_interpolation), "CURVE",
              "between the samples for --resample: linear (straight lines, the default), or smooth (a curve without corners, which excite "
              "FA-I and FA-II)",
              one_of("linear", "smooth")}}};
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
