// psth.csv: spikes in time bins of equal width, written bin after bin from the start of the input. from_s and to_s are on its clock. For
// the edges of bins, see time_bins.hpp. On channels: afferent,channel,from_s,to_s,spikes,rate_Hz, with one line for each afferent. In a
// skin one line for each class in each region, with a column of the number of its afferents; the rate is the mean over them.

#include <algorithm>

#include "core/text/quantity.hpp"
#include "run/sinks.hpp"
#include "run/sinks/time_bins.hpp"

namespace corpuscle {
namespace {

class PsthFile final : public FileSink {
    double bin_width_;  // s
    bool has_header_ = false;
    std::vector<std::uint32_t> group_of_;  // for each afferent of the current input
    TimeBins bins_;

public:
    PsthFile(std::string directory, double bin_width) : FileSink(std::move(directory)), bin_width_(bin_width) {}
    Result<void> open() { return create("psth.csv"); }
    Result<void> begin(const Input& input) override {
        if (auto ok = TimeBins::check(input.clock, bin_width_); !ok) return ok;
        auto [columns, groups, group_of] = input.population.bin_groups();
        group_of_ = std::move(group_of);
        bins_ = TimeBins(std::move(groups), input.clock, bin_width_);
        if (std::exchange(has_header_, true)) return {};
        return files_[0].write(columns + ",from_s,to_s,spikes,rate_Hz\n");
    }
    Result<void> block(const Input& input, const RunBlock& block) override {
        for (const auto& s : block.spikes) bins_.count(s, group_of_[input.afferent_of(s)]);
        bins_.advance_to(block.end_sample() - 1);
        return files_[0].write(bins_.take_lines());
    }
    /// Spikes that are still being conducted can arrive after the end of the force. The bins then end after the last one.
    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike> last) override {
        for (const auto& s : last) bins_.count(s, group_of_[input.afferent_of(s)]);
        bins_.end(last.empty() ? samples : std::max(samples, last.back().step + 1));
        return files_[0].write(bins_.take_lines());
    }
};

/// The value of --bin, s.
Result<double> bin_width_of(const OutputRequest& request) {
    const auto& text = request.options.at("--bin");
    const auto width = parse_quantity(text, "s");
    if (!width) return bad_usage(fmt::format("--bin {}", width.error().message));
    if (!(*width > 0)) return bad_usage(fmt::format("--bin {}: must be greater than 0, such as 10ms", text));
    return *width;
}

}  // namespace

const OutputFormat psth_format = {
    .names = {"psth.csv"},
    .option = "--bin",
    .value_name = "TIME",
    .help = "with --out, also write psth.csv: spike counts and rates in bins of this length",
    .make = [](const OutputRequest& request) { return make_file_sink<PsthFile>(request.directory, *bin_width_of(request)); },
    .check =
        [](const OutputRequest& request) {
            const auto width = bin_width_of(request);
            return width ? Result<void>() : width.error();
        },
};

}  // namespace corpuscle
