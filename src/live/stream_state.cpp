#include "live/stream_state.hpp"

#include <fmt/format.h>

#include "core/bytes.hpp"
#include "core/text/input_files.hpp"
#include "io/output/output_file.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view state_magic = "corplive";
/// A state of version 2 ends with a checksum of all bytes before it. A state of version 1 has no checksum; it can still be read.
constexpr std::uint32_t state_version = 2;

/// The head of a saved state. The forces and the state of the skin follow it. All are little-endian.
struct StateHead {
    char magic[8];
    std::uint32_t version, numbered, number, sites;  // numbered: 1 if StreamState::number is set; sites: number of forces
    std::uint64_t skin;                              // bytes of the state of the skin
};

}  // namespace

std::vector<std::byte> pack_stream(const StreamState& state) {
    StateHead head = {{},
                      state_version,
                      state.number.has_value(),
                      state.number.value_or(0),
                      static_cast<std::uint32_t>(state.force.size()),
                      state.skin.size()};
    std::memcpy(head.magic, state_magic.data(), sizeof head.magic);
    ByteWriter<std::vector<std::byte>> out;
    out.put(head);
    out.put_raw(state.force.data(), state.force.size() * sizeof(double));
    out.put_raw(state.skin.data(), state.skin.size());
    out.put_checksum();
    return out.take();
}

Result<StreamState> unpack_stream(std::span<const std::byte> bytes, const std::string& file) {
    StateHead head;
    ByteReader in(bytes);
    if (!in.get(head) || std::string_view(head.magic, sizeof head.magic) != state_magic)
        return bad_input("not a saved state of a stream: it does not begin with 'corplive'", {file});
    if (head.version < 1 || head.version > state_version)
        return bad_input(fmt::format("a saved state of version {}; this program reads versions 1 to {}. Start without --resume, or use the "
                                     "program that saved it",
                                     head.version, state_version),
                         {file});
    if (head.version >= 2 && in.rest().size() < sizeof(std::uint64_t))
        return bad_input("this saved state is truncated; start without --resume", {file});
    if (head.version >= 2 && !in.check_checksum(bytes))
        return bad_input("this saved state is damaged: its checksum is wrong; start without --resume", {file});
    const auto forces = head.sites * std::uint64_t{sizeof(double)};
    if (in.rest().size() < forces || in.rest().size() - forces != head.skin)
        return bad_input("this saved state is truncated or too long; start without --resume", {file});
    StreamState state;
    state.force.resize(head.sites), state.skin.resize(head.skin);
    in.get_raw(state.force.data(), forces), in.get_raw(state.skin.data(), head.skin);  // cannot fail: the sizes were checked above
    if (first_non_finite(state.force) < state.force.size())
        return bad_input("this saved state is damaged: a force is not a finite number", {file});
    if (head.numbered != 0) state.number = head.number;
    return state;
}

Result<void> save_stream(const std::string& path, const StreamState& state) {
    const auto bytes = pack_stream(state);
    return replace_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<StreamState> load_stream(const std::string& path) {
    const auto bytes = TRY(read_entire_input(path, std::size_t{1} << 34, "saved state"));
    return unpack_stream(std::as_bytes(std::span(bytes)), path);
}

}  // namespace corpuscle
