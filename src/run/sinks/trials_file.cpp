// trials.csv: a row for each trial and afferent, in a skin only for those that fired. Its start_s, stop_s and zero_s are on the clock of
// the input, and zero_s is the point of alignment. The measured part, from_s and to_s, is relative to zero_s. Every measure over this part
// follows. A field is empty if the measure has no value. The latency counts from zero_s.

#include <cmath>
#include <iterator>

#include "core/text/csv_field.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/trials/trial_collector.hpp"

namespace corpuscle {
namespace {

class TrialsFile final : public FileSink {
    const TrialCollector& trials_;
    std::size_t written_ = 0;  // responses
    fmt::memory_buffer text_;

    void put_cell(double x, const char* format) {
        text_.push_back(',');
        if (std::isfinite(x)) fmt::format_to(std::back_inserter(text_), fmt::runtime(format), x);
    }

    void put(const TrialResponse& response) {
        const auto& trial = trials_.responses.trials[response.trial];
        const auto& afferent = trials_.responses.afferents[response.afferent];
        fmt::format_to(std::back_inserter(text_), "{},{},{},{:.9f},{:.9f}", response.trial + 1, quote_csv_field(trial.label),
                       quote_csv_field(trials_.inputs[trial.input]), trial.start, trial.stop);
        for (const double x : {trial.zero, trial.from, trial.to}) put_cell(x, "{:.9f}");
        fmt::format_to(std::back_inserter(text_), ",{},{}", quote_csv_field(afferent.name), quote_csv_field(afferent.channel));
        for (const double x : response.values) put_cell(x, "{:.9g}");
        text_.push_back('\n');
    }

public:
    explicit TrialsFile(const OutputRequest& request) : FileSink(request), trials_(*request.trials) {}

    Result<void> open() {
        TRY(create("trials.csv"));
        std::string header = "trial,label,input,start_s,stop_s,zero_s,from_s,to_s,afferent,channel";
        for (const auto& m : measures) header += "," + quote_csv_field(measure_key(m));
        return files_[0].write(header + "\n");
    }

    Result<void> end(const Input&, std::int64_t, std::span<const Spike>) override {
        const auto& all = trials_.responses.responses;
        for (; written_ < all.size(); ++written_) {
            put(all[written_]);
            if (text_.size() >= std::size_t{1} << 16) TRY(write_text(text_));
        }
        return write_text(text_);
    }
};

}  // namespace

extern const OutputFormat trials_format = {
    .names = {"trials.csv"},
    .make = make_file_sink<TrialsFile>,
    .is_written = [](const OutputRequest& request) { return request.trials != nullptr; },
};

}  // namespace corpuscle
