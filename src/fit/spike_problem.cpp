#include "fit/spike_problem.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"
#include "measure/smoothed_rate.hpp"
#include "measure/train_distance.hpp"
#include "run/simulate.hpp"

namespace corpuscle {
namespace {

// Standard deviations of the Gaussian in the stages, in units of tau. Wide ones compare the rates, narrow ones the times of spikes.
constexpr double stage_widths[] = {8, 2.5, 1};
constexpr double block_length = 5;  // of a block of residuals, in units of the standard deviation

/// The spikes in [from, to).
std::span<const double> spikes_in(std::span<const double> train, double from, double to) {
    const auto begin = std::lower_bound(train.begin(), train.end(), from), end = std::lower_bound(begin, train.end(), to);
    return {begin, end};
}

/// A stretch of time of a recording that is fitted or held out as a whole.
struct FitWindow {
    double from, to;  // s
    bool is_test;
};

class SpikeProblem final : public FitProblem {
    std::vector<SpikeRecording> recordings_;
    SpikeProblemOptions options_;
    double reference_[2] = {0, 0};  // cost of a silent afferent, of the data that are fitted and held out
    std::size_t spikes_ = 0;        // that are fitted

    /// The windows of a recording: that which is fitted, then that which is held out.
    static std::vector<FitWindow> windows(const SpikeRecording& r) {
        const double from = r.clock.t0, to = r.clock.time(static_cast<std::int64_t>(r.force.size()));
        const double middle = std::clamp(r.held_out_from, from, to);
        std::vector<FitWindow> out;
        if (middle > from) out.push_back({from, middle, false});
        if (middle < to) out.push_back({middle, to, true});
        return out;
    }
    /// `noise`: of the membrane, A; `seed` of the noise.
    Result<std::vector<double>> response(const AfferentPlan& plan, const SpikeRecording& r, double noise = 0,
                                         std::uint64_t seed = 0) const {
        auto options = options_.simulation;
        options.dt = r.clock.T(), options.noise = noise, options.seed = seed;
        const auto response = TRY(simulate(*make_afferent(plan, options), r.force));
        return spike_times(response.spikes, r.clock);
    }
    /// Appends the residuals of one train in one window, block by block.
    void add_residuals(std::span<const double> model, std::span<const double> train, const FitWindow& window, double width,
                       std::vector<ResidualBlock>& out) const {
        const double step = width / 2, length = block_length * width;
        for (double from = window.from; from < window.to; from += length) {
            const double to = std::min(window.to, from + length);
            const TimeGrid grid{from + step / 2, step, static_cast<std::size_t>(std::ceil((to - from) / step - 0.5))};
            // Spikes outside the window do not count; those in its other blocks reach into this one.
            auto values = smoothed_rate(spikes_in(model, window.from, window.to), grid, width);
            const auto data = smoothed_rate(spikes_in(train, window.from, window.to), grid, width);
            for (std::size_t k = 0; k < values.size(); ++k) values[k] -= data[k];
            out.push_back({std::move(values), window.is_test});
        }
    }
    /// The residuals of a recording, given the spikes of the model.
    void add_recording(std::span<const double> model, const SpikeRecording& r, double width, std::vector<ResidualBlock>& out) const {
        for (const auto& train : r.trains)
            for (const auto& window : windows(r)) add_residuals(model, train.times, window, width, out);
    }

public:
    SpikeProblem(std::vector<SpikeRecording> recordings, const SpikeProblemOptions& options)
        : recordings_(std::move(recordings)), options_(options) {
        std::vector<ResidualBlock> silent;
        for (const auto& r : recordings_) {
            add_recording({}, r, options_.tau, silent);
            for (const auto& train : r.trains)
                for (const auto& w : windows(r))
                    if (!w.is_test) spikes_ += spikes_in(train.times, w.from, w.to).size();
        }
        for (const bool is_test : {false, true}) reference_[is_test] = cost_of(silent, is_test);
    }

