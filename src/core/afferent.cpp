#include "core/afferent.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/bytes.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// The magic text of a packed state. Version 2 ends with a checksum of everything before it. Version 1 has none and can still be read.
constexpr std::string_view magic = "corpst";
constexpr std::uint64_t max_length =
    1U << 26;  // upper bound on the bytes of the format and on the number of values, to reject corrupt sizes
constexpr std::int64_t max_step = std::int64_t{1} << 53;  // a double counts samples exactly up to here

/// State::format split at its version: "sa1b+lif-b/2, T = 0.0001 s" has before = "sa1b+lif-b", version = "2", after = ", T = 0.0001 s".
struct SplitFormat {
    std::string_view before, version, after;
};

/// Everything is in `before` if the format has no version.
SplitFormat split_format(std::string_view format) {
    const auto slash = format.rfind('/');
    if (slash == format.npos) return {format, {}, {}};
    const auto end = std::min(format.find_first_not_of("0123456789", slash + 1), format.size());
    return {format.substr(0, slash), format.substr(slash + 1, end - slash - 1), format.substr(end)};
}

/// The error for a state whose format, `found`, is not the `format` of the afferent that should resume from it.
Error format_mismatch(std::string_view name, std::string_view format, std::string_view found) {
    const auto expected = split_format(format), actual = split_format(found);
    if (expected.before != actual.before || expected.after != actual.after || expected.version == actual.version)
        return bad_input(fmt::format("a state of '{}' was given to '{}'", found, format));
    return bad_input(
        fmt::format("{}: the saved state has version {}, but this program reads version {}; start again with start(), which gives a "
                    "state of version {}, or continue with the program that saved it",
                    name, actual.version.empty() ? "0" : actual.version, expected.version, expected.version));
}

}  // namespace

std::size_t first_non_finite(std::span<const double> x) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000U;  // all bits of the exponent are 1 in infinity and NaN
    std::uint64_t found = 0;                                 // no branch in the loop, because almost always all values are finite
    for (const double v : x) found |= (std::bit_cast<std::uint64_t>(v) & exponent) == exponent;
    if (!found) return x.size();
    return static_cast<std::size_t>(std::find_if(x.begin(), x.end(), [](double v) { return !std::isfinite(v); }) - x.begin());
}

Result<void> check_block(std::string_view name, std::string_view format, std::size_t values, const State& state,
                         std::span<const double> force) {
    if (state.format != format) return format_mismatch(name, format, state.format);
    if (state.values.size() != values)
        return bad_input(fmt::format("{}: the saved state is damaged: it has {} values, expected {}. Start again with start()", name,
                                     state.values.size(), values));
    if (const auto bad = first_non_finite(force); bad < force.size())
        return bad_input(fmt::format("{}: the force of sample {} is {}, not a finite number", name,
                                     state.step + static_cast<std::int64_t>(bad), force[bad]));
    return {};
}

std::vector<std::byte> pack(const State& s) {
    ByteWriter<std::vector<std::byte>> out;
    out.put_raw("corpst2\n", magic.size() + 2);
    out.put(std::uint64_t{s.format.size()}, std::uint64_t{s.values.size()}, s.step);
    out.put_raw(s.format.data(), s.format.size());
    out.put_raw(s.values.data(), s.values.size() * sizeof(double));
    out.put_checksum();
    return out.take();
}

Result<State> unpack(std::span<const std::byte> bytes) {
    State s;
    ByteReader in(bytes);
    const auto version = read_magic(in, magic);
    if (!version) return bad_input("not a saved afferent state: it does not begin with 'corpst'");
    if (*version != '1' && *version != '2')
        return bad_input(
            "the saved afferent state has a version later than 2, the latest that this program reads; start from the "
            "beginning, or use the program that saved it");
    if (*version == '2' && in.rest().size() < sizeof(std::uint64_t)) return bad_input("the saved afferent state is incomplete");
    if (*version == '2' && !in.check_checksum(bytes))
        return bad_input("the saved afferent state is damaged: its checksum is wrong; start from the beginning");
    std::uint64_t letters = 0, values = 0;
    if (!in.get(letters, values, s.step) || letters > max_length || values > max_length ||
        in.rest().size() != letters + values * sizeof(double))
        return bad_input("the saved afferent state is incomplete or too long");
    s.format.resize(letters);
    s.values.resize(values);
    in.get_raw(s.format.data(), letters);  // cannot fail: the sizes were checked above
    in.get_raw(s.values.data(), values * sizeof(double));
    if (s.step < 0 || s.step > max_step)
        return bad_input("the saved afferent state is damaged: its sample number is " + std::to_string(s.step));
    if (first_non_finite(s.values) < s.values.size()) return bad_input("the saved afferent state is damaged: it contains NaN or infinity");
    return s;
}

std::string range_violation_message(const ValidRange& r, double outside, double total, double first) {
    return fmt::format("{} was outside {} to {} for {} of {}, first at {}{}{}", r.quantity, format_quantity(r.low, r.unit),
                       format_quantity(r.high, r.unit), format_quantity(outside, "s"), format_quantity(total, "s"),
                       format_quantity(first, "s"), r.meaning.empty() ? "" : ": ", r.meaning);
}

}  // namespace corpuscle
