#include "sweep/spec/sweep_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <filesystem>

#include "core/checksum.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/config_file.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr double max_samples = 5e7;  // of one force; 400 MB

/// Reads the first channel to its end.
Result<SweepForcePointer> read_force(ForceSource& source) {
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
    return SweepForcePointer(std::move(force));
}

/// The number in a text with this unit; `fallback` if there is no text.
Result<double> number_of(const ConfigNode* text, std::string_view unit, double fallback) {
    return text ? text->located(parse_quantity(text->text, unit)) : fallback;
}

/// Reads the recording `name`, whose path is relative to `folder`. `rate` and `seed` are only for the message that it is neither a file nor
/// a stimulus.
Result<SweepForcePointer> read_recording(const SweepText& spec, const std::string& folder, const std::string& name, double rate,
                                         std::uint64_t seed) {
    const auto& force = *spec.get("force");
    const auto path = (std::filesystem::path(folder) / name).string();
    std::error_code status;
    if (!std::filesystem::exists(path, status))
        return force.error_here(fmt::format("{} (and there is no file '{}')", make_stimulus(name, rate, seed).error().message, name));
    RecordingOptions options;
    if (const auto* channel = spec.get("channel")) options.channels = {channel->text};
    if (spec.get("rate")) options.rate = rate;
    if (const auto* unit = spec.get("unit")) options.unit = unit->text;
    if (const auto* scale = spec.get("scale")) options.scale = TRY(number_of(scale, "", 1));
    const auto source = TRY(open_recording(path, options));
    const auto& channels = source->channels();
    if (channels.size() > 1)
        return force.error_here(fmt::format("{} has {} channels; select one: channel = \"{}\"", name, channels.size(), channels[0].name));
    return read_force(*source);
}

}  // namespace

Result<ForceFactory> ForceFactory::of(const SweepText& spec, const std::string& folder, std::uint64_t seed) {
    ForceFactory out;
    const auto* given = spec.get("force");
    out.text_ = given ? given->text : "press", out.seed_ = seed, out.cache_ = std::make_shared<ValueCache<SweepForcePointer>>(8);
    out.rate_ = TRY(number_of(spec.get("rate"), "Hz", 10e3));
    out.is_recording_ = !is_stimulus(out.text_);
    if (out.is_recording_) {
        out.nominal_ = TRY(read_recording(spec, folder, out.text_, out.rate_, seed));
        return out;
    }
    for (const auto* name : {"channel", "unit", "scale"})
        if (const auto* value = spec.get(name))
            return value->error_here(fmt::format("{} applies to recordings, but {} is a stimulus", name, out.text_));
    return out;
}

bool ForceFactory::has_parameter(std::string_view name) const {
    const auto dot = name.find('.');
    if (is_recording_ || dot == std::string_view::npos) return false;
    const auto all = stimulus_members(text_);
    return std::find(all.begin(), all.end(), name.substr(0, dot)) != all.end();
}

Result<VariedQuantity> ForceFactory::find_quantity(const LocatedText& quantity) {
    const auto dot = quantity.text.find('.');
    const ParameterOverride parameter{quantity.text.substr(0, dot), quantity.text.substr(dot + 1), ""};
    for (const auto& stimulus : stimulus_catalog()) {
        if (stimulus.name != parameter.target) continue;
        const auto* row = TRY(quantity.located(find_parameter(parameter, stimulus.parameters)));
        VariedQuantity out{{quantity.text, std::string(row->unit), std::string(row->description)}, row->default_value, row->low, row->high};
        for (const auto& w : overrides_)
            if (w.target == parameter.target && w.parameter == parameter.parameter) out.nominal = *parse_quantity(w.value, row->unit);
        out.parse = [unit = std::string(row->unit)](const LocatedText& s) { return parse_quantity(s.text, unit); };
        out.vary = [this, parameter](std::size_t axis, const auto&) { overrides_.push_back(parameter), axes_.push_back(axis); };
        return out;
    }
    return quantity.error_here(fmt::format("'{}' is not the stimulus of this sweep", parameter.target));
}

Result<void> ForceFactory::set(const LocatedSetting& setting) {
    auto given = located_override(setting, text_);
    for (const auto& stimulus : stimulus_catalog())
        if (stimulus.name == given.target) TRY(setting_of(given, stimulus.parameters));
    overrides_.push_back(std::move(given));
    fixed_count_ = overrides_.size();  // varied settings come after all calls of set()
    return {};
}

Result<SweepForcePointer> ForceFactory::make(std::span<const double> varied_values) const {
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

Result<SweepForcePointer> ForceFactory::at(std::span<const double> values) const {
    if (!varies()) return nominal_;
    std::vector<double> varied_values;
    for (const auto axis : axes_) varied_values.push_back(values[axis]);
    return cache_->get(varied_values, [&] { return make(varied_values); });
}

std::string ForceFactory::recording_summary() const {
    if (!is_recording_) return "";
    const auto& samples = nominal_->samples;
    return fmt::format("{} samples at {} Hz, checksum {:016x}", samples.size(), nominal_->clock.rate(),
                       checksum_of(std::as_bytes(std::span(samples))));
}

}  // namespace corpuscle::sweeps
