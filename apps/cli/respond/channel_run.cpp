#include "cli/respond/channel_run.hpp"

#include <algorithm>

#include "cli/output/terminal.hpp"
#include "run/afferent_plan.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;  // Hz, sample rate of stimuli

/// Returns an error if one of the requested probes is in none of the netlists. `found`: for each netlist, what became of the probes.
Result<void> check_probes(std::span<const std::string> names, std::span<const std::vector<RequestedProbe>> found) {
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (found.empty())
            return bad_usage(fmt::format("--probe {}: there is no netlist in this run; try --afferent sa1-circuit", names[k]));
        if (std::none_of(found.begin(), found.end(), [&](const auto& of_netlist) { return of_netlist[k].name.has_value(); }))
            return bad_input(
                fmt::format("--probe {}: no netlist of this run has such a node or device{}", names[k], found.front()[k].hint));
    }
    return {};
}

}  // namespace

/// Makes the copies of the afferents. Each of spreads_ is for one afferent.
Result<void> ChannelRun::add_copies() {
    if (copy_spec_.count == 0) {
        copies_ = afferents_;
        return spreads_.empty() ? Result<void>() : bad_usage(fmt::format("{} needs --copies N, such as --copies 100", spreads_[0].typed));
    }
    std::vector<std::string_view> names;
    for (const auto& afferent : afferents_) {
        names.push_back(afferent.name);
        auto applied = TRY(distributions_for(afferent, spreads_));
        spreads_ = std::move(applied.unused);
        auto copies = TRY(make_copies(afferent, copy_spec_.count, applied.result, options_.seed));
        std::move(copies.begin(), copies.end(), std::back_inserter(copies_));
        std::move(applied.result.begin(), applied.result.end(), std::back_inserter(copy_spec_.distributions));
    }
    return check_all_used(spreads_, names);
}

/// Returns an error if there are more afferents than 32-bit indexes.
Result<void> ChannelRun::check_afferent_count() const {
    std::uint64_t count = 0;
    for (const auto& s : sources_) count += s->channels().size() * copies_.size();
    if (count <= std::numeric_limits<std::uint32_t>::max()) return {};
    return bad_usage(
        fmt::format("--copies {}: {} afferents over all channels are too many; use fewer copies or channels", copy_spec_.count, count));
}

/// Returns an error if an override was not applied to any afferent or stimulus.
Result<void> ChannelRun::check_overrides() const {
    std::vector<std::string_view> names;
    for (const auto& a : afferents_) names.push_back(a.name);
    for (const auto& s : sources_) names.push_back(s->name());
    return check_all_used(unused_, names);
}

Result<void> ChannelRun::plan_afferents() {
    const auto& probes = args_.netlists.probes;
    std::vector<std::vector<RequestedProbe>> found;
    for (const auto& name : args_.afferents) {
        auto planned = TRY(plan_any_afferent(name, overrides_, probes));
        if (std::any_of(afferents_.begin(), afferents_.end(), [&](const auto& a) { return a.name == planned.result.name; }))
            return bad_usage(fmt::format("--afferent {}: {} is given twice", name, planned.result.name));
        keep_unused(unused_, planned.unused);
        afferents_.push_back(std::move(planned.result));
        if (!planned.probes.empty()) found.push_back(std::move(planned.probes));
    }
    return check_probes(probes, found);
}

Result<void> ChannelRun::plan() {
    if (args_.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    spreads_ = args_.spreads;
    copy_spec_.count = args_.copies;
    overrides_ = args_.netlists.overrides;  // first, so that a setting for one netlist takes precedence
    overrides_.insert(overrides_.end(), args_.settings.begin(), args_.settings.end());
    unused_ = overrides_;
    TRY(plan_afferents());
    TRY(add_copies());
    for (const auto& force : args_.forces) sources_.push_back(TRY(open_source(force, default_rate)));
    TRY(check_overrides());
    TRY(check_afferent_count());
    warnings_ = rate_warnings(sources_, afferents_);
    for (auto& warning : noise_warnings(afferents_, options_.noise)) warnings_.push_back(std::move(warning));
    return {};
}

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

void ChannelRun::warn_of_sensor_noise() {
    std::vector<NoiseSubject> subjects;
    for (const auto& a : afferents_) subjects.push_back({a.name, &a});
    for (const auto& source : sources_)
        if (const auto text = sensor_noise_warning(*source, subjects, options_.for_clock(source->clock())); !text.empty())
            warn(fmt::format("{}: {}", source->name(), text));
}

/// Warns of afferents that fire faster than a nerve fibre can; for each of them, the warning names the channel with the highest rate.
void ChannelRun::warn_of_rates() {
    constexpr auto peak = measure_index<PeakRate>;
    const auto rate_of = [](const MeasureRow& row) {
        if (row.has_unresolved_rate) return std::numeric_limits<double>::infinity();
        return row.copy_statistics.empty() ? row.values[peak] : row.copy_statistics[peak].max;
    };
    const double T = sources_[0]->clock().T();
    for (const auto& plan : afferents_) {
        const MeasureRow* fastest = nullptr;
        double rate = max_nerve_rate;
        for (const auto& row : summary_.rows)
            if (const double r = rate_of(row); row.afferent == plan.name && r > rate) fastest = &row, rate = r;
        if (fastest) warn(fmt::format("{}: on {} {}", plan.name, fastest->channel, excessive_rate_warning(rate, T, plan, plan.name)));
    }
}

nlohmann::ordered_json ChannelRun::summarize(const RunStats& stats) {
    for (const auto& i : summary_.inputs) {
        print_notes(i.name, i.quality.descriptions, common_.quiet);
        for (const auto& s : i.quality.warnings) warn(fmt::format("{}: {}", i.name, s));
    }
    warn_of_sensor_noise();
    for (const auto& warning : response_warnings(stats)) warn(warning);
    warn_of_rates();
    auto result = summary_.document(afferents_, stats, options_, warnings_);
    if (copy_spec_.count > 0) result["copies"] = document_of(copy_spec_);
    for (const auto& s : silence_.silent_classes(options_)) {
        const auto& name = afferents_[s.class_index].name;
        const auto advice = nerve_advice(afferents_[s.class_index]);
        if (!common_.quiet) print_message(silence_message(name, s) + (advice.empty() ? "" : "; " + advice));
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

Result<void> ChannelRun::finish(const RunStats& stats) {
    if (stats.diverged.empty()) return {};
    auto error = stats.diverged[0];
    error.message = fmt::format("{} of {} netlists did not converge; the first: {}", stats.diverged.size(), netlist_count(), error.message);
    return error;
}

}  // namespace corpuscle
