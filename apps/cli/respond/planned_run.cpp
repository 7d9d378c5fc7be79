#include "cli/respond/planned_run.hpp"

#include <fmt/format.h>

#include "cli/arguments/recording_arguments.hpp"

namespace corpuscle {

Result<void> read_run_options(RespondOptions& options, const RespondArguments& args) {
    options.method = args.method == "exact" ? Method::exact : Method::backward_euler;
    options.sampled = args.sampled;
    options.precision = args.use_float ? Precision::single_precision : Precision::double_precision;
    const auto noise = optional_quantity(args.noise, "A", "--noise");
    if (!noise) return noise.error();
    if (noise->value_or(0) < 0)
        return bad_usage(fmt::format("--noise '{}' is negative; write a standard deviation, such as '50 nA'", *args.noise));
    options.noise = noise->value_or(0);
    options.seed = args.seed;
    return {};
}

}  // namespace corpuscle
