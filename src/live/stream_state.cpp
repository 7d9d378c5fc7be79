#include "live/stream_state.hpp"

#include <fmt/format.h>
#include <cstring>

#include "core/checksum.hpp"
#include "io/output/output_file.hpp"
#include "io/table/seekable_bytes.hpp"

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
    std::vector<std::byte> out(sizeof head + state.force.size() * sizeof(double));
    std::memcpy(out.data(), &head, sizeof head);
    if (!state.force.empty()) std::memcpy(out.data() + sizeof head, state.force.data(), state.force.size() * sizeof(double));
    out.insert(out.end(), state.skin.begin(), state.skin.end());
    const auto sum = checksum_of(out);
    const auto* const bytes = reinterpret_cast<const std::byte*>(&sum);
    out.insert(out.end(), bytes, bytes + sizeof sum);
    return out;
}

Result<StreamState> unpack_stream(std::span<const std::byte> bytes, const std::string& file) {
    StateHead head;
    if (bytes.size() < sizeof head || std::memcmp(bytes.data(), state_magic.data(), sizeof head.magic) != 0)
        return bad_input("not a saved state of a stream: it does not begin with 'corplive'", {file});
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.version < 1 || head.version > state_version)
        return bad_input(fmt::format("a saved state of version {}; this program reads versions 1 to {}. Start without --resume, or use the "
                                     "program that saved it",
                                     head.version, state_version),
                         {file});
    auto body = bytes.subspan(sizeof head);
    if (head.version >= 2) {
        std::uint64_t sum = 0;
        if (body.size() < sizeof sum) return bad_input("this saved state is truncated; start without --resume", {file});
        std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
        if (sum != checksum_of(bytes.first(bytes.size() - sizeof sum)))
            return bad_input("this saved state is damaged: its checksum is wrong; start without --resume", {file});
        body = body.first(body.size() - sizeof sum);
    }
    const auto forces = head.sites * std::uint64_t{sizeof(double)};
    if (body.size() < forces || body.size() - forces != head.skin)
        return bad_input("this saved state is truncated or too long; start without --resume", {file});
    StreamState state;
    state.force.resize(head.sites);
    if (forces > 0) std::memcpy(state.force.data(), body.data(), forces);
    if (first_non_finite(state.force) < state.force.size())
        return bad_input("this saved state is damaged: a force is not a finite number", {file});
    if (head.numbered != 0) state.number = head.number;
    state.skin.assign(body.begin() + static_cast<std::ptrdiff_t>(forces), body.end());
    return state;
}

Result<void> save_stream(const std::string& path, const StreamState& state) {
    const auto bytes = pack_stream(state);
    return replace_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<StreamState> load_stream(const std::string& path) {
    auto file = TRY(open_bytes(path));
    constexpr std::uint64_t max_size = std::uint64_t{1} << 34;  // bytes
    if (file->size() > max_size) return bad_input("this file is too large to be a saved state", {path});
    std::vector<std::byte> bytes(file->size());
    TRY(file->read(bytes));
    return unpack_stream(bytes, path);
}

}  // namespace corpuscle
