#include "sweep/spec/sweep_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <filesystem>

#include "core/located_override.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr double max_samples = 5e7;  // of one force; 400 MB
constexpr std::size_t max_cached_forces = 8;

/// Reads the first channel to its end.
Result<std::shared_ptr<const SweepForce>> read_force(ForceSource& source) {
    auto force = std::make_shared<SweepForce>();
    force->clock = source.clock(), force->clock.t0 = 0;
    force->phases = source.phases(), force->cycle_frequency = source.cycle_frequency();
    Frames frames(source.channels().size(), 4096);
    for (;;) {
        TRY(source.read(frames));
        if (frames.count == 0) break;
        force->samples.insert(force->samples.end(), frames.force[0].begin(),
                              frames.force[0].begin() + static_cast<std::ptrdiff_t>(frames.count));
        if (static_cast<double>(force->samples.size()) > max_samples)
            return bad_input(
                fmt::format("{}: the force has more than {:g} samples at {:g} Hz; use a lower rate (rate = \"10kHz\") "
                            "or a shorter force",
                            source.name(), max_samples, source.clock().rate()));
    }
    if (force->samples.empty()) return bad_input(fmt::format("{}: no samples of force", source.name()));
    return std::shared_ptr<const SweepForce>(std::move(force));
}

/// The number in a text with this unit; `fallback` if there is no text.
Result<double> number_of(const OptionalLocatedText& text, std::string_view unit, double fallback) {
    if (!text) return fallback;
    const auto value = parse_quantity(text->text, unit);
    return value ? value : Result<double>(text->error_here(value.error().message));
}

}  // namespace

/// The most recent forces, because items with neighbouring indexes often have the same force.
struct ForceFactory::Cache {
    std::mutex mutex;
    std::map<std::vector<double>, std::shared_ptr<const SweepForce>> forces;  // by their varied values
};

Result<ForceFactory> ForceFactory::of(const SweepText& spec, const std::string& folder, std::uint64_t seed) {
    ForceFactory out;
    out.text_ = spec.force ? spec.force->text : "press", out.seed_ = seed, out.cache_ = std::make_shared<Cache>();
    const auto rate = TRY(number_of(spec.rate, "Hz", 10e3));
    out.rate_ = rate;
    out.is_recording_ = !is_stimulus(out.text_);
    if (!out.is_recording_) {
        for (const auto& [name, value] : {std::pair{"channel", &spec.channel}, {"unit", &spec.unit}, {"scale", &spec.scale}})
            if (*value) return (*value)->error_here(fmt::format("{} applies to recordings, but {} is a stimulus", name, out.text_));
        return out;
    }
    const auto path = (std::filesystem::path(folder) / out.text_).string();
    std::error_code status;
    if (!std::filesystem::exists(path, status)) {
        // This is neither a stimulus nor a file; the error of make_stimulus() says why it is not a stimulus.
        auto error = make_stimulus(out.text_, out.rate_, seed).error();
        return spec.force->error_here(fmt::format("{} (and there is no file '{}')", error.message, out.text_));
    }
    RecordingOptions options;
    if (spec.channel) options.channels = {spec.channel->text};
    if (spec.rate) options.rate = rate;
    if (spec.unit) options.unit = spec.unit->text;
    const auto scale = TRY(number_of(spec.scale, "", 1));
    if (spec.scale) options.scale = scale;
    auto source = TRY(open_recording(path, options));
    if (source->channels().size() > 1) {
        std::vector<std::string_view> names;
        for (const auto& c : source->channels()) names.push_back(c.name);
        return spec.force->error_here(fmt::format("{} has {} channels; select one: channel = \"{}\"", out.text_, names.size(), names[0]));
    }
    out.nominal_ = TRY(read_force(*source));
    return out;
}

bool ForceFactory::has_parameter(std::string_view name) const {
    const auto dot = name.find('.');
    if (is_recording_ || dot == std::string_view::npos) return false;
    const auto all = stimulus_members(text_);
    return std::find(all.begin(), all.end(), name.substr(0, dot)) != all.end();
}

Result<VariedQuantity> ForceFactory::find_quantity(const LocatedText& quantity) const {
    const auto dot = quantity.text.find('.');
    const ParameterOverride parameter{quantity.text.substr(0, dot), quantity.text.substr(dot + 1), ""};
    for (const auto& stimulus : stimulus_catalog()) {
        if (stimulus.name != parameter.target) continue;
        const auto row = find_parameter(parameter, stimulus.parameters);
        if (!row) return quantity.error_here(row.error().message);
        VariedQuantity out{
            {quantity.text, std::string((*row)->unit), std::string((*row)->description)}, (*row)->default_value, (*row)->low, (*row)->high};
        for (const auto& w : overrides_)
            if (w.target == parameter.target && w.parameter == parameter.parameter) out.nominal = *parse_quantity(w.value, (*row)->unit);
        out.parse = [unit = std::string((*row)->unit)](const LocatedText& s) { return parse_quantity(s.text, unit); };
        return out;
    }
    return quantity.error_here(fmt::format("'{}' is not the stimulus of this sweep", parameter.target));
}

Result<void> ForceFactory::set(const LocatedSetting& setting) {
    auto given = located_override(setting, text_);
    for (const auto& stimulus : stimulus_catalog())
        if (stimulus.name == given.target) TRY(setting_of(given, stimulus.parameters));
    overrides_.push_back(std::move(given));
    fixed_count_ = overrides_.size();  // vary() comes after all calls of set()
    return {};
}

void ForceFactory::vary(const std::string& name, std::size_t axis) {
    const auto dot = name.find('.');
    overrides_.push_back({name.substr(0, dot), name.substr(dot + 1), ""});
    axes_.push_back(axis);
}

Result<std::shared_ptr<const SweepForce>> ForceFactory::make(std::span<const double> varied_values) const {
    if (is_recording_) return nominal_;
    auto overrides = overrides_;
    overrides.resize(fixed_count_ + varied_values.size());
    for (std::size_t k = 0; k < varied_values.size(); ++k) overrides[fixed_count_ + k].value = fmt::format("{}", varied_values[k]);
    const auto source = TRY(make_stimulus(text_, overrides, rate_, seed_));
    return read_force(*source.result);
}

Result<void> ForceFactory::prepare() {
    nominal_ = TRY(make({}));
    return {};
}

Result<std::shared_ptr<const SweepForce>> ForceFactory::at(std::span<const double> values) const {
    if (!varies()) return nominal_;
    std::vector<double> varied_values;
    for (const auto axis : axes_) varied_values.push_back(values[axis]);
    {
        const std::lock_guard lock(cache_->mutex);
        if (const auto at = cache_->forces.find(varied_values); at != cache_->forces.end()) return at->second;
    }
    auto force = make(varied_values);
    if (!force) return force;
    const std::lock_guard lock(cache_->mutex);
    if (cache_->forces.size() >= max_cached_forces) cache_->forces.clear();
    cache_->forces[varied_values] = *force;
    return force;
}

std::string ForceFactory::recording_summary() const {
    if (!is_recording_) return "";
    std::uint64_t hash = 0xcbf29ce484222325;  // as FNV-1a, but over numbers of 64 bits instead of bytes
    for (const double x : nominal_->samples) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
    return fmt::format("{} samples at {} Hz, {:016x}", nominal_->samples.size(), nominal_->clock.rate(), hash);
}

}  // namespace corpuscle::sweeps
