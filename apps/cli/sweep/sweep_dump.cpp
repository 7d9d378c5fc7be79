// corpuscle sweep dump: prints all rows of a results file as CSV.

#include <cstdio>

#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {
namespace {

Result<void> dump(const std::string& path) {
    const auto results = TRY(SweepResults::open_read_only(path));
    bool written = true;
    auto ok = dump_results(results, [&](const std::string& text) {
        written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
        return written && !interrupted();
    });
    if (ok && (!written || std::fflush(stdout) != 0)) return bad_input("cannot write to standard output");
    if (ok && interrupted()) return interrupted_error();
    return ok;
}

}  // namespace

Verb make_sweep_dump_verb() {
    const auto args = std::make_shared<std::string>();
    return {.name = "dump",
            .description = "print all rows of a results file as CSV, in order, with spikes",
            .examples =
                "The output does not depend on how the sweep was run, so two dumps can be compared with 'cmp' or 'sha256sum'.\n\n"
                "Example:\n  corpuscle sweep dump chips.sqlite > chips.csv",
            .options = {{"", {required({"RESULTS", args.get(), "", "a results file"})}}},
            .run = [args](const CommonArguments&) {
                catch_interrupt();
                return exit_status(dump(*args));
            }};
}

}  // namespace corpuscle
