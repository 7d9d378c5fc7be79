#pragma once
// A recording's rows as newtons, one after another: read in blocks, each channel along its path, in step however long one of them waits.

#include <optional>
#include <string>
#include <vector>

#include "io/channel_path.hpp"
#include "io/rows.hpp"

namespace corpuscle {

class ForceRows {
    Rows rows_;
    std::vector<ChannelPath> paths_;
    std::string path_;                // of the file, and
    std::vector<std::string> names_;  // of the channels, for errors
    std::optional<GapFiller> times_;  // if rows stand at their own times
    SumCheck sums_;
    std::vector<std::vector<double>> block_;  // as read
    std::vector<std::vector<double>> ready_;  // of each channel, newtons; then the times
    std::size_t taken_ = 0;                   // of what is ready
    bool ended_ = false;

    Error of_channel(std::size_t c, Error) const;
    Result<void> pull();

public:
    /// `rows` give the channels of `paths` in their order and, if `timed`, the time behind them; else a column behind them is not used.
    ForceRows(Rows rows, std::vector<ChannelPath> paths, std::string path, std::vector<std::string> names, bool timed);

    /// Makes sure of a row; false at the end.
    Result<bool> more();
    std::size_t ready() const;
    double force(std::size_t channel) const { return ready_[channel][taken_]; }
    double time() const { return ready_.back()[taken_]; }  ///< as it stands in the file; of timed rows
    void next(std::size_t rows = 1) { taken_ += rows; }
    const double* ready_of(std::size_t channel) const { return ready_[channel].data() + taken_; }

    std::vector<ChannelPath>& paths() { return paths_; }
    const std::vector<ChannelPath>& paths() const { return paths_; }
    const Rows& rows() const { return rows_; }
    const SumCheck& sums() const { return sums_; }
};

}  // namespace corpuscle
