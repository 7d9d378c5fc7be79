#include "fit/spike_problem.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"
#include "fit/expected_train.hpp"
#include "measure/smoothed_rate.hpp"
#include "measure/train_distance.hpp"
#include "model/neuron/irregular_threshold.hpp"

namespace corpuscle {
namespace {

// Standard deviations of the Gaussian in the stages, in units of tau. Wide ones compare the rates, narrow ones the times of spikes.
constexpr double stage_widths[] = {rate_width, 2.5, 1};

// Seeds of the simulations. They are far from those of users, so that data that were simulated do not share random numbers with a fit.
constexpr std::uint64_t fit_seed = 0x6669'7400'0000'0000;  // "fit"
constexpr std::uint64_t repetition_seed = 0x7265'7000'0000'0000, repeated_rate_seed = 0x7261'7400'0000'0000;
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
        const double from = r.clock.t0, to = r.end();
        const double middle = std::clamp(r.held_out_from, from, to);
        std::vector<FitWindow> out;
        if (middle > from) out.push_back({from, middle, false});
        if (middle < to) out.push_back({middle, to, true});
        return out;
    }
    std::size_t realisations() const { return options_.is_irregular ? irregular_realisations : 1; }
    double stage_width(std::size_t stage) const { return options_.tau * (options_.is_irregular ? rate_width : stage_widths[stage]); }
    double last_width() const { return stage_width(stages() - 1); }
    /// The spikes under recording k, with the random numbers of set `number`.
    Result<ExpectedTrain> expected(const AfferentPlan& plan, std::size_t k, std::uint64_t seed, std::uint64_t number) const {
        return expected_train(plan, recordings_[k], options_.simulation, realisations(), seed + number * realisations());
    }
    /// Appends the residuals of one train in one window, block by block.
    void add_residuals(const ExpectedTrain& model, std::span<const double> train, const FitWindow& window, double width,
                       std::vector<ResidualBlock>& out) const {
        const double step = width / 2, length = block_length * width;
        for (double from = window.from; from < window.to; from += length) {
            const double to = std::min(window.to, from + length);
            const TimeGrid grid{from + step / 2, step, static_cast<std::size_t>(std::ceil((to - from) / step - 0.5))};
            // Spikes outside the window do not count; those in its other blocks reach into this one.
            auto values = smoothed_rate(spikes_in(model.times, window.from, window.to), grid, width);
            const auto data = smoothed_rate(spikes_in(train, window.from, window.to), grid, width);
            for (std::size_t k = 0; k < values.size(); ++k) values[k] = values[k] / model.realisations - data[k];
            out.push_back({std::move(values), window.is_test});
        }
    }
    /// The residuals of a recording, given the spikes of the model.
    void add_recording(const ExpectedTrain& model, const SpikeRecording& r, double width, std::vector<ResidualBlock>& out) const {
        for (const auto& train : r.trains)
            for (const auto& window : windows(r)) add_residuals(model, train.times, window, width, out);
    }

    /// Appends the numbers of spikes of one train in one window, and how many of them the afferent has at the same time.
    Result<void> add_rows(const ExpectedTrain& model, const std::string& recording, const RecordedTrain& train, const FitWindow& window,
                          std::vector<FitRow>& out) const {
        const auto ours = spikes_in(model.times, window.from, window.to), theirs = spikes_in(train.times, window.from, window.to);
        const auto data = train.name.empty() ? recording : fmt::format("{}: {}", recording, train.name);
        const auto recorded = static_cast<double>(theirs.size());
        out.push_back({.data = data,
                       .measure = "spikes",
                       .target = recorded,
                       .fitted = static_cast<double>(ours.size()) / model.realisations,
                       .is_test = window.is_test});
        if (options_.is_irregular) return {};
        const auto aligned = TRY(align_trains(theirs, ours, 2 / options_.tau));
        out.push_back({.data = data,
                       .measure = fmt::format("spikes within {}", format_quantity(options_.tau, "s")),
                       .target = recorded,
                       .fitted = static_cast<double>(aligned.moved.size()),
                       .is_test = window.is_test});
        return {};
    }

public:
    SpikeProblem(std::vector<SpikeRecording> recordings, const SpikeProblemOptions& options)
        : recordings_(std::move(recordings)), options_(options) {
        std::vector<ResidualBlock> silent;
        for (const auto& r : recordings_) {
            add_recording({}, r, last_width(), silent);
            for (const auto& train : r.trains)
                for (const auto& w : windows(r))
                    if (!w.is_test) spikes_ += spikes_in(train.times, w.from, w.to).size();
        }
        for (const bool is_test : {false, true}) reference_[is_test] = cost_of(silent, is_test);
    }

    const std::vector<SpikeRecording>& recordings() const { return recordings_; }
    std::size_t stages() const override { return options_.is_irregular ? 1 : std::size(stage_widths); }
    Result<std::vector<ResidualBlock>> residuals(const AfferentPlan& plan, std::size_t stage) const override {
        std::vector<ResidualBlock> out;
        for (std::size_t k = 0; k < recordings_.size(); ++k)
            add_recording(TRY(expected(plan, k, fit_seed, k)), recordings_[k], stage_width(stage), out);
        return out;
    }
    Result<std::vector<FitRow>> rows(const AfferentPlan& plan) const override {
        std::vector<FitRow> out;
        for (std::size_t k = 0; k < recordings_.size(); ++k) {
            const auto model = TRY(expected(plan, k, fit_seed, k));
            for (const auto& train : recordings_[k].trains)
                for (const auto& window : windows(recordings_[k])) TRY(add_rows(model, recordings_[k].name, train, window, out));
        }
        return out;
    }
    std::vector<std::string> warnings(const AfferentPlan& plan) const override { return recording_warnings(recordings_, plan); }
    std::string reason_not_determined(std::string_view parameter) const override {
        if (parameter != jitter_name) return "";
        return "the rate of spikes does not depend on it, only their irregularity does; set it, or fit it to the measure isi_cv in a table "
               "of targets (--targets)";
    }
    bool can_repeat(const AfferentPlan& plan) const override { return plan.traits().reason_no_noise.empty(); }
    Result<std::vector<ResidualBlock>> repetition(const AfferentPlan& plan, double noise, std::uint64_t seed) const override {
        constexpr std::uint64_t most_trains = 1 << 20;  // of a recording; each train has random numbers of its own
        std::vector<ResidualBlock> out;
        for (std::size_t k = 0; k < recordings_.size(); ++k) {
            auto repeated = recordings_[k];
            const auto number = seed * recordings_.size() + k;
            for (std::size_t t = 0; t < repeated.trains.size(); ++t)
                repeated.trains[t].times =
                    TRY(simulated_train(plan, repeated, options_.simulation, noise, repetition_seed + number * most_trains + t));
            // The rate of an irregular afferent is drawn anew, too, because the mean of some realisations is not exact.
            add_recording(TRY(expected(plan, k, repeated_rate_seed, number)), repeated, last_width(), out);
        }
        return out;
    }
    double reference_cost(bool is_test) const override { return reference_[is_test]; }
    std::size_t size() const override { return spikes_; }
    std::string score_meaning() const override {
        if (options_.is_irregular)
            return fmt::format(
                "squared distance of the train and the mean of {} simulated ones, all smoothed over {}, because the afferent is "
                "irregular; 0: equal, 1: as far as an afferent that never fires",
                irregular_realisations, format_quantity(last_width(), "s"));
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
    if (problem->size() == 0) return unused_spikes_error(problem->recordings());
    return std::unique_ptr<FitProblem>(std::move(problem));
}

}  // namespace corpuscle
