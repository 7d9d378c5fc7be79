#include "io/recording/samples.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

namespace corpuscle {
namespace {

constexpr std::size_t max_transposed_numbers = std::size_t{1} << 27;  // they need one gigabyte

/// Samples of a transposed text table, in memory.
class MemorySamples final : public Samples {
    std::vector<std::vector<double>> channels_;  // for each channel, its samples
    std::vector<SourceLocation> locations_;      // for each channel, the location of its row in the file
    std::size_t names_;  // number of fields before the first sample of a row: 1 if rows begin with a name, otherwise 0

public:
    MemorySamples(SamplesInfo info, std::vector<std::vector<double>> channels, std::vector<SourceLocation> locations, std::size_t names)
        : channels_(std::move(channels)), locations_(std::move(locations)), names_(names) {
        info_ = std::move(info);
    }
    Error bad_value(std::int64_t row, std::size_t column, double, const std::string&) const override {
        return bad_input(fmt::format("field {} is not a number; use --bad-fields interpolate to fill it in, or --bad-fields drop to skip "
                                     "this sample in all channels",
                                     static_cast<std::size_t>(row) + names_ + 1),
                         locations_[column]);
    }
    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        for (std::size_t i = 0; i < wanted.size(); ++i)
            std::copy_n(channels_[wanted[i]].begin() + static_cast<std::ptrdiff_t>(first), rows, out[i].begin());
        return {};
    }
};

}  // namespace

Result<std::unique_ptr<Table>> transpose_table(std::unique_ptr<Table> table, const std::string& path) {
    const auto row_names = TRY(table->row_names());
    TRY(table->rewind());
    const std::size_t names = row_names.empty() ? 0 : 1;
    std::vector<std::size_t> all(table->columns().size() - names);
    std::iota(all.begin(), all.end(), names);
    std::vector<std::vector<double>> block(all.size()), channels;
    std::vector<SourceLocation> locations;
    table->allow_gaps(true);  // the new table treats gaps when the channels are read
    for (;;) {
        const auto rows = TRY(table->read(all, 64, block));
        if (rows == 0) break;
        for (std::size_t k = 0; k < rows; ++k) {
            channels.emplace_back(all.size());
            locations.push_back(table->location(k));
            for (std::size_t c = 0; c < all.size(); ++c) channels.back()[c] = block[c][k];
        }
        if (channels.size() * all.size() > max_transposed_numbers)
            return bad_input(fmt::format("--transpose: the table has more than {} numbers; save it with one row for each sample instead",
                                         max_transposed_numbers),
                             {path});
    }
    SamplesInfo info;
    info.rows = static_cast<std::int64_t>(all.size());
    info.columns = columns_named_after("", channels.size());
    for (std::size_t c = 0; c < std::min(channels.size(), row_names.size()); ++c) info.columns[c] = parse_heading(row_names[c]);
    return make_table(
        std::unique_ptr<Samples>(std::make_unique<MemorySamples>(std::move(info), std::move(channels), std::move(locations), names)), path);
}

}  // namespace corpuscle
