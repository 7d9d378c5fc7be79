#include "page/response_job.hpp"

#include <fmt/format.h>
#include <chrono>
#include <cmath>

#include "model/copies.hpp"
#include "page/documents.hpp"

namespace corpuscle::page {
namespace {

constexpr double job_block = 5e-3;    // s, simulated at once; a circuit computes it in some milliseconds
constexpr double max_recorded = 2e7;  // values of all probes together

}  // namespace

Result<ResponseJob> ResponseJob::respond(ObjectReader& request, std::vector<RowRequest> rows) {
    ResponseJob out;
    out.name_ = "respond";
    out.force_ = TRY(read_force(request));
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
    const double values = out.every_ == 0 ? 0 : static_cast<double>(probes * out.force_.force.size()) / static_cast<double>(out.every_);
    if (values > max_recorded)
        return bad_input(
            fmt::format("respond: the probes would have {:.3g} values; the page keeps at most {:.3g}: choose a larger \"every\"", values,
                        max_recorded));
    out.options_ = {.dt = out.force_.clock.T(), .seed = out.force_.seed};
    return out;
}

Result<ResponseJob> ResponseJob::monte_carlo(ObjectReader& request) {
    constexpr std::uint64_t max_chips = 1000;
    ResponseJob out;
    out.name_ = "monte-carlo", out.is_monte_carlo_ = true;
    const auto afferent = TRY(request.text("afferent"));
    const auto chips = TRY(request.integer("chips", 1, max_chips));
    const auto seed = TRY(request.integer("seed", 0, 1ULL << 53, 1));
    RowRequest row{afferent, TRY(request.texts("set")), {}};
    out.force_ = TRY(read_force(request));
    TRY(request.number("slice", 0, 10, 0));
    TRY(request.check_all_read());
    row.set.push_back(fmt::format("mismatch={}", seed));
    const auto plan = TRY(plan_row(row));
    out.plans_ = TRY(make_copies(plan, static_cast<std::uint32_t>(chips), {}, seed));
    out.options_ = {.dt = out.force_.clock.T()};
    return out;
}

void ResponseJob::begin_plan() {
    afferent_ = make_afferent(plans_[plan_], options_);
    simulation_ = std::make_unique<AfferentSimulation>(*afferent_);
    padded_ = force_.force;
    padded_.resize(padded_.size() + static_cast<std::size_t>(afferent_->delay()), padded_.empty() ? 0 : padded_.back());
    at_ = 0;
    spike_counts_.push_back(0), errors_.emplace_back();
    probe_names_.push_back(document_of(afferent_->probes()));
    probes_.emplace_back(every_ > 0 ? afferent_->probes().size() : 0);
}

/// Simulates the next block of the present afferent, or goes on to the next afferent.
void ResponseJob::simulate_block(const std::atomic<bool>& is_stopped) {
    if (!afferent_) begin_plan();
    const auto block = static_cast<std::size_t>(std::ceil(job_block * force_.clock.rate()));
    const auto count = std::min(block, force_.force.size() - at_);
    std::vector<std::vector<double>> values(probes_.back().size(), std::vector<double>(count));
    std::vector<double*> arrays;
    for (auto& v : values) arrays.push_back(v.data());
    const auto before = spikes_.size();
    ResponseBlock response{spikes_, static_cast<std::uint32_t>(plan_), arrays};
    response.should_stop = [&is_stopped] { return is_stopped.load(); };
    if (count > 0)
        if (const auto done =
                simulation_->respond(std::span(padded_).subspan(at_, count + static_cast<std::size_t>(afferent_->delay())), response);
            !done)
            errors_.back() = done.error().text();
    spike_counts_.back() += spikes_.size() - before;
    for (std::size_t p = 0; p < values.size(); ++p)
        for (auto k = (every_ - at_ % every_) % every_; k < count; k += every_)
            probes_.back()[p].push_back(static_cast<float>(values[p][k]));
    at_ += count;
    if (at_ < force_.force.size() && errors_.back().empty()) return;
    ++plan_, simulation_.reset(), afferent_.reset();
}

Result<void> ResponseJob::run(double seconds, const std::atomic<bool>& is_stopped, MessageWriter& answer) {
    const auto start = std::chrono::steady_clock::now();
    const auto has_time = [&] {
        return seconds == 0 || std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds;
    };
    for (bool is_first = true; !is_done() && (is_first || has_time()); is_first = false) {  // at least one block, so that it ends
        if (!is_stopped) simulate_block(is_stopped);
        if (is_stopped) return stopped_error();
    }
    const auto samples = static_cast<double>(std::max<std::size_t>(1, force_.force.size()));
    answer.head["answer"] = name_;
    answer.head["done"] = is_done();
    answer.head["progress"] =
        (static_cast<double>(plan_) + (is_done() ? 0 : static_cast<double>(at_) / samples)) / static_cast<double>(plans_.size());
    answer.head["samples"] = force_.force.size(), answer.head["rate"] = force_.clock.rate();
    answer.head["phases"] = document_of(force_.phases);
    if (is_monte_carlo_) answer.head["chips_done"] = plan_, answer.head["chips"] = plans_.size();
    add_spikes(answer, spikes_, force_.clock);
    spikes_.clear();
    if (is_done()) add_end(answer);
    return {};
}

/// The parts of the last answer.
void ResponseJob::add_end(MessageWriter& answer) const {
    auto rows = Json::array();
    for (std::size_t r = 0; r < plans_.size(); ++r) {
        auto row = document_of(plans_[r]);
        row["probes"] = probe_names_[r], row["spikes"] = spike_counts_[r];
        if (!errors_[r].empty()) row["error"] = errors_[r];
        rows.push_back(std::move(row));
        for (std::size_t p = 0; p < probes_[r].size(); ++p)
            answer.add(fmt::format("probe.{}.{}", r, p), std::span<const float>(probes_[r][p]));
    }
    answer.head["rows"] = std::move(rows);
    answer.head["warnings"] = Json::array();
    if (!is_monte_carlo_)
        for (const auto& plan : plans_) add_rate_warning(answer.head["warnings"], plan, force_.clock.rate());
    if (!force_.is_stimulus) return;
    std::vector<float> force;
    for (std::size_t k = 0; k < force_.force.size(); k += std::max<std::size_t>(1, every_))
        force.push_back(static_cast<float>(force_.force[k]));
    answer.add("force", std::span<const float>(force));
}

}  // namespace corpuscle::page
