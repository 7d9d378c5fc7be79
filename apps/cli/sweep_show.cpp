// corpuscle sweep show: analyses a results file.

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/output_check.hpp"
#include "output_files.hpp"
#include "printable.hpp"
#include "report/sweep_page.hpp"
#include "signal/input_files.hpp"
#include "study/earlier_outputs.hpp"
#include "study/sweep/sweep_document.hpp"
#include "sweep_tables.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

Result<SweepSummaryOptions> question_of(const SweepShowArguments& words) {
    SweepSummaryOptions out;
    out.axes = words.by;
    if (words.quantiles.empty()) return out;
    for (const double q : words.quantiles)
        if (!(q > 0 && q < 1))
            return bad_usage(fmt::format("--quantile {:g}: must be between 0 and 1; 5 % of the values are below the quantile 0.05", q));
    out.quantiles = words.quantiles;
    std::sort(out.quantiles.begin(), out.quantiles.end());
    out.quantiles.erase(std::unique(out.quantiles.begin(), out.quantiles.end()), out.quantiles.end());
    return out;
}

Result<void> run(const SweepShowArguments& words, const CommonArguments& common) {
    const auto question = question_of(words);
    if (!question) return question.error();
    const auto results = SweepResults::open_read_only(words.results);
    if (!results) return results.error();
    remember_input(words.results);
    OutputCheck outputs(common.overwrite);
    if (!words.report_file.empty())
        if (auto ok = outputs.check_file(words.report_file, is_own_page); !ok) return ok;
    const auto table = read_table(*results, words.measures);
    if (!table) return table.error();
    std::optional<MismatchSamples> samples;
    if (const auto text = results->about(mismatch_metadata_name); !text.empty()) {
        auto read = parse_mismatch_samples(text);
        if (!read) return bad_input(read.error().message, {words.results});
        samples = std::move(*read);
    }
    const auto summary = summary_of(*table, samples, *question);
    if (!summary) return summary.error();
    const auto given_title = results->about("title");
    const auto title = given_title.empty() ? std::filesystem::path(words.results).stem().string() : given_title;
    if (!words.report_file.empty()) {
        const auto page = sweep_page(*results, *table, *summary, title, common.command);
        if (!page) return page.error();
        if (auto ok = write_file(words.report_file, *page); !ok) return ok;
    }
    if (common.json)
        fmt::print("{}\n", json_text(document_of(*table, *summary, title)));
    else if (!common.quiet)
        print_text(sweep_tables(*table, *summary, title, !words.quantiles.empty()));
    return {};
}

}  // namespace

int sweep_show(const SweepShowArguments& words, const CommonArguments& common) {
    const auto done = run(words, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
