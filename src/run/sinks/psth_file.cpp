// psth.csv of a run without trials: spikes in time bins of equal width, written bin after bin from the start of the input. from_s and to_s
// are on its clock. The first bin begins with the input; the last one ends with it, and may be shorter. A bin includes its start and
// excludes its end. A spike closer to an edge than 1e-9 bin widths counts as at the edge. On channels:
// afferent,channel,from_s,to_s,spikes,rate_Hz, with one line for each afferent. In a skin one line for each class in each region, with a
// column of the number of its afferents; the rate is the mean over them.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/text/quantity.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/sinks/trial_histogram_file.hpp"

namespace corpuscle {
namespace {

/// The value of --bin, s.
Result<double> bin_width_of(const OutputRequest& request) {
    const auto& text = request.options.at("--bin");
    const auto width = parse_quantity(text, "s");
    if (!width) return bad_usage(fmt::format("--bin {}", width.error().message));
    if (!(*width > 0)) return bad_usage(fmt::format("--bin {}: must be greater than 0, such as 10ms", text));
    return *width;
}

/// Returns an error if bins are shorter than a hundredth of the sample period, because almost all of them would be empty.
Result<void> check_bin_width(const Clock& clock, double bin_width) {
    const double min = 0.01 * clock.T();
    if (bin_width >= min * (1 - 1e-9)) return {};
    return bad_usage(fmt::format("--bin {}: shorter than a hundredth of the {} between samples; write {} or more",
                                 format_quantity(bin_width, "s"), format_quantity(clock.T(), "s"), format_quantity(min, "s")));
}

class PsthFile final : public FileSink {
    double bin_width_;  // s
    bool has_header_ = false;
    BinGroups groups_;                  // of the current input
    double t0_ = 0;                     // s, start of the current input on its own clock
    std::int64_t current_bin_ = 0;      // index of the current bin, from 0
    std::vector<std::int64_t> counts_;  // spikes in the current bin, for each group
    fmt::memory_buffer text_;           // lines of complete bins that are not yet written

    std::int64_t bin_index(double t) const { return static_cast<std::int64_t>(std::floor(t / bin_width_ + 1e-9)); }

    /// Completes the current bin, which ends at `to` (s since the start).
    void end_bin(double to) {
        const double from = static_cast<double>(current_bin_) * bin_width_;
        for (std::size_t g = 0; g < counts_.size(); ++g)
            fmt::format_to(std::back_inserter(text_), "{},{:.9f},{:.9f},{},{:.6g}\n", groups_.groups[g].names, t0_ + from, t0_ + to,
                           counts_[g], static_cast<double>(counts_[g]) / (to - from) / groups_.groups[g].afferents);
        counts_.assign(counts_.size(), 0);
        ++current_bin_;
    }

    void end_bins_before(std::int64_t bin) {
        while (current_bin_ < bin) end_bin(static_cast<double>(current_bin_ + 1) * bin_width_);
    }
    void count(const Input& input, std::span<const Spike> spikes) {
        for (const auto& s : spikes) {
            end_bins_before(bin_index(input.since_start(s)));
            ++counts_[groups_.group_of[input.afferent_of(s)]];
        }
    }

public:
    explicit PsthFile(const OutputRequest& request) : FileSink(request), bin_width_(*bin_width_of(request)) {}
    Result<void> open() { return create("psth.csv"); }

    Result<void> begin(const Input& input) override {
        TRY(check_bin_width(input.clock, bin_width_));
        groups_ = input.population.bin_groups();
        t0_ = input.clock.t0, current_bin_ = 0, counts_.assign(groups_.groups.size(), 0);
        if (std::exchange(has_header_, true)) return {};
        return files_[0].write(groups_.columns + ",from_s,to_s,spikes,rate_Hz\n");
    }

    /// Spikes of later blocks are after the last sample of this block.
    Result<void> block(const Input& input, const RunBlock& block) override {
        count(input, block.spikes);
        end_bins_before(bin_index(input.since_start(block.end_sample() - 1)));
        return write_text(text_);
    }
    /// Spikes that are still being conducted can arrive after the end of the force. The bins then end after the last one.
    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike> last) override {
        count(input, last);
        const double end = input.since_start(last.empty() ? samples : std::max(samples, last.back().step + 1));
        end_bins_before(std::max<std::int64_t>(static_cast<std::int64_t>(std::ceil(end / bin_width_ - 1e-9)) - 1, 0));
        end_bin(end);
        return write_text(text_);
    }
};

}  // namespace

extern const OutputFormat psth_format = {
    .names = {"psth.csv"},
    .option = "--bin",
    .value_name = "TIME",
    .help = "with --out, also write psth.csv: spike counts and rates in bins of this length; with trials, around their point of alignment",
    .make =
        [](const OutputRequest& request) {
            return request.trials ? make_trial_histogram_file(request, *bin_width_of(request)) : make_file_sink<PsthFile>(request);
        },
    .check =
        [](const OutputRequest& request) {
            const auto width = bin_width_of(request);
            return width ? Result<void>() : width.error();
        },
};

}  // namespace corpuscle
