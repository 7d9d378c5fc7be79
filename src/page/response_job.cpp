#include "page/response_job.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "model/copies.hpp"
#include "page/documents.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"
#include "run/firing_factor.hpp"
#include "run/summary/silence_notes.hpp"

namespace corpuscle::page {
namespace {

constexpr double job_block = 5e-3;    // s, simulated at once; a circuit computes it in some milliseconds
constexpr double max_recorded = 2e7;  // values of all probes together

}  // namespace

Result<ResponseJob> ResponseJob::respond(ObjectReader& request, std::vector<RowRequest> rows, const KeptRecording* recording) {
    ResponseJob out;
    out.name_ = "respond";
    out.force_ = TRY(read_force(request, recording));
    out.every_ = static_cast<std::size_t>(TRY(request.integer("every", 0, 1'000'000, 0)));
    if (request.has("rows")) rows = TRY(read_row_requests(request));
    TRY(request.number("slice", 0, 10, 0));
    TRY(request.check_all_read());
    if (rows.empty()) return bad_input("respond: there are no rows; add \"rows\": [{\"afferent\": \"sa1\"}]");
    std::size_t probes = 0;
    for (const auto& row : rows) {
        out.plans_.push_back(TRY(plan_row(row)));
        probes += make_afferent(out.plans_.back(), {})->probes().size();
    }
    const double values = out.every_ == 0 ? 0 : static_cast<double>(probes * out.force_.values->size()) / static_cast<double>(out.every_);
    if (values > max_recorded)
        return bad_input(
            fmt::format("respond: the probes would have {:.3g} values; the page keeps at most {:.3g}: choose a larger \"every\"", values,
                        max_recorded));
    out.options_ = {.dt = out.force_.clock.T(), .seed = out.force_.seed};
    return out;
}

Result<ResponseJob> ResponseJob::monte_carlo(ObjectReader& request, const KeptRecording* recording) {
    constexpr std::uint64_t max_chips = 1000;
    ResponseJob out;
    out.name_ = "monte-carlo", out.is_monte_carlo_ = true;
    const auto afferent = TRY(request.text("afferent"));
    const auto chips = TRY(request.integer("chips", 1, max_chips));
    const auto seed = TRY(request.integer("seed", 0, 1ULL << 53, 1));
    RowRequest row{afferent, TRY(request.texts("set")), {}};
    out.force_ = TRY(read_force(request, recording));
    TRY(request.number("slice", 0, 10, 0));
    TRY(request.check_all_read());
    row.set.push_back(fmt::format("mismatch={}", seed));
    const auto plan = TRY(plan_row(row));
    out.plans_ = TRY(make_copies(plan, static_cast<std::uint32_t>(chips), {}, seed));
    out.options_ = {.dt = out.force_.clock.T()};
    return out;
}

void ResponseJob::prepare_measures() {
    std::vector<TimeWindow> windows;
    for (const auto& phase : force_.phases) windows.push_back({phase.from, phase.to});
    if (windows.empty()) windows.emplace_back();
    measures_ = MeasureAccumulator(std::move(windows), plans_.size());
}

void ResponseJob::begin_plan() {
    if (plan_ == 0 && !is_monte_carlo_) prepare_measures();
    afferent_ = make_afferent(plans_[plan_], options_);
    simulation_ = std::make_unique<AfferentSimulation>(*afferent_);
    auto& response = responses_.emplace_back();
    response.probe_names = document_of(afferent_->probes()), response.ranges = document_of(afferent_->ranges());
    response.probes.resize(every_ > 0 ? afferent_->probes().size() : 0);
    response.range_violations.resize(afferent_->ranges().size());
}

void ResponseJob::end_plan() {
    auto& response = responses_.back();
    for (std::size_t r = 0; r < response.range_violations.size(); ++r)
        if (const auto& violation = response.range_violations[r]; violation.samples > 0)
            response.range_warnings.push_back(range_warning(plans_[plan_].name, force_.channel, afferent_->ranges()[r], violation,
                                                            static_cast<std::int64_t>(force_.values->size()), force_.clock));
    ++plan_, at_ = 0, simulation_.reset(), afferent_.reset();
}

/// Simulates the next block of the present afferent, or goes on to the next afferent.
void ResponseJob::simulate_block(const std::atomic<bool>& is_stopped) {
    if (!afferent_) begin_plan();
    auto& out = responses_.back();
    const auto block = static_cast<std::size_t>(std::ceil(job_block * force_.clock.rate()));
    const auto count = std::min(block, force_.values->size() - at_);
    std::vector<std::vector<double>> values(out.probes.size(), std::vector<double>(count));
    std::vector<double*> arrays;
    for (auto& v : values) arrays.push_back(v.data());
    const auto before = spikes_.size();
    ResponseBlock response{spikes_, static_cast<std::uint32_t>(plan_), arrays, out.range_violations};
    response.should_stop = [&is_stopped] { return is_stopped.load(); };
    if (count > 0)
        if (const auto done =
                simulation_->respond(padded_block(*force_.values, at_, count, static_cast<std::size_t>(afferent_->delay())), response);
            !done)
            out.error = done.error().text();
    out.spikes += spikes_.size() - before;
    out.truncated_steps += response.truncated_steps, out.saturated += response.saturated, out.overflowed += response.overflowed;
    Clock since_start = force_.clock;
    since_start.t0 = 0;
    for (auto k = before; k < spikes_.size() && !is_monte_carlo_; ++k)
        measures_.spike(plan_, since_start.time(spikes_[k].step, spikes_[k].offset));
    for (std::size_t p = 0; p < values.size(); ++p)
        for (auto k = (every_ - at_ % every_) % every_; k < count; k += every_) out.probes[p].push_back(static_cast<float>(values[p][k]));
    at_ += count;
    if (at_ == force_.values->size() || !out.error.empty()) end_plan();
}

Result<void> ResponseJob::run(double seconds, const std::atomic<bool>& is_stopped, MessageWriter& answer) {
    const auto start = std::chrono::steady_clock::now();
    const auto has_time = [&] {
        return seconds == 0 || std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds;
    };
    for (bool is_first = true; !is_done() && (is_first || has_time()); is_first = false) {  // at least one block, so that it ends
        if (is_simulated())
            search_factor();
        else if (!is_stopped)
            simulate_block(is_stopped);
        if (is_stopped) return stopped_error();
    }
    const auto samples = static_cast<double>(std::max<std::size_t>(1, force_.values->size()));
    answer.head["answer"] = name_;
    answer.head["done"] = is_done();
    answer.head["progress"] = (static_cast<double>(plan_) + static_cast<double>(at_) / samples) / static_cast<double>(plans_.size());
    answer.head["samples"] = force_.values->size(), answer.head["rate"] = force_.clock.rate(), answer.head["t0"] = force_.clock.t0;
    answer.head["phases"] = document_of(force_.phases);
    if (is_monte_carlo_) answer.head["chips_done"] = plan_, answer.head["chips"] = plans_.size();
    add_spikes(answer, spikes_, force_.clock);
    spikes_.clear();
    if (is_done()) add_end(answer);
    return {};
}

/// The warnings that `corpuscle respond` prints about such a run. Errors of afferents are in their rows.
std::vector<std::string> ResponseJob::warnings() const {
    std::vector<std::string> out;
    std::vector<NoiseSubject> subjects;
    RunStats stats;
    for (std::size_t p = 0; p < plans_.size(); ++p) {
        if (auto text = source_rate_warning(plans_[p], force_.source, force_.clock.rate()); !text.empty()) out.push_back(std::move(text));
        subjects.push_back({plans_[p].name, &plans_[p]});
        const auto& response = responses_[p];
        stats.truncated_steps += response.truncated_steps, stats.saturated += response.saturated, stats.overflowed += response.overflowed;
        stats.range_warnings.insert(stats.range_warnings.end(), response.range_warnings.begin(), response.range_warnings.end());
    }
    const Channel channel{0, force_.channel};
    if (auto text = sensor_noise_warning(std::span(&channel, 1), force_.quality, force_.clock.rate(), subjects, options_); !text.empty())
        out.push_back(std::move(text));
    for (auto& text : response_warnings(stats)) out.push_back(std::move(text));
    const double T = force_.clock.T();
    for (std::size_t p = 0; p < plans_.size(); ++p) {
        double rate = 0;
        for (std::size_t phase = 0; phase < std::max<std::size_t>(1, force_.phases.size()); ++phase)
            rate = std::max(rate, highest_rate(measures_.values(p, phase), T));  // NaN, of fewer than two spikes, is not greater
        if (auto text = channel_rate_warning(rate, T, plans_[p], force_.channel); !text.empty()) out.push_back(std::move(text));
    }
    return out;
}

/// Adds the note that `corpuscle respond` prints if the next afferent never fired.
void ResponseJob::search_factor() {
    const auto p = searched_++;
    if (responses_[p].spikes > 0 || !responses_[p].error.empty() || !plans_[p].traits().can_search_factor) return;
    const std::span<const double> force = *force_.values;
    SilentClass silent{p, force.empty() ? 0 : std::max(0.0, *std::max_element(force.begin(), force.end())), {}};
    if (silent.max_force > 0)  // options_ has no noise
        silent.factor = factor_to_fire(plans_[p], options_, force.first(std::min(force.size(), max_silence_samples)));
    silence_notes_.push_back(silence_note(plans_[p], silent));
}

/// The parts of the last answer.
void ResponseJob::add_end(MessageWriter& answer) const {
    auto rows = Json::array();
    for (std::size_t r = 0; r < plans_.size(); ++r) {
        const auto& response = responses_[r];
        auto row = document_of(plans_[r]);
        row["probes"] = response.probe_names, row["spikes"] = response.spikes;
        if (!is_monte_carlo_) row["ranges"] = response.ranges;  // those of chips are the same for all
        row["outside"] = Json::array();
        for (const auto& violation : response.range_violations) row["outside"].push_back(violation.samples);
        if (!response.error.empty()) row["error"] = response.error;
        rows.push_back(std::move(row));
        for (std::size_t p = 0; p < response.probes.size(); ++p)
            answer.add(fmt::format("probe.{}.{}", r, p), std::span<const float>(response.probes[p]));
    }
    answer.head["rows"] = std::move(rows);
    if (is_monte_carlo_) answer.head["ranges"] = responses_.front().ranges;
    answer.head["warnings"] = is_monte_carlo_ ? std::vector<std::string>() : warnings();
    answer.head["notes"] = silence_notes_;
    if (force_.is_known) return;
    std::vector<float> force;
    for (std::size_t k = 0; k < force_.values->size(); k += std::max<std::size_t>(1, every_))
        force.push_back(static_cast<float>((*force_.values)[k]));
    answer.add("force", std::span<const float>(force));
}

}  // namespace corpuscle::page