    std::size_t stages() const override { return std::size(stage_widths); }
    Result<std::vector<ResidualBlock>> residuals(const AfferentPlan& plan, std::size_t stage) const override {
        std::vector<ResidualBlock> out;
        for (const auto& r : recordings_) {
            const auto model = TRY(response(plan, r));
            add_recording(model, r, options_.tau * stage_widths[stage], out);
        }
        return out;
    }
    Result<std::vector<FitRow>> rows(const AfferentPlan& plan) const override {
        std::vector<FitRow> out;
        for (const auto& r : recordings_) {
            const auto model = TRY(response(plan, r));
            for (const auto& train : r.trains)
                for (const auto& w : windows(r)) {
                    const auto ours = spikes_in(model, w.from, w.to), theirs = spikes_in(train.times, w.from, w.to);
                    const auto aligned = TRY(align_trains(theirs, ours, 2 / options_.tau));
                    const auto data = train.name.empty() ? r.name : fmt::format("{}: {}", r.name, train.name);
                    const auto recorded = static_cast<double>(theirs.size());
                    out.push_back({.data = data,
                                   .measure = "spikes",
                                   .target = recorded,
                                   .got = static_cast<double>(ours.size()),
                                   .is_test = w.is_test});
                    out.push_back({.data = data,
                                   .measure = fmt::format("spikes within {}", format_quantity(options_.tau, "s")),
                                   .target = recorded,
                                   .got = static_cast<double>(aligned.moved.size()),
                                   .is_test = w.is_test});
                }
        }
        return out;
    }
    bool can_repeat(const AfferentPlan& plan) const override { return plan.traits().reason_no_noise.empty(); }
    Result<std::vector<ResidualBlock>> repetition(const AfferentPlan& plan, double noise, std::uint64_t seed) const override {
        constexpr std::uint64_t most_trains = 1 << 20;  // of a recording; each train has its own noise
        std::vector<ResidualBlock> out;
        for (std::size_t k = 0; k < recordings_.size(); ++k) {
            const auto& r = recordings_[k];
            const auto quiet = TRY(response(plan, r));
            auto repeated = r;
            for (std::size_t t = 0; t < repeated.trains.size(); ++t)
                repeated.trains[t].times = TRY(response(plan, r, noise, (seed * recordings_.size() + k) * most_trains + t));
            add_recording(quiet, repeated, options_.tau, out);
        }
        return out;
    }
    double reference_cost(bool is_test) const override { return reference_[is_test]; }
    std::size_t size() const override { return spikes_; }
    std::string score_meaning() const override {
        return fmt::format("squared distance of the trains smoothed over {}; 0: equal, 1: as far as an afferent that never fires",
                           format_quantity(options_.tau, "s"));
    }
};

}  // namespace

double cost_of(std::span<const ResidualBlock> blocks, bool is_test) {
    double sum = 0;
    for (const auto& b : blocks)
        if (b.is_test == is_test)
            for (const double r : b.residuals) sum += r * r;
    return sum;
}

void hold_out(std::vector<SpikeRecording>& recordings, double fraction) {
    if (recordings.size() >= 3) {
        const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(recordings.size()))),
                                                   fraction > 0 ? 1 : 0, recordings.size() - 1);
        for (std::size_t k = recordings.size() - count; k < recordings.size(); ++k)
            recordings[k].held_out_from = -std::numeric_limits<double>::infinity();
        return;
    }
    for (auto& r : recordings)
        if (fraction > 0) r.held_out_from = r.clock.t0 + (1 - fraction) * r.clock.T() * static_cast<double>(r.force.size());
}

Result<std::unique_ptr<FitProblem>> make_spike_problem(std::vector<SpikeRecording> recordings, const SpikeProblemOptions& options) {
    auto problem = std::make_unique<SpikeProblem>(std::move(recordings), options);
    if (problem->size() == 0)
        return bad_input(
            "no recorded spike lies in the time of the force that is fitted; check the clocks of the files, or shift the spikes by "
            "--delay");
    return std::unique_ptr<FitProblem>(std::move(problem));
}

}  // namespace corpuscle
