#include "corpuscle/force.hpp"

#include "api/force_origin.hpp"
#include "api/result.hpp"
#include "api/view_source.hpp"
#include "core/stimulus/stimuli.hpp"
#include "io/recording/recording_options.hpp"

namespace corpuscle {
namespace {

using api::result_or_throw;
using api::value_or_throw;

}  // namespace

ForceView::ForceView(const Force& force)
    : name(force.name), rate(force.rate), start(force.start), channels(force.channels),
      count(force.samples.empty() ? 0 : force.samples[0].size()), origin(force.origin) {
    for (const auto& channel : force.samples) {
        if (channel.size() != count) throw InputError("all channels of a force must have equally many samples");
        samples.push_back(channel.data());
    }
}

ForceView::ForceView(double sample_rate, std::span<const double> force) : rate(sample_rate), samples{force.data()}, count(force.size()) {}

namespace api {

Force read_force(ForceSource& source, bool has_unit) {
    Force out{.name = source.name(), .rate = source.clock().rate(), .start = source.clock().t0};
    for (const auto& c : source.channels()) out.channels.push_back(c.name);
    out.samples.resize(out.channels.size());
    for (Frames block(out.channels.size(), 4096);;) {
        value_or_throw(source.read(block));
        if (block.count == 0) break;
        for (std::size_t c = 0; c < out.samples.size(); ++c)
            out.samples[c].insert(out.samples[c].end(), block.force[c].begin(),
                                  block.force[c].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
    const auto origin =
        std::make_shared<const ForceOrigin>(ForceOrigin{source.channels(), source.phases(), source.cycle_frequency(), source.description(),
                                                        source.metadata(), source.notes(), source.quality(), has_unit});
    out.notes = origin->notes, out.warnings = origin->quality.warnings, out.origin = origin;
    const auto& faults = origin->quality.descriptions;
    out.notes.insert(out.notes.end(), faults.begin(), faults.end());
    return out;
}

RecordingOptions recording_options(const Options& options) {
    RecordingOptions reading;
    NamedOptions named(named_recording_options(reading));
    for (const auto& [name, value] : options) value_or_throw(named.set(name, value));
    return reading;
}

}  // namespace api

Force stimulus(const std::string& name, const std::vector<std::string>& settings, double rate, std::uint64_t seed) {
    return api::read_force(
        *result_or_throw(value_or_throw(make_stimulus(name, value_or_throw(parse_overrides(settings)), rate, seed)), name));
}

Force read_recording(const std::string& path, const Options& options) {
    const auto reading = api::recording_options(options);
    return api::read_force(*value_or_throw(open_recording(path, reading)), reading.unit.has_value());
}

namespace api {
namespace {

/// The origin of a force; one of its own for a force of the caller, and for one whose channels the caller has changed.
std::shared_ptr<const ForceOrigin> origin_of(const ForceView& view) {
    const auto count = view.samples.size();
    if (view.origin && view.origin->channels.size() == count) return view.origin;
    return std::make_shared<const ForceOrigin>(
        ForceOrigin{.description = std::to_string(count) + (count == 1 ? " channel" : " channels") + " of a program"});
}

/// Reads a ForceView.
class ViewSource final : public ForceSource {
    const ForceView& view_;
    std::shared_ptr<const ForceOrigin> origin_;  // never null
    Clock clock_;
    std::vector<Channel> channels_;
    std::size_t next_ = 0;  // sample

public:
    ViewSource(const ForceView& view, const Clock& clock) : view_(view), origin_(origin_of(view)), clock_(clock) {
        clock_.t0 = view.start;
        for (std::size_t c = 0; c < view.samples.size(); ++c)
            channels_.push_back(
                {static_cast<std::uint32_t>(c), c < view.channels.size() ? view.channels[c] : "ch" + std::to_string(c + 1)});
        for (std::size_t c = 0; c < std::min(channels_.size(), origin_->channels.size()); ++c)
            channels_[c].position = origin_->channels[c].position;
    }
    const std::string& name() const override { return view_.name; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    double progress() const override { return view_.count > 0 ? static_cast<double>(next_) / static_cast<double>(view_.count) : 1; }
    std::vector<Phase> phases() const override { return origin_->phases; }
    double cycle_frequency() const override { return origin_->cycle_frequency; }
    std::string description() const override { return origin_->description; }
    std::vector<MetadataEntry> metadata() const override { return origin_->metadata; }
    std::vector<std::string> notes() const override { return origin_->notes; }
    RecordingQuality quality() const override { return origin_->quality; }
    Result<void> read(Frames& block) override {
        block.count = std::min(block.capacity, view_.count - next_);
        for (std::size_t c = 0; c < channels_.size(); ++c)
            for (std::size_t k = 0; k < block.count; ++k) {
                const double f = view_.samples[c][static_cast<std::ptrdiff_t>(next_ + k) * view_.stride];
                if (!std::isfinite(f))
                    return bad_input("'" + channels_[c].name + "': the force of sample " + std::to_string(next_ + k) +
                                     " is not a finite number");
                block.force[c][k] = f;
            }
        next_ += block.count;
        return {};
    }
};

}  // namespace

std::unique_ptr<ForceSource> make_view_source(const ForceView& view) {
    if (view.samples.empty() || view.count == 0) throw InputError("the force has no samples");
    if (!std::isfinite(view.start)) throw InputError("the start of the force is not a finite time");
    return std::make_unique<ViewSource>(view, value_or_throw(make_clock(view.rate)));
}

}  // namespace api
}  // namespace corpuscle
