// Arbitrary bytes from a connection, in chunks of any size. Expected: frames of finite forces within the limit, independent of the chunks.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "live/input/frame_decoder.hpp"

using namespace corpuscle;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

/// A column mapping in reverse order, with a scale for the length of each name. Rejects names if the first begins with x.
Result<FrameColumns> reversed_columns(std::span<const std::string> names) {
    FrameColumns columns;
    for (std::size_t k = names.size(); k-- > 0;) columns.order.push_back(static_cast<std::uint32_t>(k));
    for (const auto& name : names) columns.scales.push_back(name.size() % 2 == 0 ? 1 : 1e-3);
    if (names[0].starts_with('x')) return bad_input("no site has this name");
    return columns;
}

/// Forces of all frames, each followed by its number, or by -1 if it has none.
std::vector<double> decode_all(const FrameLayout& layout, std::span<const std::uint8_t> bytes, std::size_t chunk) {
    FrameDecoder decoder(layout, 1, reversed_columns);
    std::vector<double> all, force(layout.sites);
    while (!bytes.empty()) {
        const auto space = decoder.buffer();
        require(!space.empty());
        const auto count = std::min({space.size(), bytes.size(), chunk});
        std::copy_n(bytes.begin(), count, space.begin());
        decoder.add_bytes(count), bytes = bytes.subspan(count);
        for (auto found = decoder.next(); found != FrameDecoder::Status::nothing; found = decoder.next()) {
            if (found == FrameDecoder::Status::frame) require(decoder.read_forces(force) <= force.size());
            all.insert(all.end(), force.begin(), force.end());
            all.push_back(found == FrameDecoder::Status::frame && layout.stamp != FrameStamp::none ? decoder.number() : -1.0);
        }
    }
    for (const double f : force) require(std::abs(f) <= layout.limit);
    return all;
}

/// Decodes the same bytes as datagrams. Each must contain only complete frames, or is rejected; no partial frame may remain.
void check_datagrams(const FrameLayout& layout, std::span<const std::uint8_t> bytes, std::size_t chunk) {
    FrameDecoder decoder(layout, 1, reversed_columns);
    std::vector<double> force(layout.sites);
    while (!bytes.empty()) {
        const auto space = decoder.buffer();
        const auto count = std::min({space.size() - 1, bytes.size(), chunk});
        std::copy_n(bytes.begin(), count, space.begin());
        const bool is_complete = decoder.add_datagram(count);
        require(is_complete == (layout.kind == FrameKind::csv || count % layout.bytes() == 0));
        bytes = bytes.subspan(count);
        for (auto found = decoder.next(); found != FrameDecoder::Status::nothing; found = decoder.next())
            if (found == FrameDecoder::Status::frame) require(decoder.read_forces(force) <= force.size());
        require(!decoder.has_partial_frame());
    }
    for (const double f : force) require(std::abs(f) <= layout.limit);
    if (const auto& frame_error = decoder.first_error()) require(!describe_frame_error(*frame_error, layout, "hand").empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 3) return 0;
    FrameLayout layout;
    layout.kind = static_cast<FrameKind>(data[0] % 4), layout.stamp = static_cast<FrameStamp>(data[0] / 4 % 3);
    layout.sites = 1 + data[1] % 5, layout.scale = data[0] / 16 % 2 == 0 ? 1 : 1e-3;
    const std::span bytes(data + 3, size - 3);
    require(decode_all(layout, bytes, 1 + data[2]) == decode_all(layout, bytes, size));
    check_datagrams(layout, bytes, 1 + data[2]);
    return 0;
}
