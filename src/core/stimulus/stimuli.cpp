// The list of stimuli. To add one, put its struct into stimulus/, and its include and its name below. The struct has a name, a description,
// a source, a struct Params with defaults, a table `fields` of ParameterDef, and a member `p` of type Params.
//
// duration() is its length in s, and at(t) the force in N at t s from its start. A stimulus may have phases(), its phases; a periodic one
// has cycle(), its frequency in Hz; a random one has a member `seed`.

#include "core/stimulus/stimuli.hpp"

#include <fmt/format.h>

#include "core/stimulus/touch.hpp"
#include "core/stimulus/vibration.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

template <class... S>
struct StimulusList {};
using Stimuli = StimulusList<Press, RampHold, Step, Sine, Chirp, Noise, Grating>;

/// One member of a sum, without its type.
struct ErasedStimulus {
    double duration = 0;         // s
    double cycle_frequency = 0;  // Hz; 0: not periodic
    std::vector<Phase> phases;
    std::function<double(double)> at;  // the force in N at a time in s
};

template <class S>
ErasedStimulus erase_stimulus(std::span<const Setting> settings, std::uint64_t seed) {
    S s;
    s.p = with_settings<typename S::Params>(S::fields, settings);
    if constexpr (requires { s.seed; }) s.seed = seed;
    ErasedStimulus erased{s.duration(), 0, {}, [s](double t) { return s.at(t); }};
    if constexpr (requires { s.cycle(); }) erased.cycle_frequency = s.cycle();
    if constexpr (requires { s.phases(); }) erased.phases = s.phases();
    return erased;
}

/// The stimulus with this name; nullopt if the list has none.
template <class... S>
std::optional<ErasedStimulus> make_member(StimulusList<S...>, std::string_view name, std::span<const Setting> settings,
                                          std::uint64_t seed) {
    std::optional<ErasedStimulus> found;
    (void)((S::name == name && (found = erase_stimulus<S>(settings, seed), true)) || ...);
    return found;
}

template <class... S>
std::vector<CatalogEntry> catalog_of(StimulusList<S...>) {
    return {catalog_entry_of<S>()...};
}

std::optional<CatalogEntry> find_stimulus(std::string_view name) {
    for (auto& entry : stimulus_catalog())
        if (entry.name == name) return entry;
    return {};
}

class StimulusSum final : public ForceSource {
    std::string name_;
    Clock clock_;
    std::vector<ErasedStimulus> members_;
    std::vector<MetadataEntry> metadata_;
    std::vector<Channel> channels_;
    std::int64_t samples_;   // total number
    std::int64_t next_ = 0;  // index of the next sample to read

public:
    StimulusSum(std::string name, Clock clock, std::vector<ErasedStimulus> members, std::vector<MetadataEntry> metadata,
                std::int64_t samples)
        : name_(std::move(name)), clock_(clock), members_(std::move(members)), metadata_(std::move(metadata)), channels_{{0, name_}},
          samples_(samples) {}
    const std::string& name() const override { return name_; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    std::string description() const override {
        std::vector<std::string_view> all;
        for (const auto member : stimulus_members(name_))
            all.push_back(find_stimulus(member)->description);  // exists: make_stimulus() has checked the names
        return joined(all, "; ");
    }
    double progress() const override { return static_cast<double>(next_) / static_cast<double>(samples_); }
    std::vector<MetadataEntry> metadata() const override { return metadata_; }
    std::vector<Phase> phases() const override {
        for (const auto& s : members_) {
            if (s.phases.empty()) continue;
            auto phases = s.phases;
            const double end = clock_.time(samples_);
            if (end - phases.back().to > 0.5 * clock_.T()) phases.push_back({"after", phases.back().to, end});
            return phases;
        }
        return {};
    }
    /// The frequency of the periodic member; 0 if no member is periodic, or several are.
    double cycle_frequency() const override {
        double found = 0;
        for (const auto& s : members_)
            if (s.cycle_frequency > 0 && std::exchange(found, s.cycle_frequency) > 0) return 0;
        return found;
    }
    Result<void> read(Frames& block) override {
        block.count = std::min<std::size_t>(block.capacity, static_cast<std::size_t>(samples_ - next_));
        for (std::size_t k = 0; k < block.count; ++k) {
            const double t = clock_.time(next_++);
            double force = 0;
            for (const auto& s : members_) force += s.at(std::min(t, s.duration));
            block.force[0][k] = force;
        }
        return {};
    }
};

}  // namespace

std::vector<std::string_view> stimulus_members(std::string_view text) { return split(text, '+'); }

std::vector<CatalogEntry> stimulus_catalog() { return catalog_of(Stimuli{}); }

bool is_stimulus(std::string_view text) {
    const auto names = stimulus_members(text);
    return std::all_of(names.begin(), names.end(), [](auto n) { return find_stimulus(n).has_value(); });
}

Result<Applied<std::unique_ptr<ForceSource>>> make_stimulus(std::string_view text, std::span<const ParameterOverride> overrides,
                                                            double rate, std::uint64_t seed) {
    const auto clock = TRY(make_clock(rate));
    std::vector<ErasedStimulus> members;
    std::vector<MetadataEntry> metadata;
    std::vector<ParameterOverride> unused(overrides.begin(), overrides.end());
    double duration = 0;
    for (const auto name : stimulus_members(text)) {
        const auto entry = find_stimulus(name);
        if (!entry) {
            std::vector<std::string_view> names;
            for (const auto& c : stimulus_catalog()) names.push_back(c.name);
            const auto similar = did_you_mean(name, names);
            return bad_input(
                fmt::format("unknown stimulus '{}'{}", name, similar.empty() ? fmt::format("; there are {}", joined(names)) : similar));
        }
        const auto applied = TRY(settings_for(name, entry->parameters, overrides));
        keep_unused(unused, applied.unused);
        const auto& settings = applied.result;
        for (const auto& row : entry->parameters) {
            // The last override of a parameter counts.
            const auto setting = std::find_if(settings.rbegin(), settings.rend(), [&](const Setting& s) { return s.name == row.name; });
            metadata.push_back({fmt::format("{}.{}", name, row.name), setting == settings.rend() ? row.default_value : setting->value,
                                std::string(row.unit)});
        }
        members.push_back(*make_member(Stimuli{}, name, settings, seed));  // exists: its catalogue entry was found above
        duration = std::max(duration, members.back().duration);
    }
    const double samples = std::round(duration * clock.rate());
    if (!(samples >= 1)) return bad_input(fmt::format("{}: {:g} s at {:g} Hz is less than one sample", text, duration, rate));
    if (samples > 1e15) return bad_input(fmt::format("{}: {:g} s at {:g} Hz is more than 1e15 samples", text, duration, rate));
    return Applied<std::unique_ptr<ForceSource>>{std::make_unique<StimulusSum>(std::string(text), clock, std::move(members),
                                                                               std::move(metadata), static_cast<std::int64_t>(samples)),
                                                 std::move(unused)};
}

Result<std::unique_ptr<ForceSource>> make_stimulus(std::string_view text, double rate, std::uint64_t seed) {
    auto made = TRY(make_stimulus(text, {}, rate, seed));
    return std::move(made.result);
}

}  // namespace corpuscle
