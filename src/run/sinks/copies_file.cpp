#include "run/sinks/copies_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/spikes/spike_files.hpp"
#include "run/summary/run_summary.hpp"

namespace corpuscle {

CopiesFile::CopiesFile(OutputFile file, const CopySpec& copies) : file_(std::move(file)) {
    for (const auto& s : copies.distributions) {
        auto at =
            std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.parameter == s.parameter && c.unit == s.unit; });
        if (at == columns_.end()) at = columns_.insert(at, Column{s.parameter, s.unit, {}});
        at->afferents.push_back(s.afferent);
    }
    std::string header = "afferent,channel";
    for (const auto& c : columns_)
        header += "," + quote_csv_field(c.unit.empty() ? std::string(c.parameter) : fmt::format("{}_{}", c.parameter, c.unit));
    for (const auto& m : measures) header += "," + quote_csv_field(measure_key(m));
    (void)file_.write(header + "\n");  // commit() reports an error
}

Result<void> CopiesFile::begin(const Input& input) {
    since_start_ = input.source.clock();
    since_start_.t0 = 0;
    tally_ = MeasureAccumulator({{.stimulus_frequency = input.source.cycle_frequency()}}, input.afferent_count());
    return {};
}

Result<void> CopiesFile::block(const Input& input, const RunBlock& block) {
    for (const auto& s : block.spikes) tally_.spike(s.afferent_index - input.first_afferent, since_start_.time(s.step, s.offset));
    return {};
}

void CopiesFile::put_row(const Input& input, std::size_t afferent_index) {
    const auto out = std::back_inserter(text_);
    const auto& plan = input.plan_of(afferent_index);
    fmt::format_to(out, "{},{}", quote_csv_field(plan.name), quote_csv_field(input.channel_name(input.channel_of(afferent_index))));
    for (const auto& c : columns_) {
        const bool differs = std::find(c.afferents.begin(), c.afferents.end(), plan.original_name) != c.afferents.end();
        differs ? fmt::format_to(out, ",{}", *plan.value(c.parameter)) : fmt::format_to(out, ",");
    }
    for (const double x : tally_.values(afferent_index, 0)) std::isfinite(x) ? fmt::format_to(out, ",{:.9g}", x) : fmt::format_to(out, ",");
    text_.push_back('\n');
}

Result<void> CopiesFile::end(const Input& input, std::int64_t samples) {
    tally_.set_end(since_start_.time(samples));
    for (std::size_t u = 0; u < input.afferent_count(); ++u) {
        put_row(input, u);
        // Writes in pieces of 64 KiB.
        if (text_.size() < std::size_t{1} << 16 && u + 1 < input.afferent_count()) continue;
        if (auto ok = file_.write({text_.data(), text_.size()}); !ok) return ok;
        text_.clear();
    }
    return {};
}

}  // namespace corpuscle
