// corpuscle compare: compares two spike files, train by train.

#include <fmt/format.h>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/quantity.hpp"
#include "run/compare/comparison.hpp"

namespace corpuscle {
namespace {

constexpr const char* compare_examples =
    R"(A is the reference. A spike of A without a match in B is missing; a spike of B without a match in A
is extra.

Files are spikes.csv or spikes.npz of 'corpuscle respond', a list of times in seconds (.txt, .npy),
or any CSV or JSON Lines file with a column time_s. A column such as afferent, channel, unit or
cluster separates several trains. --time and --train choose other columns. Trains of the same name
are compared, and so are two files with one train each. A NAME is an afferent, a channel, or both:
sa1,fz.

Examples:
  corpuscle compare yesterday/spikes.csv today/spikes.csv
  corpuscle compare a/spikes.csv b/spikes.csv --pair sa1=sa1-kim      two afferents, on every channel
  corpuscle compare a/spikes.csv b/spikes.csv --pair fz=fz_abs        two channels, for every afferent
  corpuscle compare a/spikes.csv --pair sa1=sa1-kim                   two trains of one file
  corpuscle compare recorded.csv result/spikes.npz --pair 11=sa1,fz --window 2ms --json

Two spikes match if the Victor-Purpura alignment with a cost of 2 per window shifts one onto the
other; matches never cross. The Victor-Purpura distance is the minimum total cost to turn A into B:
1 per spike removed or added, and --cost per second of shift. 'per spike' is this distance divided
by the number of spikes in A and B, 0 to 1. The van Rossum distance is scaled so that one extra
spike counts 1.)";

struct CompareArguments {
    std::vector<std::string> files;
    std::optional<std::string> time_column, train_column;  // columns of the spike files, by name or number
    CompareOptions options;
};

OptionReader cost_reader(double& to) {
    return refuse_if([&to] { return !(to >= 0); }, "must be 0 or more", quantity_reader(to, "Hz"));
}

/// Warns of a window above 0.5 s. It was probably meant in milliseconds, but a number without a unit is in seconds.
void warn_of_window(double window, const CommonArguments& common) {
    constexpr double max_usual = 0.5;  // s
    for (const auto& [name, values] : common.typed) {
        if (name != "--window" || window <= max_usual) continue;
        const bool has_no_unit = values[0].find_first_not_of("+0123456789.eE") == std::string::npos;
        fmt::print(stderr, "corpuscle: warning: --window {} matches spikes up to {} apart{}\n", values[0], format_quantity(window, "s"),
                   has_no_unit ? fmt::format("; for milliseconds write --window {}ms", values[0]) : "");
    }
}

Result<void> compare_files(const CompareArguments& args, const CommonArguments& common) {
    const auto& options = args.options;
    if (args.files.empty()) return bad_usage("compare: no files given; try 'corpuscle compare A/spikes.csv B/spikes.csv'");
    if (args.files.size() == 1 && options.pairs.empty())
        return bad_usage(fmt::format("compare {}: needs a second file, or two trains of this file: --pair sa1=fa1", args.files[0]));
    warn_of_window(options.window, common);
    const SpikeColumns columns{args.time_column, args.train_column};
    std::vector<NamedTrain> a, b;
    if (args.files.size() == 1)
        a = b = TRY(read_spikes(args.files.front(), columns));
    else
        std::tie(a, b) = TRY(read_both(args.files.front(), args.files.back(), columns));
    const auto differences = TRY(compare_all(a, b, options, [](double) { return !interrupted(); }));
    if (common.json)
        fmt::print("{}\n", json_text(document_of(options, differences)));
    else if (!common.quiet)
        print_text(comparison_table(options, differences));
    return {};
}

}  // namespace

Verb make_compare_verb() {
    const auto args = std::make_shared<CompareArguments>();
    return {
        .name = "compare",
        .description = "compare two spike files: matches, distances, missing and extra spikes",
        .examples = compare_examples,
        .options =
            {{"",
              {counted(1, 2, {"FILES", &args->files, "A [B]", "the spike files A and B (CSV, NPZ ...), or one file with --pair"}),
               {"--pair,-p", &args->options.pairs, "A-NAME=B-NAME",
                "compare train A-NAME of the first file with B-NAME of the second (repeatable)"},
               {"--by-order", &args->options.by_order, "", "ignore names: compare the first train of A with the first of B, and so on"},
               {"--time", &args->time_column, "COLUMN", "column of spike times, by name or number (default: time_s)"},
               {"--train", &args->train_column, "COLUMN", "column that identifies the train, by name or number"},
               with_default("5ms",
                            {"--window", above_zero_reader(args->options.window, "s"), "TIME", "maximum time between matching spikes"}),
               with_default("100Hz",
                            {"--cost", cost_reader(args->options.cost), "FREQUENCY", "Victor-Purpura distance: cost per second of shift"}),
               with_default("10ms", {"--tau", above_zero_reader(args->options.tau, "s"), "TIME", "van Rossum distance: time constant"})}}},
        .reports = true,
        .run = interruptible(args, compare_files)};
}

}  // namespace corpuscle
