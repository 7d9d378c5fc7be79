// corpuscle sweep show: analyses a results file.

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"
#include "report/page_file.hpp"
#include "report/sweep/sweep_page.hpp"
#include "run/earlier_outputs.hpp"
#include "sweep/stats/sweep_tables.hpp"

namespace corpuscle {
namespace {

constexpr const char* show_examples =
    R"(All estimates have 95 % confidence intervals: yields by Clopper and Pearson, means by Student,
standard deviations by Bonett (without assuming a distribution), quantiles between two order
statistics. doc/sweeps.md explains how to read them.

Examples:
  corpuscle sweep show chips.sqlite
  corpuscle sweep show chips.sqlite --by temp --measure spikes --quantile 0.01 --quantile 0.99
  corpuscle sweep show chips.sqlite --report chips.html
  corpuscle sweep show chips.sqlite --json)";

struct SweepShowArguments {
    std::string results, report_file;
    std::vector<std::string> by, measures;
    std::vector<double> quantiles;
};

/// The options of the summary; the quantiles are sorted.
Result<SweepSummaryOptions> summary_options(const SweepShowArguments& args) {
    SweepSummaryOptions out;
    out.axes = args.by;
    if (args.quantiles.empty()) return out;
    for (const double q : args.quantiles)
        if (!(q > 0 && q < 1))
            return bad_usage(fmt::format("--quantile {:g}: must be between 0 and 1; 5 % of the values are below the quantile 0.05", q));
    out.quantiles = args.quantiles;
    std::sort(out.quantiles.begin(), out.quantiles.end());
    out.quantiles.erase(std::unique(out.quantiles.begin(), out.quantiles.end()), out.quantiles.end());
    return out;
}

Result<void> show(const SweepShowArguments& args, const CommonArguments& common) {
    const auto options = TRY(summary_options(args));
    const auto results = TRY(SweepResults::open_read_only(args.results));
    remember_input(args.results);
    OutputCheck outputs(common.overwrite);
    if (!args.report_file.empty()) TRY(outputs.check_file(args.report_file, is_own_page));
    const auto table = TRY(read_table(results, args.measures));
    const auto samples = TRY(read_mismatch_samples(results));
    const auto summary = TRY(summary_of(table, samples, options));
    const auto title = title_of(results);
    if (!args.report_file.empty()) {
        const auto page = TRY(sweep_page(results, table, summary, title, common.command));
        TRY(write_file(args.report_file, page));
    }
    if (common.json)
        fmt::print("{}\n", json_text(document_of(table, summary, title)));
    else if (!common.quiet)
        print_text(sweep_tables(table, summary, title, !args.quantiles.empty()));
    return {};
}

}  // namespace

Verb make_sweep_show_verb() {
    const auto args = std::make_shared<SweepShowArguments>();
    return {.name = "show",
            .description = "analyse a results file: yields, distributions, most influential devices",
            .examples = show_examples,
            .options = {{"",
                         {required({"RESULTS", &args->results, "", "a results file; the sweep may still be running"}),
                          {"--by", &args->by, "AXIS",
                           "group the results by these axes (default: all listed axes); random axes are divided into five bands"},
                          suggesting(measure_names, {"--measure,-m", &args->measures, "NAME",
                                                     "analyse only these measures; limits of other measures are ignored"}),
                          {"--quantile", &args->quantiles, "FRACTION", "print this quantile with its confidence interval, such as 0.01"}}},
                        {"Output", {{"--report", &args->report_file, "FILE.html", "write a report page"}}}},
            .reports = true,
            .writes_files = true,
            .check = [args](const CommonArguments&) -> Result<void> { return check_page_name(args->report_file); },
            .run = [args](const CommonArguments& common) { return exit_status(show(*args, common)); }};
}

}  // namespace corpuscle
