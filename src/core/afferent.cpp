#include "core/afferent.hpp"

#include <fmt/format.h>

#include "core/text/quantity.hpp"

namespace corpuscle {

std::string range_violation_message(const ValidRange& r, double outside, double total, double first) {
    return fmt::format("{} was outside {} to {} for {} of {}, first at {}{}{}", r.quantity, format_quantity(r.low, r.unit),
                       format_quantity(r.high, r.unit), format_quantity(outside, "s"), format_quantity(total, "s"),
                       format_quantity(first, "s"), r.meaning.empty() ? "" : ": ", r.meaning);
}

}  // namespace corpuscle
