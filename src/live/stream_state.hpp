#pragma once
// The saved state of a live stream: the last frame with its number, and the state of the skin.

#include "live/input/frame_layout.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

struct StreamState {
    std::vector<double> force;            ///< the forces of the last frame, N
    std::optional<std::uint32_t> number;  ///< the number of the last frame, if frames are numbered
    std::vector<std::byte> skin;          ///< the result of Skin::save()
};

std::vector<std::byte> pack_stream(const StreamState&);
/// Reads the bytes of pack_stream(). Other bytes, and unknown versions, are errors, which name `file`.
Result<StreamState> unpack_stream(std::span<const std::byte>, const std::string& file);

/// Writes a state to a file, which is replaced only when the new one is complete, or reads it from there.
Result<void> save_stream(const std::string& path, const StreamState&);
Result<StreamState> load_stream(const std::string& path);

}  // namespace corpuscle
