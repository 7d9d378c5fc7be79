#include "cli/respond/planned_run.hpp"

#include "cli/output/terminal.hpp"

namespace corpuscle {

Result<std::unique_ptr<ForceSource>> PlannedRun::open_source(const ForceArgument& force, double rate) {
    auto recording = args_.recording;
    Progress progress(common_.quiet);
    recording.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    auto source = TRY(force.open(recording, overrides_, rate, options_.seed));
    keep_unused(unused_, source.unused);
    return std::move(source.result);
}

}  // namespace corpuscle
