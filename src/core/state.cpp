#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/afferent.hpp"
#include "core/checksum.hpp"

namespace corpuscle {
namespace {

static_assert(std::endian::native == std::endian::little, "packed states are little-endian");
/// "corpst", the version and a line break. Version 2 ends with a checksum of everything before it. Version 1 has none and can still be
/// read.
constexpr std::array<char, 8> magic = {'c', 'o', 'r', 'p', 's', 't', '2', '\n'};
constexpr std::size_t version_at = 6;  // position of the version in `magic`
constexpr std::uint64_t max_length =
    1U << 26;  // upper bound on the bytes of the format and on the number of values, to reject corrupt sizes

constexpr std::int64_t max_step = std::int64_t{1} << 53;  // a double counts samples exactly up to here

template <class T>
void put(std::vector<std::byte>& out, const T* data, std::size_t count) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    out.insert(out.end(), bytes, bytes + count * sizeof(T));
}

/// Moves values from the front of `in` to `data`. Returns false if `in` has too few bytes.
template <class T>
bool get(std::span<const std::byte>& in, T* data, std::size_t count) {
    if (in.size() < count * sizeof(T)) return false;
    if (count > 0) std::memcpy(data, in.data(), count * sizeof(T));
    in = in.subspan(count * sizeof(T));
    return true;
}

/// Checks the version and the checksum of a packed state. `all` are all its bytes, `head` the first eight of them, and `in` those after
/// `head`. Removes the checksum from the end of `in`.
Result<void> check_checksum(std::span<const std::byte> all, const std::array<char, 8>& head, std::span<const std::byte>& in) {
    if (head[version_at] == '1' && head.back() == '\n') return {};
    if (head != magic)
        return bad_input(
            "the saved afferent state has a version later than 2, the latest that this program reads; start from the "
            "beginning, or use the program that saved it");
    std::uint64_t sum = 0;
    if (in.size() < sizeof sum) return bad_input("the saved afferent state is incomplete");
    std::memcpy(&sum, all.data() + all.size() - sizeof sum, sizeof sum);
    if (sum != checksum_of(all.first(all.size() - sizeof sum)))
        return bad_input("the saved afferent state is damaged: its checksum is wrong; start from the beginning");
    in = in.first(in.size() - sizeof sum);
    return {};
}

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
    std::vector<std::byte> out;
    const std::array<std::uint64_t, 2> sizes = {s.format.size(), s.values.size()};
    put(out, magic.data(), magic.size());
    put(out, sizes.data(), sizes.size());
    put(out, &s.step, 1);
    put(out, s.format.data(), s.format.size());
    put(out, s.values.data(), s.values.size());
    const auto sum = checksum_of(out);
    put(out, &sum, 1);
    return out;
}

Result<State> unpack(std::span<const std::byte> in) {
    State s;
    std::array<char, 8> head = {};
    std::array<std::uint64_t, 2> sizes = {};
    const auto all = in;
    if (!get(in, head.data(), head.size()) || !std::equal(head.begin(), head.begin() + version_at, magic.begin()))
        return bad_input("not a saved afferent state: it does not begin with 'corpst'");
    TRY(check_checksum(all, head, in));
    if (!get(in, sizes.data(), 2) || !get(in, &s.step, 1) || sizes[0] > max_length || sizes[1] > max_length ||
        in.size() != sizes[0] + sizes[1] * sizeof(double))
        return bad_input("the saved afferent state is incomplete or too long");
    s.format.resize(sizes[0]);
    s.values.resize(sizes[1]);
    get(in, s.format.data(), s.format.size());  // cannot fail: the sizes were checked above
    get(in, s.values.data(), s.values.size());
    if (s.step < 0 || s.step > max_step)
        return bad_input("the saved afferent state is damaged: its sample number is " + std::to_string(s.step));
    if (first_non_finite(s.values) < s.values.size()) return bad_input("the saved afferent state is damaged: it contains NaN or infinity");
    return s;
}

}  // namespace corpuscle
