#include "run/skin/skin_outcome.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "io/table/foreign_format.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"
#include "run/firing_factor.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

template <class T>
void append(std::vector<T>& to, std::vector<T> more) {
    std::move(more.begin(), more.end(), std::back_inserter(to));
}

/// A note if the force has shear and no class feels it; otherwise "".
std::string unfelt_shear_note(const SkinPlan& plan, bool source_has_shear, const std::vector<MetadataEntry>& metadata) {
    const bool has_shear = source_has_shear || std::any_of(metadata.begin(), metadata.end(), [](const MetadataEntry& m) {
                               return m.name == "contact.tilt" || m.name == "contact.friction";
                           });
    const bool is_felt = std::any_of(plan.classes.begin(), plan.classes.end(), [](const SkinClass& c) { return c.direction.gain > 0; });
    if (!has_shear || is_felt) return "";
    return fmt::format(
        "the shear has no effect: no class of {} has a direction_gain; in a population file, write direction_gain = 0.5 in "
        "[[class]]",
        plan.name);
}

/// A remedy for a force that is too weak: the setting or option that multiplies it by `factor`; "" if there is none.
std::string stronger_stimulus_advice(const ForceSource& source, double factor, bool has_unit) {
    const auto metadata = source.metadata();
    if (!is_stimulus(source.name())) {
        // The metadata of a recording begins with the scale of its first channel.
        const bool has_gain = !metadata.empty() && metadata[0].name.ends_with("newtons per unit");
        return has_gain
                   ? fmt::format("try --scale {}{}", format_rounded_up(factor * metadata[0].value), has_unit ? " instead of --unit" : "")
                   : "";
    }
    // The parameter of the stimulus with the largest force is assumed to be its amplitude.
    const MetadataEntry* largest = nullptr;
    for (const auto& f : metadata)
        if (f.unit == "N" && (!largest || f.value > largest->value)) largest = &f;
    return largest ? fmt::format("try --set {}={}N", largest->name, format_rounded_up(factor * largest->value)) : "";
}

}  // namespace

SkinOutcome::SkinOutcome(const SkinScene& scene, const RespondOptions& run) : innervation(scene.innervation), options(run) {
    options.pool = nullptr, options.should_continue = {};  // they end with the run
}

void SkinOutcome::finish(const ForceSource& source, const SkinScene& scene, const RunStats& stats, const SkinRunWords& words) {
    notes.stats = stats;
    add_force_notes(source, scene);
    add_response_warnings(source);
    add_silence_notes(source, scene.contact != nullptr, words);
    add_rate_warnings(source.clock().T());
}

/// Metadata, notes and warnings about force and contact.
void SkinOutcome::add_force_notes(const ForceSource& source, const SkinScene& scene) {
    auto quality = source.quality();
    notes.metadata = source.metadata();
    for (auto& some : {source.notes(), quality.descriptions, scene.force->notes(), scene.notes}) append(notes.notes, some);
    append(notes.warnings, std::move(quality.warnings));
    if (scene.contact) {
        notes.contact = scene.contact->description();
        append(notes.metadata, scene.contact->metadata());
        append(notes.notes, scene.contact->notes());
    }
    if (auto note = unfelt_shear_note(plan(), source.has_shear(), notes.metadata); !note.empty()) notes.notes.push_back(std::move(note));
}

/// Warnings about the sampling rate, the noise of the sensor, and steps with too many spikes.
void SkinOutcome::add_response_warnings(const ForceSource& source) {
    const double rate = source.clock().rate();
    for (const auto& c : plan().classes)
        if (auto text = rate_warning(c.afferent, c.name, rate); !text.empty()) notes.warnings.push_back(std::move(text));
    std::vector<NoiseSubject> subjects;
    for (const auto& c : plan().classes) subjects.push_back({c.name, &c.afferent});
    if (auto text = sensor_noise_warning(source, subjects, options.for_clock(source.clock())); !text.empty())
        notes.warnings.push_back(std::move(text));
    if (notes.stats.truncated_steps > 0)
        notes.warnings.push_back(
            fmt::format("{} time steps reached the spike limit of one step and were truncated; increase the sampling rate or the "
                        "threshold",
                        notes.stats.truncated_steps));
}

/// A message about one class: "fa1 received at most 0.1 N, and needs about 0.5 N of the same stimulus to fire (5 times as much)".
std::string SkinOutcome::silence_text(const SilentClass& silent) const {
    const auto& c = plan().classes[silent.class_index];
    if (!(silent.max_force > 0)) return c.name + " received no force";
    auto text = fmt::format("{} received at most {:.2g} N", c.name, silent.max_force);
    if (!silent.factor)
        text += ", and would not fire even at a million times this force";
    else if (*silent.factor < 1.1)  // a bound of the force, scaled from the total force, which changes faster than that on one afferent
        text += ", and is close to firing: it needs a little more force, or faster changes";
    else
        text += fmt::format(", and needs about {} N of the same stimulus to fire ({} times as much)",
                            format_rounded_up(*silent.factor * silent.max_force), format_rounded_up(*silent.factor));
    const auto advice = nerve_advice(c.afferent);
    return advice.empty() ? text : text + "; " + advice;
}

/// Reports the silent classes: as a warning if all classes are silent, else as a note.
void SkinOutcome::add_silence_notes(const ForceSource& source, bool has_contact, const SkinRunWords& words) {
    const auto silent = silence_.silent_classes(options);
    if (silent.empty()) return;
    constexpr double margin = 1.25;  // on the factor, because the afferents of a class vary and receive different forces
    std::vector<std::string> messages;
    std::optional<double> min_factor;  // of the class that needs the least additional force
    for (const auto& s : silent) {
        messages.push_back(silence_text(s));
        if (s.factor) min_factor = std::min(*s.factor, min_factor.value_or(*s.factor));
    }
    const bool any_force = std::any_of(silent.begin(), silent.end(), [](const SilentClass& s) { return s.max_force > 0; });
    const bool all = silent.size() == plan().classes.size();
    auto text = fmt::format("{}: {}", all ? "no afferent fired" : "never fired", joined(messages, "; "));
    if (all && min_factor)
        if (const auto remedy = stronger_stimulus_advice(source, margin * *min_factor, words.has_unit); !remedy.empty())
            text += "; " + remedy;
    if (all && !any_force && has_contact)
        text += fmt::format(
            "; --set contact.x=... and --set contact.y=... place the indenter (for positions see afferents.csv, or type: corpuscle list {} "
            "--sites)",
            quote_shell_word(words.population));
    (all ? notes.warnings : notes.notes).push_back(std::move(text));
}

/// Warns of classes in which afferents fire faster than a nerve fibre can.
void SkinOutcome::add_rate_warnings(double T) {
    for (std::size_t c = 0; c < plan().classes.size(); ++c) {
        const auto& of = plan().classes[c];
        const auto [count, rate] = summary.count_faster_than(c, max_nerve_rate);
        if (count > 0)
            notes.warnings.push_back(fmt::format("{} of {} {} afferents: {}", count,
                                                 innervation->class_begin[c + 1] - innervation->class_begin[c], of.name,
                                                 excessive_rate_warning(rate, T, of.afferent, of.name)));
    }
}

nlohmann::ordered_json SkinOutcome::document() const { return summary.document(options, notes); }

}  // namespace corpuscle
