// corpuscle compare: compares two spike files, train by train.

#include "run/compare/train_comparison.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/output/printable.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Result<CompareOptions> options_of(const CompareArguments& args) {
    CompareOptions options{.pairs = args.pairs, .by_order = args.by_order};
    for (const auto& [text, unit, option, to] : {std::tuple{&args.window, "s", "--window", &options.window},
                                                 {&args.cost, "Hz", "--cost", &options.cost},
                                                 {&args.tau, "s", "--tau", &options.tau}}) {
        const auto value = parse_quantity(*text, unit);
        if (!value) return bad_usage(fmt::format("{} {}", option, value.error().message));
        if (!(*value > 0) && !(to == &options.cost && *value == 0))
            return bad_usage(fmt::format("{} {}: must be {}", option, *text, to == &options.cost ? "0 or more" : "greater than 0"));
        *to = *value;
    }
    return options;
}

/// Warns of a window above 0.5 s. It was probably meant in milliseconds, but a number without a unit is in seconds.
void warn_of_window(const CompareOptions& options, const CompareArguments& args) {
    constexpr double max_usual = 0.5;  // s
    if (options.window <= max_usual) return;
    const bool has_no_unit = args.window.find_first_not_of("+0123456789.eE") == std::string::npos;
    fmt::print(stderr, "corpuscle: warning: --window {} matches spikes up to {} apart{}\n", args.window,
               format_quantity(options.window, "s"), has_no_unit ? fmt::format("; for milliseconds write --window {}ms", args.window) : "");
}

Json document_of(const TrainDifference& d) {
    // Shifts exist only if spikes match.
    const auto seconds = [&](double x) { return d.matched > 0 ? Json(x) : Json(nullptr); };
    return {{"spikes_a", d.spikes_a},
            {"spikes_b", d.spikes_b},
            {"matched", d.matched},
            {"missing", d.missing()},
            {"extra", d.extra()},
            {"max_shift_s", seconds(d.max_shift)},
            {"rms_shift_s", seconds(d.rms())},
            {"victor_purpura", d.victor_purpura},
            {"victor_purpura_per_spike", d.victor_purpura_per_spike()},
            {"van_rossum", d.van_rossum()}};
}

std::string document(const CompareOptions& options, const std::vector<TrainDifference>& all, const TrainDifference& total) {
    Json out = {{"window_s", options.window}, {"cost_Hz", options.cost}, {"tau_s", options.tau}};
    out["pairs"] = Json::array();
    for (const auto& d : all) {
        Json row = {{"a", d.a}, {"b", d.b}};
        row.update(document_of(d));
        out["pairs"].push_back(std::move(row));
    }
    out["total"] = document_of(total);
    return json_text(out) + "\n";
}

std::vector<std::string> line_of(const TrainDifference& d, const std::string& a, const std::string& b) {
    const auto milliseconds = [&](double x) { return d.matched > 0 ? fmt::format("{:.3f}", 1e3 * x) : "-"; };
    return {a,
            b,
            fmt::format("{}", d.spikes_a),
            fmt::format("{}", d.spikes_b),
            fmt::format("{}", d.matched),
            fmt::format("{}", d.missing()),
            fmt::format("{}", d.extra()),
            milliseconds(d.max_shift),
            milliseconds(d.rms()),
            fmt::format("{:.2f}", d.victor_purpura),
            fmt::format("{:.3f}", d.victor_purpura_per_spike()),
            fmt::format("{:.2f}", d.van_rossum())};
}

std::string text(const CompareOptions& options, const std::vector<TrainDifference>& all, const TrainDifference& total) {
    std::vector<std::vector<std::string>> rows = {
        {"A", "B", "in A", "in B", "matched", "missing", "extra", "max (ms)", "RMS (ms)", "Victor-Purpura", "per spike", "van Rossum"}};
    const auto shown = [](const std::string& name) { return name.empty() ? "-" : name; };
    for (const auto& d : all) rows.push_back(line_of(d, shown(d.a), shown(d.b)));
    if (all.size() > 1) rows.push_back(line_of(total, "total", ""));
    return format_table(rows) + fmt::format("Matching window {}; Victor-Purpura cost {:g} per second; van Rossum time constant {}.\n",
                                            format_quantity(options.window, "s"), options.cost, format_quantity(options.tau, "s"));
}

Result<void> run(const CompareArguments& args, const CommonArguments& common) {
    const auto options = options_of(args);
    if (!options) return options.error();
    if (args.files.empty()) return bad_usage("compare: no files given; try 'corpuscle compare A/spikes.csv B/spikes.csv'");
    if (args.files.size() == 1 && args.pairs.empty())
        return bad_usage(fmt::format("compare {}: needs a second file, or two trains of this file: --pair sa1=fa1", args.files[0]));
    warn_of_window(*options, args);
    const SpikeColumns columns{args.time_column, args.train_column};
    auto a = read_spikes(args.files.front(), columns);
    auto b = args.files.size() == 1 ? a : read_spikes(args.files.back(), columns);
    // --time and --train need to apply to one of the files only. A file without these columns is read with the default columns.
    if (!a && b && args.files.size() == 2 && (args.time_column || args.train_column))
        if (auto with_defaults = read_spikes(args.files.front())) a = std::move(with_defaults);
    if (a && !b && (args.time_column || args.train_column))
        if (auto with_defaults = read_spikes(args.files.back())) b = std::move(with_defaults);
    if (!a) return a.error();
    if (!b) return b.error();
    const auto pairs = pair_trains(*a, *b, *options);
    if (!pairs) return pairs.error();
    std::vector<TrainDifference> all;
    TrainDifference total;
    for (const auto& p : *pairs) {
        if (interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
        const auto difference = compare_trains(p, *options);
        if (!difference) return difference.error();
        all.push_back(*difference);
        total.add(*difference);
    }
    if (common.json)
        fmt::print("{}", document(*options, all, total));
    else if (!common.quiet)
        print_text(text(*options, all, total));
    return {};
}

}  // namespace

int compare_trains(const CompareArguments& args, const CommonArguments& common) {
    catch_interrupt();
    const auto done = run(args, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
