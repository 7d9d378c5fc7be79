// corpuscle sweep merge: combines results files of one sweep.

#include <fmt/format.h>

#include "cli/output/terminal.hpp"
#include "cli/sweep/sweep_output.hpp"
#include "cli/verbs.hpp"

namespace corpuscle {
namespace {

struct SweepMergeArguments {
    std::string out;
    std::vector<std::string> in;
};

Result<void> merge_all(SweepResults& out, const std::vector<SweepResults>& in, const CommonArguments& common) {
    for (const auto& from : in) {
        if (interrupted()) return Error{ErrorCode::interrupted, "interrupted; the same command resumes"};
        const auto added = TRY(out.merge(from));
        if (!common.json && !common.quiet)
            print_text(fmt::format("{}: {} items, {} of them new\n", from.path(), from.finished_count(), added));
    }
    return {};
}

Result<void> merge(const SweepMergeArguments& args, const CommonArguments& common) {
    std::vector<SweepResults> in;
    for (const auto& path : args.in) {
        in.push_back(TRY(SweepResults::open_read_only(path)));
        TRY(in.back().check_same_sweep(in.front()));
    }
    auto out = TRY(SweepResults::open(args.out, in.front()));
    auto ok = merge_all(out, in, common);
    // A checkpoint also after an error, so that the items merged so far are in the file; the first error is returned.
    if (auto checkpointed = out.checkpoint(); ok) ok = checkpointed;
    if (!ok) return ok;
    const auto state = TRY(read_sweep_status(out, {}));
    print_sweep_status(common, state);
    return {};
}

}  // namespace

Verb make_sweep_merge_verb() {
    const auto args = std::make_shared<SweepMergeArguments>();
    return {.name = "merge",
            .description = "combine results files of one sweep, such as its shards",
            .examples =
                "Items that are already in OUT are not added twice. If an item differs, merge stops with an error that names it.\n\n"
                "Example:\n  corpuscle sweep merge chips.sqlite chips-1of3.sqlite chips-2of3.sqlite chips-3of3.sqlite",
            .options = {{"",
                         {required({"OUT", &args->out, "", "the combined results file, created if it does not exist"}),
                          required({"IN", &args->in, "", "results files"})}}},
            .reports = true,
            .run = interruptible(args, merge)};
}

}  // namespace corpuscle
