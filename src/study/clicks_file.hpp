#pragma once
// Spikes as clicks, to listen to as one listens to a nerve.

#include <memory>

#include "study/files.hpp"

struct sf_private_tag;

namespace corpuscle {

/// spikes.wav, and spikes-2.wav ... of further inputs: 44.1 kHz, 16 bits; a spike is a click of a millisecond that begins on the
/// nearest sample. One afferent is mono; the first of several sounds on the left, the last on the right, others between, copies
/// all from the place of what they are copies of. Clicks
/// of one unit cut each other short, and each is so loud that all units at once do not clip.
class ClicksFile final : public WrittenFile {
    struct Close {
        void operator()(sf_private_tag*) const;
    };
    struct Sound {
        OutputFile file;
        std::unique_ptr<sf_private_tag, Close> wav;  // closed before the file
    };
    std::string directory_;
    std::vector<Sound> sounds_;
    std::size_t ears_ = 1;
    std::vector<std::size_t> place_of_;    // each afferent's; copies of one share theirs
    std::vector<std::vector<int>> click_;  // [place][frame and ear]
    std::vector<std::int64_t> last_;       // each unit's last click's frame
    std::int64_t written_ = 0;             // frames
    std::vector<int> ahead_;               // what is not written yet, frame and ear
    std::vector<short> out_;

    Result<void> shape_clicks(const Input&);
    void click(std::size_t unit, std::size_t sound, std::int64_t frame);
    Result<void> write_up_to(std::int64_t frame);

public:
    static constexpr int rate = 44100;             // Hz
    static constexpr std::int64_t frames = 44;     // of a click
    static constexpr double longest = 6 * 3600.0;  // s: more in stereo is beyond the 4 GB of a WAV file

    explicit ClicksFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override;
    Result<void> commit() override;
};

}  // namespace corpuscle
