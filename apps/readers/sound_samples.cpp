// Reads sound files as samples with libsndfile.

#include <fmt/format.h>
#include <sndfile.h>

#include "helper_main.hpp"

namespace corpuscle {
namespace {

struct CloseSoundFile {
    void operator()(SNDFILE* f) const { sf_close(f); }
};

class SoundSamples final : public Samples {
    std::string path_;
    std::unique_ptr<SNDFILE, CloseSoundFile> file_;
    SF_INFO format_{};
    sf_count_t at_ = 0;           // index of the frame that the library reads next, from 0
    std::vector<double> frames_;  // of the last fetch(): all channels of each frame

    bool is_floating_point() const {
        const int kind = format_.format & SF_FORMAT_SUBMASK;
        return kind == SF_FORMAT_FLOAT || kind == SF_FORMAT_DOUBLE;
    }

public:
    explicit SoundSamples(std::string path) : path_(std::move(path)) {}

    Result<void> open(int file) {
        file_.reset(sf_open_fd(file, SFM_READ, &format_, SF_FALSE));
        if (!file_) return bad_input(fmt::format("not a readable sound file: {}", sf_strerror(nullptr)), {path_});
        if (format_.channels < 1) return bad_input("this sound file has no channel", {path_});
        if (format_.frames < 1) return bad_input("this sound file has no samples", {path_});
        info_.rows = format_.frames;
        if (format_.samplerate > 0) info_.rate = format_.samplerate;
        for (int c = 0; c < format_.channels; ++c)
            info_.columns.push_back({fmt::format("ch{}", c + 1), is_floating_point() ? "" : "full scale"});
        return {};
    }

    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> columns,
                       std::vector<std::vector<double>>& out) override {
        const auto width = info_.columns.size();
        if (at_ != first && sf_seek(file_.get(), first, SEEK_SET) != first)
            return bad_input(fmt::format("cannot seek to sample {}: {}", first + 1, sf_strerror(file_.get())), {path_});
        frames_.resize(rows * width);
        const auto count = sf_readf_double(file_.get(), frames_.data(), static_cast<sf_count_t>(rows));
        at_ = first + count;
        if (count < static_cast<sf_count_t>(rows))
            return bad_input(fmt::format("the file ends after {} of {} samples; it may be truncated", at_, format_.frames), {path_});
        for (std::size_t i = 0; i < columns.size(); ++i)
            for (std::size_t k = 0; k < rows; ++k) out[i][k] = frames_[k * width + columns[i]];
        return {};
    }
};

}  // namespace

SamplesResult open_sound_samples(int file, const std::string& path, const TableOptions&) {
    auto samples = std::make_unique<SoundSamples>(path);
    TRY(samples->open(file));
    return std::unique_ptr<Samples>(std::move(samples));
}

}  // namespace corpuscle
