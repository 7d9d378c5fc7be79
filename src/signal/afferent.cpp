#include "signal/afferent.hpp"

#include <fmt/format.h>

#include "signal/quantity.hpp"

namespace corpuscle {

std::string outside_sentence(const Range& r, double outside, double total, double first) {
    return fmt::format("{} was outside {} to {} for {} of {}, first at {}{}{}", r.of, format_quantity(r.low, r.unit),
                       format_quantity(r.high, r.unit), format_quantity(outside, "s"), format_quantity(total, "s"),
                       format_quantity(first, "s"), r.meaning.empty() ? "" : ": ", r.meaning);
}

}  // namespace corpuscle
