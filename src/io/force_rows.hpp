#pragma once
// The rows of a recording in newtons. Reads blocks, passes each channel through its pipeline, and keeps the channels aligned although
// the pipelines have different delays.

#include <optional>
#include <string>
#include <vector>

#include "io/channel_path.hpp"
#include "io/rows.hpp"

namespace corpuscle {

class ForceRows {
    Rows rows_;
    std::vector<ChannelPath> paths_;
    std::string path_;                // of the file, for errors
    std::vector<std::string> names_;  // of the channels, for errors
    std::optional<GapFiller> times_;  // if each row has its own time
    SumCheck sums_;
    std::vector<std::vector<double>> block_;  // as read
    std::vector<std::vector<double>> ready_;  // for each channel, in newtons; then the times
    std::size_t taken_ = 0;                   // rows of ready_ that have been consumed
    bool ended_ = false;

    Error of_channel(std::size_t c, Error) const;
    Result<void> pull();

public:
    /// `rows` provides the channels in the order of `paths`. If `timed`, the next column is the time; otherwise it is ignored.
    ForceRows(Rows rows, std::vector<ChannelPath> paths, std::string path, std::vector<std::string> names, bool timed);

    /// Reads until a row is ready. Returns false at the end.
    Result<bool> more();
    std::size_t ready() const;
    double force(std::size_t channel) const { return ready_[channel][taken_]; }
    double time() const { return ready_.back()[taken_]; }  ///< as in the file; only if `timed`
    void next(std::size_t rows = 1) { taken_ += rows; }
    const double* ready_of(std::size_t channel) const { return ready_[channel].data() + taken_; }

    std::vector<ChannelPath>& paths() { return paths_; }
    const std::vector<ChannelPath>& paths() const { return paths_; }
    const Rows& rows() const { return rows_; }
    const SumCheck& sums() const { return sums_; }
};

}  // namespace corpuscle
