// copies.csv: one row for each copy on each channel, input after input. The columns are afferent, channel, each parameter that differs
// between copies (f_B_Hz), and every measure over the complete input. A field is empty if the copies of this afferent do not differ in the
// parameter, or if the measure has no value. Parameters are written with all digits, so that they reproduce the copy's response.

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/text/csv_field.hpp"
#include "run/channels/channel_population.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/summary/run_summary.hpp"

namespace corpuscle {
namespace {

class CopiesFile final : public FileSink {
    struct Column {
        std::string_view parameter, unit;
        std::vector<std::string> afferents;  // names of the afferents whose copies differ in the parameter
    };
    std::vector<Column> columns_;  // of the parameters
    MeasureAccumulator tally_;     // the measures of every afferent of the current input; times since its start
    fmt::memory_buffer text_;

    /// Appends the row of an afferent to text_; the index is within the input, from 0.
    void put_row(const Input& input, std::size_t afferent_index) {
        const auto out = std::back_inserter(text_);
        const auto& plan = input.on_channels().plan_of(afferent_index);
        fmt::format_to(out, "{},{}", quote_csv_field(plan.name), quote_csv_field(input.population.channel_name(afferent_index)));
        for (const auto& c : columns_) {
            const bool differs = std::find(c.afferents.begin(), c.afferents.end(), plan.original_name) != c.afferents.end();
            differs ? fmt::format_to(out, ",{}", *plan.value(c.parameter)) : fmt::format_to(out, ",");
        }
        for (const double x : tally_.values(afferent_index, 0))
            std::isfinite(x) ? fmt::format_to(out, ",{:.9g}", x) : fmt::format_to(out, ",");
        text_.push_back('\n');
    }

public:
    explicit CopiesFile(const OutputRequest& request) : FileSink(request) {
        for (const auto& s : request.copies.distributions) {
            auto at = std::find_if(columns_.begin(), columns_.end(),
                                   [&](const Column& c) { return c.parameter == s.parameter && c.unit == s.unit; });
            if (at == columns_.end()) at = columns_.insert(at, Column{s.parameter, s.unit, {}});
            at->afferents.push_back(s.afferent);
        }
    }

    Result<void> open() {
        TRY(create("copies.csv"));
        std::string header = "afferent,channel";
        for (const auto& c : columns_)
            header += "," + quote_csv_field(c.unit.empty() ? std::string(c.parameter) : fmt::format("{}_{}", c.parameter, c.unit));
        for (const auto& m : measures) header += "," + quote_csv_field(measure_key(m));
        return files_[0].write(header + "\n");
    }

    Result<void> begin(const Input& input) override {
        tally_ = MeasureAccumulator({{.stimulus_frequency = input.cycle_frequency}}, input.population.size());
        return {};
    }

    Result<void> block(const Input& input, const RunBlock& block) override {
        for (const auto& s : block.spikes) tally_.spike(input.afferent_of(s), input.since_start(s));
        return {};
    }

    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike>) override {
        tally_.set_end(input.since_start(samples));
        for (std::size_t u = 0; u < input.population.size(); ++u) {
            put_row(input, u);
            // Writes in pieces of 64 KiB.
            if (text_.size() < std::size_t{1} << 16 && u + 1 < input.population.size()) continue;
            TRY(write_text(text_));
        }
        return {};
    }
};

}  // namespace

extern const OutputFormat copies_format = {
    .names = {"copies.csv"},
    .make = make_file_sink<CopiesFile>,
    .is_written = [](const OutputRequest& request) { return request.copies.count > 0; },
};

}  // namespace corpuscle
