#include "cli/sweep/sweep_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"

namespace corpuscle {
namespace {

/// Items that the writer has finished since it started. Its shard may be another one, so all saved items are counted.
double finished_by_writer(const SweepStatus& s) { return static_cast<double>(s.saved - s.writer->finished); }

/// Items that the writer has finished per second since it started; 0 if there is no writer or it has just started.
double rate_of(const SweepStatus& s) { return !s.writer || s.running_for < 1 ? 0 : finished_by_writer(s) / s.running_for; }

/// Seconds until the writer has finished the items that it planned. Only if rate_of() is not 0.
double seconds_left(const SweepStatus& s) { return (static_cast<double>(s.writer->planned) - finished_by_writer(s)) / rate_of(s); }

std::string writer_text(const SweepStatus& s) {
    auto text = fmt::format("Running: process {} on {}", s.writer->process, s.writer->host);
    if (const auto rate = rate_of(s); rate > 0) text += fmt::format(", {:.3g} items per second, {} left", rate, time_text(seconds_left(s)));
    return text + "\n";
}

/// A line that names the next command; "" while the sweep is running, or if the command is unknown.
std::string next_step(const SweepStatus& s) {
    if (s.writer) return "";
    if (s.missing() > 0)
        return s.sweep.empty() ? ""
                               : fmt::format("{} items are missing: 'corpuscle sweep {}' with the same options resumes the sweep\n",
                                             s.missing(), s.sweep);
    if (s.shard.shard_count > 1)
        return fmt::format(
            "This part is complete. When all {0} are complete: corpuscle sweep merge ALL.sqlite PART1.sqlite ... PART{0}.sqlite\n",
            s.shard.shard_count);
    return fmt::format("Analyse:  corpuscle sweep show {0}\nAll rows: corpuscle sweep dump {0}\n", s.results);
}

/// The status as a table, with the next command.
std::string sweep_status_text(const SweepStatus& s) {
    const auto completed = s.finished - s.truncated - s.diverged;
    TableRows rows = {{"items", "ended", "missing", "completed", "truncated", "diverged"},
                      table_row(s.items, s.finished, s.missing(), completed, s.truncated, s.diverged)};
    if (s.finished_now)
        rows[0].insert(rows[0].begin() + 2, "this run"), rows[1].insert(rows[1].begin() + 2, fmt::format("{}", *s.finished_now));
    if (s.iterations > 0) rows[0].push_back("iterations"), rows[1].push_back(fmt::format("{}", s.iterations));
    auto text = format_table(rows);
    for (const auto& [reason, items] : s.reasons) text += fmt::format("  {} of them: {}\n", items, reason);
    if (s.writer) text += writer_text(s);
    return text + (s.finished_now ? fmt::format("Written: {}\n", s.results) : "") + next_step(s);
}

nlohmann::ordered_json document_of(const SweepStatus& s) {
    nlohmann::ordered_json out = {{"results", s.results},   {"items", s.items},         {"finished", s.finished},
                                  {"missing", s.missing()}, {"truncated", s.truncated}, {"diverged", s.diverged}};
    out["iterations"] = s.iterations;
    if (s.finished_now) out["this_run"] = *s.finished_now;
    if (s.shard.shard_count > 1) out["shard"] = {{"index", s.shard.index + 1}, {"count", s.shard.shard_count}};
    auto& reasons = out["reasons"] = nlohmann::ordered_json::array();
    for (const auto& [reason, items] : s.reasons) reasons.push_back({{"reason", reason}, {"items", items}});
    if (!s.writer) return out;
    auto& writer = out["writer"] = {{"process", s.writer->process}, {"host", s.writer->host}};
    if (const auto rate = rate_of(s); rate > 0) writer["items_per_second"] = rate, writer["seconds_left"] = seconds_left(s);
    return out;
}

}  // namespace

void print_sweep_status(const CommonArguments& common, const SweepStatus& state) {
    if (common.json)
        fmt::print("{}\n", json_text(document_of(state)));
    else if (!common.quiet)
        print_text(sweep_status_text(state));
}

}  // namespace corpuscle
