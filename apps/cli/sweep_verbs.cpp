#include "sweep_verbs.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "signal/version.hpp"
#include "word_groups.hpp"

namespace corpuscle {
namespace {

constexpr const char* sweep_examples =
    R"(FILE is a sweep file (TOML): what varies, how, how many, what is measured and what would pass; or a netlist with .mc and .step lines.
Results go into one SQLite file, a row a unit, NAME.sqlite for NAME.toml unless --out says another. A sweep may be stopped or killed at
any moment: the same command goes on with what is missing. Results are the same whoever ran a unit: threads, lanes, shards or ranks.

  afferent = "sa1-circuit"             # chips.toml
  force = "press"
  units = 1000
  [[vary]]
  what = "mismatch"

Examples:
  corpuscle sweep chips.toml                                        on all cores of this machine
  corpuscle sweep chips.toml --status                               how far it is, also from another window
  corpuscle sweep show chips.sqlite --report chips.html             means, yields, which device matters
  corpuscle sweep dump chips.sqlite > chips.csv                     every row, in order
  corpuscle sweep chips.toml --seed 2 --units 100 -o again.sqlite   other chips, fewer
  corpuscle sweep chips.toml --shard 1/3                            a third of it, on one of three machines (chips-1of3.sqlite) ...
  corpuscle sweep merge chips.sqlite chips-?of3.sqlite              ... and all three together
  mpirun --enable-recovery -n 64 corpuscle sweep chips.toml         64 processes, over machines; one that dies costs its block only
  sqlite3 chips.sqlite "SELECT ended, count(*) FROM units GROUP BY ended"

Exit status: 0 all units have ended (those capped or lost are told), 1 bad input, 2 bad usage, 3 not one unit converged, 130 interrupted.)";

constexpr const char* sweep_show_examples =
    R"(Shares and means come with their 95 % confidence intervals: of a yield Clopper and Pearson's, of a mean Student's, of a deviation
Bonett's (no distribution is assumed), of a quantile from one order statistic to another. doc/sweeps.md tells how they are read.

Examples:
  corpuscle sweep show chips.sqlite
  corpuscle sweep show chips.sqlite --by temp --measure spikes --quantile 0.01 --quantile 0.99
  corpuscle sweep show chips.sqlite --report chips.html
  corpuscle sweep show chips.sqlite --json)";

CLI::App& add_sweep(CLI::App& app, SweepWords& w, SweepMergeWords& m, std::string& dumped, Common& common) {
    auto& verb = *app.add_subcommand("sweep", "Monte Carlo, corners, any grid: many units -> one file of results");
    verb.footer(sweep_examples);
    verb.require_subcommand(0, 1);
    verb.add_option("FILE", w.file, "a sweep file (TOML), or a netlist with .mc and .step lines");
    verb.add_option("--out,-o", w.out, "the file of results (default: FILE's name, .sqlite, in this directory)")->type_name("RESULTS");
    verb.add_option("--threads,-j", w.threads,
                    "how many to use (0: one for each core; under mpirun one a rank); results do not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--lanes", w.lanes, "how many chips go side by side on a thread; results do not depend on it")
        ->check(CLI::IsMember({1, 4, 8}))
        ->capture_default_str()
        ->type_name("1|4|8");
    verb.add_option("--shard", w.shard, "do this part of it alone, the k-th of n: on several machines without MPI")->type_name("K/N");
    verb.add_option("--seed", w.seed, "in place of the file's")->type_name("N");
    verb.add_option("--units", w.units, "how many draws, in place of the file's")->check(CLI::PositiveNumber)->type_name("N");
    verb.add_flag("--status", w.status, "how far it is: what has ended, what is missing, how fast it goes");
    add_common(verb, common);

    auto& merge = *verb.add_subcommand("merge", "files of results of one sweep, such as its shards -> one file");
    merge.footer(
        "Nothing is counted twice: what is there already and the same is left, what differs is named and refused.\n\n"
        "Example:\n  corpuscle sweep merge chips.sqlite chips-1of3.sqlite chips-2of3.sqlite chips-3of3.sqlite");
    merge.add_option("OUT", m.out, "the file that all of it goes into; made if it is not there")->required();
    merge.add_option("IN", m.in, "files of results")->required();
    add_common(merge, common);

    auto& dump = *verb.add_subcommand("dump", "every row of a file of results as CSV, in order of unit, with spikes");
    dump.footer(
        "The same bytes whoever made the file: with 'cmp' or 'sha256sum' two can be held against one another.\n\n"
        "Example:\n  corpuscle sweep dump chips.sqlite > chips.csv");
    dump.add_option("RESULTS", dumped, "a file of results")->required();
    verb.callback([&verb, &w] {
        if (w.file.empty() && verb.get_subcommands().empty())
            throw CLI::RequiredError("corpuscle sweep: FILE, or one of merge, show, dump, calibrate");
    });
    return verb;
}

