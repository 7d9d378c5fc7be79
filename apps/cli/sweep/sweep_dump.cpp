// corpuscle sweep dump: prints all rows of a results file as CSV.

#include <cstdio>

#include "cli/arguments/option_rows.hpp"
#include "cli/output/terminal.hpp"
#include "cli/sweep/sweep_verbs.hpp"
#include "sweep/store/dump.hpp"

namespace corpuscle {
namespace {

Result<void> dump(const std::string& path) {
    const auto results = SweepResults::open_read_only(path);
    if (!results) return results.error();
    bool written = true;
    auto ok = dump_results(*results, [&](const std::string& text) {
        written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
        return written && !interrupted();
    });
    if (ok && (!written || std::fflush(stdout) != 0)) return bad_input("cannot write to standard output");
    if (ok && interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
    return ok;
}

class SweepDumpVerb final : public Verb {
    std::string path_;

public:
    SweepDumpVerb()
        : Verb({"dump", "print all rows of a results file as CSV, in order, with spikes",
                "The output does not depend on how the sweep was run, so two dumps can be compared with 'cmp' or 'sha256sum'.\n\n"
                "Example:\n  corpuscle sweep dump chips.sqlite > chips.csv"}) {}

    void add_options_to(CLI::App& part, CommonArguments&) override {
        add_options(part, "", {{.names = "RESULTS", .target = &path_, .value = "", .description = "a results file", .is_required = true}});
    }

    int run(const CommonArguments&) override {
        catch_interrupt();
        return exit_status(dump(path_));
    }
};

}  // namespace

std::unique_ptr<Verb> make_sweep_dump_verb() { return std::make_unique<SweepDumpVerb>(); }

}  // namespace corpuscle
