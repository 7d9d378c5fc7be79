#include "io/recording/force_rows.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {
namespace {

/// The number of rows in a block of this many columns. It is smaller for many columns, so that a block needs at most about 32 MB.
std::size_t rows_for(std::size_t columns) { return std::clamp<std::size_t>((std::size_t{1} << 22) / (columns + 1), 1, rows_per_block); }

}  // namespace

void ForceLevels::add(std::span<const double> force) {
    double low = min, high = max;  // local variables stay in registers, members would not
    std::int64_t below_count = 0, above_count = 0, negative_count = 0;
    for (const double F : force) {
        low = F < low ? F : low, high = F > high ? F : high;
        below_count += F < 0.2, above_count += F > 4, negative_count += F < 0;
    }
    min = low, max = high, below_range += below_count, above_range += above_count, negative += negative_count;
    count += static_cast<std::int64_t>(force.size());
}

Result<ChannelFilters> make_channel_filters(const RecordingOptions& options, const Clock& clock) {
    ChannelFilters filters;
    for (const double f : options.notch) filters.biquads.push_back(TRY(Biquad::notch(f, clock)));
    if (options.lowpass) filters.biquads.push_back(TRY(Biquad::lowpass(*options.lowpass, clock)));
    if (options.zero) filters.rest = TRY(RestLevel::make(*options.zero, clock));
    if (options.deadband) TRY(filters.add_deadband(*options.deadband, clock));
    return filters;
}

ChannelPipeline::ChannelPipeline(const RecordingOptions& options, const ChannelScale& scale, bool filters_rows, const HumTable& table)
    : offset_(scale.offset), gain_(scale.gain), filters_rows_(filters_rows), hum(table) {
    if (options.despike) outlier_filter_.emplace(*options.despike);
}

Result<ChannelPipeline> ChannelPipeline::make(const RecordingOptions& options, const ChannelScale& scale, const Clock& filter_clock,
                                              bool filters_rows, const HumTable& table) {
    ChannelPipeline pipeline(options, scale, filters_rows, table);
    pipeline.filters_ = TRY(make_channel_filters(options, filter_clock));
    return pipeline;
}

Result<void> ChannelPipeline::repair(std::span<const double> values) {
    if (outlier_filter_) {
        despiked_.clear();
        for (const double x : values) outlier_filter_->push(x, despiked_);
        values = despiked_;
    }
    return gaps_.push(values, repaired_);
}

/// Converts the repaired samples to newtons and appends them to `out`. The detectors examine the samples before they are filtered, because
/// the filters hide faults.
void ChannelPipeline::append(std::vector<double>& out) {
    for (double& x : repaired_) x = gain_ * (x - offset_);
    outliers.add(repaired_);
    saturation.add(repaired_);
    if (filters_rows_) filter(repaired_);
    out.insert(out.end(), repaired_.begin(), repaired_.end());
    repaired_.clear();
}

Result<void> ChannelPipeline::push(std::span<const double> values, std::vector<double>& out) {
    TRY(repair(values));
    append(out);
    return {};
}

Result<void> ChannelPipeline::finish(std::vector<double>& out) {
    despiked_.clear();
    if (outlier_filter_) outlier_filter_->finish(despiked_);
    TRY(gaps_.push(despiked_, repaired_));
    TRY(gaps_.finish(repaired_));
    append(out);
    return {};
}

void ChannelPipeline::filter(std::span<double> force) {
    if (!filters_.biquads.empty())
        for (double& x : force) x = filters_.smooth(x);
    noise.add(force);
    if (filters_.rest.is_used() || filters_.deadband.is_used())
        for (double& x : force) x = filters_.hold(x);
}

void ChannelPipeline::finish_force(std::span<double> force) {
    if (!filters_rows_) filter(force);
    hum.add(force);
    levels.add(force);
}

RowReader::RowReader(Table& table, const RecordingOptions& options, std::vector<std::size_t> channels, std::optional<std::size_t> time)
    : table_(table), options_(options), columns_(std::move(channels)), channels_(columns_.size()) {
    if (time) columns_.push_back(*time);
    table_.allow_gaps(options_.bad_fields.value_or(BadFields::error) != BadFields::error);
}

/// Replaces the values outside --range by gaps (NaN). With --bad-fields error, such a value is an error.
Result<void> RowReader::apply_range(std::size_t rows, std::vector<std::vector<double>>& block) {
    if (!options_.range) return {};
    const auto [low, high] = *options_.range;
    for (std::size_t c = 0; c < channels_; ++c)
        for (std::size_t k = 0; k < rows; ++k) {
            double& x = block[c][k];
            if (std::isnan(x) || (x >= low && x <= high)) continue;
            if (options_.bad_fields == BadFields::error)
                return bad_input(fmt::format("'{}': {:g} is outside --range {:g}..{:g}", table_.columns()[columns_[c]].name, x, low, high),
                                 table_.location(k));
            x = std::numeric_limits<double>::quiet_NaN();
            ++out_of_range;
        }
    return {};
}

/// Removes rows with gaps from the block. Returns the number of remaining rows.
std::size_t RowReader::drop_incomplete(std::size_t rows, std::vector<std::vector<double>>& block) {
    std::size_t kept = 0;
    table_rows_.clear();
    for (std::size_t k = 0; k < rows; ++k) {
        if (std::any_of(block.begin(), block.end(), [&](const auto& column) { return std::isnan(column[k]); })) continue;
        for (auto& column : block) column[kept] = column[k];
        table_rows_.push_back(k);
        ++kept;
    }
    dropped += static_cast<std::int64_t>(rows - kept);
    return kept;
}

Result<std::size_t> RowReader::next(std::vector<std::vector<double>>& block) {
    block.resize(columns_.size());
    for (;;) {
        const auto read = TRY(table_.read(columns_, rows_for(columns_.size()), block));
        if (options_.absolute)
            for (std::size_t c = 0; c < channels_; ++c)
                std::transform(block[c].begin(), block[c].begin() + static_cast<std::ptrdiff_t>(read), block[c].begin(),
                               [](double x) { return std::abs(x); });
        TRY(apply_range(read, block));
        const std::size_t kept = drops_rows() ? drop_incomplete(read, block) : read;
        for (auto& column : block) column.resize(kept);
        if (kept > 0 || read == 0) return kept;
    }
}

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
