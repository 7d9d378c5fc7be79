#include "io/recording/force_rows.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {

ForceRows::ForceRows(RowReader rows, std::vector<ChannelPipeline> pipelines, std::string path, std::vector<std::string> names, bool timed)
    : rows_(std::move(rows)), pipelines_(std::move(pipelines)), path_(std::move(path)), names_(std::move(names)),
      ready_(pipelines_.size() + (timed ? 1 : 0)) {
    if (timed) times_.emplace();  // ready_ then has one more element, for the times
}

std::size_t ForceRows::ready_rows() const {
    std::size_t shortest = ready_[0].size();
    for (const auto& r : ready_) shortest = std::min(shortest, r.size());
    return shortest - consumed_;
}

Error ForceRows::channel_error(std::size_t c, Error error) const {
    error.message = fmt::format("'{}': {}", c < names_.size() ? names_[c] : "time", error.message);
    if (error.location.file.empty()) error.location = {path_};
    return error;
}

/// Reads a block of rows and passes it through all pipelines. At the end of the file, takes the remaining samples from the pipelines.
Result<void> ForceRows::read_block() {
    for (auto& r : ready_) r.erase(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(consumed_));
    consumed_ = 0;
    const auto rows = TRY(rows_.next(block_));
    ended_ = rows == 0;
    sums_.add(block_, pipelines_.size());
    for (std::size_t c = 0; c < pipelines_.size(); ++c)
        if (auto ok = ended_ ? pipelines_[c].finish(ready_[c]) : pipelines_[c].push(block_[c], ready_[c]); !ok)
            return channel_error(c, ok.error());
    if (!times_) return {};
    if (auto ok = times_->push({block_.back().data(), rows}, ready_.back()); !ok) return channel_error(pipelines_.size(), ok.error());
    if (ended_)
        if (auto ok = times_->finish(ready_.back()); !ok) return channel_error(pipelines_.size(), ok.error());
    return {};
}

Result<bool> ForceRows::fetch_row() {
    while (ready_rows() == 0) {
        if (ended_) return false;
        TRY(read_block());
    }
    return true;
}

}  // namespace corpuscle
