#include "cli/respond/channel_run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle {
OutputRequest ChannelRun::output_request() const {
    OutputRequest request{.inputs = sources_.size(), .channels = 0, .plans = copies_, .copies = copy_spec_};
    for (const auto& s : sources_) request.channels += s->channels().size();
    return request;
}

Sink& ChannelRun::start_report() {
    const bool is_float = options_.precision == Precision::single_precision;  // records no probes
    return report_.emplace(RespondReport::max_total_points, copy_spec_, !is_float);
}

/// Also prints the notes and warnings that are known before the run.
Result<std::vector<std::unique_ptr<BlockSimulator>>> ChannelRun::simulators() {
    for (const auto& s : sources_) print_notes(s->name(), s->notes(), common_.quiet);
    for (const auto& warning : warnings_) print_warning(warning);
    return make_channel_simulators(sources_, copies_);
}

/// Prints a warning and keeps it for summary and report page.
void ChannelRun::warn(std::string message) {
    print_warning(message);
    warnings_.push_back(std::move(message));
}

/// Warns of afferents that fire faster than a nerve fibre can; for each of them, the warning names the channel with the highest rate.
void ChannelRun::warn_of_rates() {
    constexpr auto peak = measure_index<PeakRate>;
    for (const auto& plan : afferents_) {
        const MeasureRow* fastest = nullptr;
        double rate = max_nerve_rate;
        for (const auto& row : summary_.rows)
            if (const double r = row.copy_statistics.empty() ? row.values[peak] : row.copy_statistics[peak].max;
                row.afferent == plan.name && r > rate)
                fastest = &row, rate = r;
        if (fastest) warn(fmt::format("{}: on {} {}", plan.name, fastest->channel, excessive_rate_warning(rate, plan, plan.name)));
    }
}

nlohmann::ordered_json ChannelRun::summarize(const RunStats& stats) {
    for (const auto& i : summary_.inputs) {
        print_notes(i.name, i.quality.descriptions, common_.quiet);
        for (const auto& s : i.quality.warnings) warn(fmt::format("{}: {}", i.name, s));
    }
    for (const auto& warning : response_warnings(stats)) warn(warning);
    warn_of_rates();
    auto result = summary_.document(afferents_, stats, options_, warnings_);
    if (copy_spec_.count > 0) result["copies"] = document_of(copy_spec_);
    for (const auto& s : silence_.silent_classes(options_)) {
        const auto& name = afferents_[s.class_index].name;
        if (!common_.quiet) print_message(silence_message(name, s));
        result["silent"].push_back({{"afferent", name},
                                    {"force_max_N", s.max_force},
                                    {"factor_to_fire", s.factor ? nlohmann::ordered_json(*s.factor) : nlohmann::ordered_json(nullptr)}});
    }
    return result;
}

std::string ChannelRun::page(const nlohmann::ordered_json& document) const {
    const auto costs = document.value("costs", nlohmann::ordered_json::array());
    return report_->page(summary_, afferents_, common_.command, warnings_, costs);
}

/// The number of simulated netlists: one for each copy on each channel of each source.
std::size_t ChannelRun::netlist_count() const {
    std::size_t count = 0;
    for (const auto& s : sources_)
        for (const auto& a : copies_) count += a.traits().may_diverge ? s->channels().size() : 0;
    return count;
}

Result<void> ChannelRun::verdict(const RunStats& stats) const {
    if (stats.diverged.empty()) return {};
    auto error = stats.diverged[0];
    error.message = fmt::format("{} of {} netlists did not converge; the first: {}", stats.diverged.size(), netlist_count(), error.message);
    return error;
}

}  // namespace corpuscle