void add_sweep_show(CLI::App& sweep, SweepShowWords& w, Common& common) {
    auto& verb = *sweep.add_subcommand("show", "what a file of results says: yields, distributions, which device matters");
    verb.footer(sweep_show_examples);
    verb.add_option("RESULTS", w.results, "a file of results, also while it is written")->required();
    verb.add_option("--by", w.by, "point by point of these axes (default: all that are listed); one that is drawn is cut into five bands")
        ->allow_extra_args(false)
        ->type_name("AXIS");
    verb.add_option("--measure,-m", w.measures, "these measures alone; the limits of others are left aside")
        ->allow_extra_args(false)
        ->type_name("NAME");
    verb.add_option("--quantile", w.quantiles, "quantiles to be told with their intervals, such as 0.01")
        ->allow_extra_args(false)
        ->type_name("SHARE");
    verb.add_option("--report", w.report_file, "write a page to look at")->type_name("FILE.html")->group("Output");
    verb.callback([&w] {
        if (!w.report_file.empty() && !w.report_file.ends_with(".html")) throw CLI::ValidationError(page_name_needed(w.report_file));
    });
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_sweep_calibrate(CLI::App& sweep, SweepCalibrateWords& w, Common& common) {
    auto& verb = *sweep.add_subcommand("calibrate", "chips trimmed until they fire as a model does -> yields by the number of bits");
    verb.footer(
        "Each chip is pressed and its spikes are counted; those of a phase may be a quarter more or fewer than the model's and at least "
        "one,\n"
        "none before the force, the first within 10 ms. A chip beyond that is trimmed, coarse steps before fine ones, and pressed "
        "again.\n\n"
        "Examples:\n  corpuscle sweep calibrate sa1-circuit\n  corpuscle sweep calibrate fa1-circuit --units 200 --bits 6 --apart\n"
        "  corpuscle sweep calibrate own.cir --like sa1 --trim i_leak=50% --trim x1.m3.m+x1.m4.m=25%");
    verb.add_option("NETLIST", w.netlist, "sa1-circuit, fa1-circuit, or a netlist that is an afferent")->required();
    verb.add_option("--like", w.like, "the model (default: of sa1-circuit sa1, of fa1-circuit fa1)")->type_name("AFFERENT");
    verb.add_option(
            "--trim", w.trims,
            "what can be set, a .param or a device's number, several joined by +, and how much more the highest code gives; columns "
            "(.m) are whole (default: I_LEAK, I_BIASB and one gain)")
        ->type_name("NAME=RANGE");
    verb.add_option("--bits", w.bits, "of each trim, at the most")->check(CLI::Range(1, 12))->capture_default_str()->type_name("N");
    verb.add_option("--units", w.units, "how many chips")->check(CLI::PositiveNumber)->capture_default_str()->type_name("N");
    verb.add_option("--seed", w.seed, "of process and mismatch")->capture_default_str()->type_name("N");
    verb.add_option("--corner", w.corner, "the section of the card, mc has the spread of the process")->capture_default_str();
    verb.add_option("--force", w.force, "the stimulus")->capture_default_str()->type_name("STIMULUS");
    verb.add_flag("--apart", w.apart, "each trim by itself, too");
    verb.add_option("--threads,-j", w.threads, "how many to use (0: one for each core); results do not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    add_common(verb, common);
}

}  // namespace

void add_common(CLI::App& verb, Common& common) {
    verb.set_version_flag("--version", fmt::format("corpuscle {}", version))->group("");
    verb.add_flag("--json", common.json, "print one JSON document on standard output, and nothing else there");
    verb.add_flag("--quiet,-q", common.quiet, "print no table, no progress and no remarks; warnings stay");
}

void add_overwrite(CLI::App& verb, Common& common) {
    verb.add_flag("--overwrite", common.overwrite,
                  "replace output files that no earlier run wrote; files that are read are never replaced");
}

void SweepVerbs::add_to(CLI::App& app, Common& common) {
    verb_ = &add_sweep(app, sweep_, merge_, dumped_, common);
    add_sweep_show(*verb_, show_, common);
    add_sweep_calibrate(*verb_, calibrate_, common);
}

int SweepVerbs::run(const Common& common) const {
    return verb_->got_subcommand("merge")       ? sweep_merge(merge_, common)
           : verb_->got_subcommand("dump")      ? sweep_dump(dumped_, common)
           : verb_->got_subcommand("show")      ? sweep_show(show_, common)
           : verb_->got_subcommand("calibrate") ? sweep_calibrate(calibrate_, common)
                                                : sweep(sweep_, common);
}

}  // namespace corpuscle
