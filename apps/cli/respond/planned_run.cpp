#include "cli/respond/planned_run.hpp"

#include "cli/output/terminal.hpp"

namespace corpuscle {

Result<std::unique_ptr<ForceSource>> open_source(RespondJob& job, const ForceArgument& force, RecordingOptions recording, double rate,
                                                 bool quiet) {
    Progress progress(quiet);
    recording.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    auto source = TRY(force.open(recording, job.overrides, rate, job.options.seed));
    keep_unused(job.unused, source.unused);
    return std::move(source.result);
}

}  // namespace corpuscle
