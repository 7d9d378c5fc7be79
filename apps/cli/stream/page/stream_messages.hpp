#pragma once
// The messages of a page server about a stream, in the format of doc/page-protocol.md.

#include "live/serve/page_server.hpp"
#include "live/skin_stream.hpp"

namespace corpuscle {

/// The first message: the population, with the positions of its sites and afferents.
std::vector<std::byte> encode_stream_greeting(const SkinStream&, std::int64_t force_interval);
/// Forces and spikes.
std::vector<std::byte> encode_frames(const FrameBatch&, const Clock&);
/// Messages that were lost, or the reason why the connection ends.
std::vector<std::byte> encode_notice(const ServerNotice&);
/// The last message of a stream.
std::vector<std::byte> encode_stream_end(std::int64_t frames, std::int64_t spikes);

}  // namespace corpuscle
