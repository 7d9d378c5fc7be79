#pragma once
// A live stream put by, to go on from later: the skin's own state, the last force, the last frame's number.

#include <optional>
#include <string>

#include "live/frame_order.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

struct StreamState {
    std::vector<double> force;            ///< of the last frame, N
    std::optional<std::uint32_t> number;  ///< of the last frame, where frames are numbered
    std::vector<std::byte> skin;
};

std::vector<std::byte> packed(const StreamState&);
/// Refuses bytes that are no such state; errors name `file`.
Result<StreamState> unpacked(std::span<const std::byte>, const std::string& file);

Result<void> save_stream(const std::string& path, const StreamState&);
Result<StreamState> load_stream(const std::string& path);

}  // namespace corpuscle
