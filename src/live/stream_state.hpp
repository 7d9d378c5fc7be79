#pragma once
// The saved state of a live stream: the state of the skin, the last force, the last frame number.

#include <optional>
#include <string>

#include "live/frame_sequence.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

struct StreamState {
    std::vector<double> force;            ///< of the last frame, N
    std::optional<std::uint32_t> number;  ///< of the last frame, if frames are numbered
    std::vector<std::byte> skin;
};

std::vector<std::byte> pack_stream(const StreamState&);
/// Refuses bytes that were not made by pack_stream(); errors name `file`.
Result<StreamState> unpack_stream(std::span<const std::byte>, const std::string& file);

Result<void> save_stream(const std::string& path, const StreamState&);
Result<StreamState> load_stream(const std::string& path);

}  // namespace corpuscle
