#include "io/force_rows.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {

ForceRows::ForceRows(Rows rows, std::vector<ChannelPath> paths, std::string path, std::vector<std::string> names, bool timed)
    : rows_(std::move(rows)), paths_(std::move(paths)), path_(std::move(path)), names_(std::move(names)),
      ready_(paths_.size() + (timed ? 1 : 0)) {
    if (timed) times_.emplace();
}

std::size_t ForceRows::ready() const {
    std::size_t shortest = ready_[0].size();
    for (const auto& r : ready_) shortest = std::min(shortest, r.size());
    return shortest - taken_;
}

Error ForceRows::of_channel(std::size_t c, Error error) const {
    error.sentence = fmt::format("'{}': {}", c < names_.size() ? names_[c] : "time", error.sentence);
    if (error.place.file.empty()) error.place = {path_};
    return error;
}

/// Reads a block of rows and passes it through all pipelines. At the end of the file, flushes the pipelines.
Result<void> ForceRows::pull() {
    for (auto& r : ready_) r.erase(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(taken_));
    taken_ = 0;
    const auto rows = rows_.next(block_);
    if (!rows) return rows.error();
    ended_ = *rows == 0;
    sums_.add(block_, paths_.size());
    for (std::size_t c = 0; c < paths_.size(); ++c)
        if (auto ok = ended_ ? paths_[c].finish(ready_[c]) : paths_[c].push(block_[c], ready_[c]); !ok) return of_channel(c, ok.error());
    if (!times_) return {};
    if (auto ok = times_->push({block_.back().data(), *rows}, ready_.back()); !ok) return of_channel(paths_.size(), ok.error());
    if (ended_)
        if (auto ok = times_->finish(ready_.back()); !ok) return of_channel(paths_.size(), ok.error());
    return {};
}

Result<bool> ForceRows::more() {
    while (ready() == 0) {
        if (ended_) return false;
        if (auto ok = pull(); !ok) return ok.error();
    }
    return true;
}

}  // namespace corpuscle
