// response.nwb for the first input, response-2.nwb for the second: spikes, force and parameters in the NWB format (doc/formats.md). The
// spikes are kept in memory until the end, because NWB lists them unit after unit.

#include <fmt/format.h>
#include <algorithm>

#include "core/version.hpp"
#include "run/afferent_details.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/trials/trial_collector.hpp"

namespace corpuscle {
namespace {

/// The afferents for a description: "sa1, fa1 on 2 channels", "17144 afferents of a skin".
std::string subject_of(const Population& population) {
    if (population.skin()) return fmt::format("{} afferents of a skin", population.size());
    std::vector<std::string> names;
    for (std::size_t c = 0; c < population.class_count(); ++c) names.push_back(base_name(population.class_plan(c)));
    return fmt::format("{} afferents: {}", population.size(), fmt::join(names, ", "));
}

AfferentNames names_of(const Population& population) {
    AfferentNames out;
    for (std::size_t u = 0; u < population.size(); ++u) {
        out.names.push_back(population.afferent_name(u)), out.channels.push_back(population.channel_name(u));
        out.types.push_back(base_name(population.class_plan(population.class_of(u))));
        if (const auto at = population.position(u)) out.x.push_back(at->x), out.y.push_back(at->y);
    }
    return out;
}

class NwbSink final : public FileSink {
    NwbMetadata metadata_;
    std::string source_, notes_;
    bool sampled_;
    const TrialCollector* trials_;  // null without trials
    std::vector<NwbFile> nwb_;      // one for each input so far
    NwbUnits units_;                // of the current input
    std::vector<double> rows_;      // force of the current block, sample by sample

    Result<void> create_nwb(std::size_t index) {
        nwb_.push_back(TRY(NwbFile::create(directory_ + "/" + numbered_name("response#.nwb", index), metadata_)));
        return {};
    }

    void add(const Input& input, std::span<const Spike> spikes) {
        for (const auto& s : spikes) units_.trains[input.afferent_of(s)].push_back(input.clock.time(s.step, s.offset));
    }

    /// The trials of an input. TrialCollector precedes the files among the sinks.
    std::vector<NwbTrial> trials_of(const Input& input) const {
        std::vector<NwbTrial> out;
        if (!trials_) return out;
        for (const auto& t : trials_->responses.trials)
            if (t.input == input.index) out.push_back({t.start, t.stop, t.label});
        return out;
    }

public:
    explicit NwbSink(const OutputRequest& request)
        : FileSink(request), metadata_(*read_nwb_metadata(request.nwb_fields, "--nwb-field")), source_(request.command),
          notes_(fmt::format("Simulated by Corpuscle {}, with the seed {}.", version, request.seed)), sampled_(request.sampled),
          trials_(request.trials) {}

    Result<void> open() { return create_nwb(0); }

    Result<void> begin(const Input& input) override {
        if (input.index > 0) TRY(create_nwb(input.index));
        auto& nwb = nwb_.back();
        nwb.set_default_description(fmt::format("Simulated response to the force '{}': {}", input.name, subject_of(input.population)));
        nwb.add_provenance(source_, notes_);
        nwb.add_force({.name = input.name,
                       .description = input.population.skin() ? "total normal force on the skin" : "normal force on each channel",
                       .is_measured = input.is_recording,
                       .channels = input.population.force_names(),
                       .start = input.clock.t0,
                       .rate = input.clock.rate()});
        units_ = {};
        units_.description = fmt::format("simulated afferents (Corpuscle {})", version);
        units_.trains.resize(input.population.size());
        units_.resolution = sampled_ ? input.clock.T() : units_.resolution;
        return {};
    }

    Result<void> block(const Input& input, const RunBlock& block) override {
        add(input, block.spikes);
        const auto width = block.force.size();
        rows_.resize(width * block.steps);
        for (std::size_t c = 0; c < width; ++c)
            for (std::size_t k = 0; k < block.steps; ++k) rows_[k * width + c] = block.force[c][k];
        nwb_.back().append_force(rows_);
        return {};
    }

    /// The observed interval is that of the force. Spikes that nerve fibres conduct after its end, and a spike in the step that ends at the
    /// first sample, extend it.
    Result<void> end(const Input& input, std::int64_t samples, std::span<const Spike> last) override {
        add(input, last);
        units_.from = input.clock.t0, units_.to = input.clock.t0 + input.since_start(samples);
        for (const auto& train : units_.trains)
            if (!train.empty()) units_.from = std::min(units_.from, train.front()), units_.to = std::max(units_.to, train.back());
        units_.columns = nwb_columns(names_of(input.population), details_of(TRY(input.population.plan_table())));
        TRY(nwb_.back().add_units(units_));
        return nwb_.back().add_trials(trials_of(input));
    }

    std::vector<std::string> paths() const override {
        std::vector<std::string> all;
        for (const auto& file : nwb_) all.push_back(file.path());
        return all;
    }
    Result<void> commit() override {
        for (auto& file : nwb_) TRY(file.commit());
        return {};
    }
};

}  // namespace

extern const OutputFormat nwb_format = {
    .names = {"response#.nwb"},
    .option = "--nwb",
    .help = "with --out, also write response.nwb: spikes, force and parameters for the tools of Neurodata Without Borders (doc/formats.md)",
    .make = make_file_sink<NwbSink>,
    .check =
        [](const OutputRequest& request) {
            const auto fields = read_nwb_metadata(request.nwb_fields, "--nwb-field");
            return fields ? Result<void>() : fields.error();
        },
};

}  // namespace corpuscle
