#pragma once
// Spikes as clicks in a sound file, as in nerve recordings.

#include <memory>

#include "study/file_sinks.hpp"

struct sf_private_tag;

namespace corpuscle {

/// spikes.wav, and spikes-2.wav ... for further inputs: 44.1 kHz, 16 bits. A spike is a click of one millisecond that begins on the nearest
/// sample. One afferent gives a mono file. With several, the first is on the left, the last on the right, the others between; copies have
/// the position of their original. A new click of an afferent cuts off its previous one. The level is such that clicks of all afferents at
/// once do not clip.
class SpikeSoundFile final : public FileSink {
    struct SoundCloser {
        void operator()(sf_private_tag*) const;
    };
    struct Sound {
        OutputFile file;
        std::unique_ptr<sf_private_tag, SoundCloser> wav;  // closed before the file
    };
    std::string directory_;
    std::vector<Sound> sounds_;
    std::size_t sound_channels_ = 1;
    std::vector<std::size_t> position_of_;       // stereo position of each afferent; copies share one
    std::vector<std::vector<int>> click_shape_;  // [position][frame and ear]
    std::vector<std::int64_t> last_click_;       // frame of each afferent's last click
    std::int64_t written_ = 0;                   // frames
    std::vector<int> pending_;                   // frames not yet written, both ears interleaved
    std::vector<short> out_;

    Result<void> shape_clicks(const Input&);
    void add_click(std::size_t afferent_index, std::size_t position, std::int64_t frame);
    Result<void> write_up_to(std::int64_t frame);

public:
    static constexpr int sample_rate = 44100;           // Hz
    static constexpr std::int64_t click_frames = 44;    // length of a click
    static constexpr double max_duration = 6 * 3600.0;  // s: a longer stereo file exceeds the 4 GB limit of WAV

    explicit SpikeSoundFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override;
    Result<void> commit() override;
};

}  // namespace corpuscle
