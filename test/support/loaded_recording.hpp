#pragma once
// Loads a complete recording, or returns the error message if it cannot be read.

#include "io/recording/recording.hpp"
#include "support/support.hpp"

namespace corpuscle::test {

/// A recording with all its samples.
struct LoadedRecording {
    std::vector<std::string> names;          ///< of the channels
    std::vector<std::string> notes;          ///< for the user
    std::vector<std::vector<double>> force;  ///< [channel][sample], N
    Clock clock;
    std::vector<Channel> channels;
    RecordingQuality quality = {};
};

/// `block`: samples per read.
inline Result<LoadedRecording> try_load_recording(const std::string& path, const RecordingOptions& options = {}, std::size_t block = 7) {
    auto source = open_recording(path, options);
    if (!source) return source.error();
    LoadedRecording out{{}, {}, {}, (*source)->clock(), (*source)->channels()};
    for (const auto& c : out.channels) out.names.push_back(c.name);
    out.force.resize(out.names.size());
    for (Frames frames(out.names.size(), block);;) {
        if (auto ok = (*source)->read(frames); !ok) return ok.error();
        if (frames.count == 0) break;
        for (std::size_t c = 0; c < out.force.size(); ++c)
            out.force[c].insert(out.force[c].end(), frames.force[c].begin(),
                                frames.force[c].begin() + static_cast<std::ptrdiff_t>(frames.count));
    }
    out.notes = (*source)->notes();
    out.quality = (*source)->quality();
    return out;
}

/// The same; throws if the recording cannot be read.
inline LoadedRecording load_recording(const std::string& path, const RecordingOptions& options = {}, std::size_t block = 7) {
    return value_or_throw(try_load_recording(path, options, block));
}

/// The error message for a file that cannot be read, with the file's name instead of its path; "read" if it can be read.
inline std::string load_error(const std::string& path, const RecordingOptions& options = {}) {
    const auto result = try_load_recording(path, options);
    if (result) return "read";
    auto message = result.error().text();
    if (const auto at = message.find(path); at != std::string::npos)
        message.replace(at, path.size(), std::filesystem::path(path).filename().string());
    return message;
}

}  // namespace corpuscle::test
