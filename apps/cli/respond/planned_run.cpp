#include "cli/respond/planned_run.hpp"

#include "cli/arguments/force_argument.hpp"
#include "cli/output/terminal.hpp"

namespace corpuscle {

Result<Applied<std::unique_ptr<ForceSource>>> open_source(const std::string& force, const RespondArguments& args,
                                                          std::span<const ParameterOverride> overrides, double rate, bool quiet) {
    auto options = args.recording;
    Progress progress(quiet);
    options.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    return open_force(force, options, overrides, rate, args.simulation.seed);
}

}  // namespace corpuscle
