#pragma once
// Spikes as clicks in a sound file, as in nerve recordings.

#include <memory>

#include "run/sinks/file_sinks.hpp"

struct sf_private_tag;

namespace corpuscle {

/// spikes.wav for the first input, spikes-2.wav for the second: 44.1 kHz, 16 bits. Each spike is a click of one millisecond that begins on
/// the nearest frame of the sound. A frame is one sample for each ear. If one afferent was requested, the file is mono. If several were
/// requested, the first is placed on the left, the last on the right, the others between; copies have the position of their original. A new
/// click of an afferent cuts off its previous one. The level is so low that simultaneous clicks of all afferents do not clip.
class SpikeSoundFile final : public FileSink {
    struct SoundCloser {
        void operator()(sf_private_tag*) const;
    };
    struct Sound {
        OutputFile file;
        std::unique_ptr<sf_private_tag, SoundCloser> wav;  // closed before the file
    };
    std::string directory_;
    std::vector<Sound> sounds_;                  // one for each input so far
    std::size_t sound_channels_ = 1;             // 1 mono, 2 stereo
    std::vector<std::size_t> position_of_;       // for each plan: index of its position between left and right; copies share one
    std::vector<std::vector<int>> click_shape_;  // [position][frame * sound_channels_ + ear], 16-bit levels
    std::vector<std::int64_t> last_click_;       // for each afferent of the input: first frame of its last click
    std::int64_t written_ = 0;                   // number of frames written for the current input
    std::vector<int> pending_;                   // the frames after them, ears interleaved
    std::vector<short> out_;                     // the frames that are being written

    Result<void> shape_clicks(const Input&);
    void add_click(std::size_t afferent_index, std::size_t position, std::int64_t frame);
    Result<void> write_up_to(std::int64_t frame);

public:
    static constexpr int sample_rate = 44100;           // Hz
    static constexpr std::int64_t click_frames = 44;    // length of a click, 1 ms
    static constexpr double max_duration = 6 * 3600.0;  // s; the 4 GB limit of WAV allows 6.7 hours of stereo

    explicit SpikeSoundFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override;
    Result<void> commit() override;
};

}  // namespace corpuscle
