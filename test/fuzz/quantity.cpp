// Arbitrary text as a quantity. Expected: a finite number that survives formatting and parsing, or an error with a message.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/text/quantity.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view units[] = {"", "s", "Hz", "N", "A/N", "A s/N", "V/s/A", "ohm", "F", "m/s"};
    if (size < 1) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1), unit = units[data[0] % std::size(units)];
    const auto value = parse_quantity(text, unit);
    if (!value) return value.error().message.empty() ? std::abort() : void(), 0;
    if (!std::isfinite(*value)) std::abort();
    const auto back = parse_quantity(format_quantity(*value, unit), unit);
    if (!back || std::abs(*back - *value) > 1e-3 * std::abs(*value)) std::abort();
    (void)parse_unit(text);
    return 0;
}
