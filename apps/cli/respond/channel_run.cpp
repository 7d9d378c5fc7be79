#include "cli/respond/channel_run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "run/channels/channel_simulator.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/summary/nerve_limit.hpp"

namespace corpuscle {
namespace {

/// The number of simulated netlists: one for each copy on each channel of each source.
std::size_t netlist_count(const ChannelJob& job) {
    std::size_t count = 0;
    for (const auto& s : job.sources)
        for (const auto& a : job.copies) count += a.traits().may_diverge ? s->channels().size() : 0;
    return count;
}

}  // namespace

OutputRequest ChannelRun::output_request() const {
    OutputRequest request{.inputs = job_.sources.size(), .channels = 0, .plans = job_.copies, .copies = job_.copy_spec};
    for (const auto& s : job_.sources) request.channels += s->channels().size();
    return request;
}

Sink& ChannelRun::start_report() {
    const bool is_float = job_.options.precision == Precision::single_precision;  // records no probes
    return report_.emplace(RespondReport::max_total_points, job_.copy_spec, !is_float);
}

/// Also prints the notes and warnings that are known before the run.
Result<std::vector<std::unique_ptr<BlockSimulator>>> ChannelRun::simulators() {
    for (const auto& s : job_.sources)
        for (const auto& r : quiet_ ? std::vector<std::string>{} : s->notes()) print_message(fmt::format("{}: {}", s->name(), r));
    for (const auto& warning : job_.warnings) print_warning(warning);
    return make_channel_simulators(job_.sources, job_.copies);
}

/// Prints a warning and keeps it for summary and report page.
void ChannelRun::warn(std::string message) {
    print_warning(message);
    job_.warnings.push_back(std::move(message));
}

/// Warns of afferents that fire faster than a nerve fibre can; for each of them, the warning names the channel with the highest rate.
void ChannelRun::warn_of_rates() {
    constexpr auto peak = measure_index<PeakRate>;
    for (const auto& plan : job_.afferents) {
        const MeasureRow* fastest = nullptr;
        double rate = max_nerve_rate;
        for (const auto& row : summary_.rows())
            if (const double r = row.copy_statistics.empty() ? row.values[peak] : row.copy_statistics[peak].max;
                row.afferent == plan.name && r > rate)
                fastest = &row, rate = r;
        if (fastest) warn(fmt::format("{}: on {} {}", plan.name, fastest->channel, excessive_rate_warning(rate, plan, plan.name)));
    }
}

nlohmann::ordered_json ChannelRun::summarize(const RunStats& stats) {
    for (const auto& i : summary_.inputs()) {
        for (const auto& s : quiet_ ? std::vector<std::string>{} : i.quality.descriptions) print_message(fmt::format("{}: {}", i.name, s));
        for (const auto& s : i.quality.warnings) warn(fmt::format("{}: {}", i.name, s));
    }
    for (const auto& warning : response_warnings(stats)) warn(warning);
    warn_of_rates();
    auto result = summary_.document(job_.afferents, stats, job_.options, job_.warnings);
    if (job_.copy_spec.count > 0) result["copies"] = document_of(job_.copy_spec);
    for (const auto& s : silence_.silent_classes(job_.options)) {
        const auto& name = job_.afferents[s.class_index].name;
        if (!quiet_) print_message(silence_message(name, s));
        result["silent"].push_back({{"afferent", name},
                                    {"force_max_N", s.max_force},
                                    {"factor_to_fire", s.factor ? nlohmann::ordered_json(*s.factor) : nlohmann::ordered_json(nullptr)}});
    }
    return result;
}

std::string ChannelRun::page(const nlohmann::ordered_json& document) const {
    const auto costs = document.value("costs", nlohmann::ordered_json::array());
    return report_->page(summary_, job_.afferents, command_, job_.warnings, costs);
}

Result<void> ChannelRun::verdict(const RunStats& stats) const {
    if (stats.diverged.empty()) return {};
    auto error = stats.diverged[0];
    error.message =
        fmt::format("{} of {} netlists did not converge; the first: {}", stats.diverged.size(), netlist_count(job_), error.message);
    return error;
}

}  // namespace corpuscle
