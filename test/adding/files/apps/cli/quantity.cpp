// corpuscle quantity: prints a quantity in SI units.

#include <fmt/format.h>

#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

struct QuantityArguments {
    std::string text, unit = "s";
};

Result<void> print_quantity(const QuantityArguments& args) {
    const double value = TRY(parse_quantity(args.text, args.unit));
    fmt::print("{:g}\n", value);
    return {};
}

}  // namespace

Verb make_quantity_verb() {
    const auto args = std::make_shared<QuantityArguments>();
    return {.name = "quantity",
            .description = "print a quantity in SI units",
            .examples = "Example:\n  corpuscle quantity 10ms",
            .options = {{"", {required({"QUANTITY", &args->text, "", "a number"}), {"--unit", &args->unit, "UNIT", "its unit"}}}},
            .run = [args](const CommonArguments&) { return exit_status(print_quantity(*args)); }};
}

}  // namespace corpuscle
