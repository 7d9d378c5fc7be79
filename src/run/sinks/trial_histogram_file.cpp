// psth.csv of a run with trials: a histogram for each label and each afferent, or each class and region of a skin. The times of a bin are
// relative to the point of alignment. Its rate is the mean over the trials that cover it, with its standard error. Its spikes are their
// sum.

#include "run/sinks/trial_histogram_file.hpp"

#include <cmath>
#include <iterator>

#include "core/text/csv_field.hpp"
#include "run/trials/trial_collector.hpp"

namespace corpuscle {
namespace {

class TrialHistogramFile final : public FileSink {
    const TrialCollector& trials_;
    double bin_width_;  // s
    fmt::memory_buffer text_;

    void put(const Histogram& histogram, bool has_sizes) {
        const auto& group = trials_.responses.groups[histogram.group];
        const auto names = quote_csv_field(histogram.label) + "," + quote_csv_field(group.name) + "," + quote_csv_field(group.channel) +
                           (has_sizes ? fmt::format(",{}", group.afferents) : "");
        const auto out = std::back_inserter(text_);
        const auto cell = [&](double x) { std::isfinite(x) ? fmt::format_to(out, ",{:.6g}", x) : fmt::format_to(out, ","); };
        for (const auto& bin : histogram.bins) {
            fmt::format_to(out, "{},{:.9f},{:.9f},{},{}", names, bin.from, bin.to, bin.rate.copies, bin.spikes);
            cell(bin.rate.mean()), cell(bin.standard_error());
            text_.push_back('\n');
        }
    }

public:
    TrialHistogramFile(const OutputRequest& request, double bin_width)
        : FileSink(request), trials_(*request.trials), bin_width_(bin_width) {}
    Result<void> open() { return create("psth.csv"); }

    Result<void> end(const Input& input, std::int64_t, std::span<const Spike>) override {
        if (input.index + 1 < input.input_count) return {};
        const bool has_sizes = input.population.skin() != nullptr;
        TRY(files_[0].write(
            fmt::format("label,afferent,channel,{}from_s,to_s,trials,spikes,rate_Hz,standard_error_Hz\n", has_sizes ? "afferents," : "")));
        const auto all = TRY(trials_.responses.histograms(bin_width_, trials_.options().window));
        for (const auto& histogram : all) {
            put(histogram, has_sizes);
            TRY(write_text(text_));
        }
        return {};
    }
};

}  // namespace

Result<std::unique_ptr<FileSink>> make_trial_histogram_file(const OutputRequest& request, double bin_width) {
    auto sink = std::make_unique<TrialHistogramFile>(request, bin_width);
    TRY(sink->open());
    return std::unique_ptr<FileSink>(std::move(sink));
}

}  // namespace corpuscle
