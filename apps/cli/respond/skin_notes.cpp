// Notes and warnings about the run of a skin.

#include <fmt/format.h>
#include <algorithm>

#include "cli/respond/skin_run.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "io/table/foreign_format.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

namespace {

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

}  // namespace

/// Collects metadata and notes of force and contact, and warnings about the force and the steps of the run. Call it after the run.
void SkinRun::add_force_notes() {
    auto& notes = notes_;
    notes.metadata = source_->metadata();
    notes.notes = source_->notes();
    const auto quality = source_->quality();
    notes.notes.insert(notes.notes.end(), quality.descriptions.begin(), quality.descriptions.end());
    notes.warnings.insert(notes.warnings.end(), quality.warnings.begin(), quality.warnings.end());
    for (auto& note : scene_.force->notes()) notes.notes.push_back(std::move(note));
    notes.notes.insert(notes.notes.end(), scene_.notes.begin(), scene_.notes.end());
    if (scene_.contact) {
        notes.contact = scene_.contact->description();
        for (auto& f : scene_.contact->metadata()) notes.metadata.push_back(std::move(f));
        for (auto& r : scene_.contact->notes()) notes.notes.push_back(std::move(r));
    }
    if (auto note = unfelt_shear_note(scene_.innervation->plan, source_->has_shear(), notes.metadata); !note.empty())
        notes.notes.push_back(std::move(note));
    for (const auto& c : scene_.innervation->plan.classes)
        if (source_->clock().rate() < c.afferent.min_rate * (1 - 1e-9))
            notes.warnings.push_back(
                fmt::format("{}: the sampling rate of the force is {:g} Hz; {:g} Hz or more is needed: vibration above "
                            "{:g} Hz is missing",
                            c.name, source_->clock().rate(), c.afferent.min_rate, source_->clock().rate() / 2));
    std::vector<NoiseSubject> subjects;
    for (const auto& c : scene_.innervation->plan.classes) subjects.push_back({c.name, &c.afferent});
    if (auto text = sensor_noise_warning(*source_, subjects, options_.for_clock(source_->clock())); !text.empty())
        notes.warnings.push_back(std::move(text));
    if (notes.stats.truncated_steps > 0)
        notes.warnings.push_back(
            fmt::format("{} time steps reached the spike limit of one step and were truncated; increase the sampling rate or the "
                        "threshold",
                        notes.stats.truncated_steps));
}

/// A remedy for a force that is too weak: the setting or option that multiplies it by `factor`; "" if there is none.
std::string SkinRun::stronger_stimulus_advice(double factor) const {
    const auto metadata = source_->metadata();
    if (!is_stimulus(source_->name())) {
        // The metadata of a recording begins with the scale of its first channel.
        const bool has_gain = !metadata.empty() && metadata[0].name.ends_with("newtons per unit");
        return has_gain ? fmt::format("try --scale {}{}", format_rounded_up(factor * metadata[0].value),
                                      args_.recording.unit ? " instead of --unit" : "")
                        : "";
    }
    // The parameter of the stimulus with the largest force is assumed to be its amplitude.
    const MetadataEntry* largest = nullptr;
    for (const auto& f : metadata)
        if (f.unit == "N" && (!largest || f.value > largest->value)) largest = &f;
    return largest ? fmt::format("try --set {}={}N", largest->name, format_rounded_up(factor * largest->value)) : "";
}

/// Reports the silent classes: as a warning if all classes are silent, else as a note.
void SkinRun::add_silence_notes() {
    const auto silent = silence_.silent_classes(options_);
    constexpr double margin = 1.25;  // on the factor, because the afferents of a class vary and receive different forces
    std::vector<std::string> messages;
    std::optional<double> min_factor;  // of the class that needs the least additional force
    for (const auto& s : silent) {
        auto text = scene_.innervation->plan.classes[s.class_index].name;
        if (!(s.max_force > 0))
            text += " received no force";
        else if (!s.factor)
            text += fmt::format(" received at most {:.2g} N, and would not fire even at a million times this force", s.max_force);
        else if (*s.factor < 1.1)  // a bound of the force, scaled from the total force, which changes faster than that on one afferent
            text += fmt::format(" received at most {:.2g} N, and is close to firing: it needs a little more force, or faster changes",
                                s.max_force);
        else
            text += fmt::format(" received at most {:.2g} N, and needs about {} N of the same stimulus to fire ({} times as much)",
                                s.max_force, format_rounded_up(*s.factor * s.max_force), format_rounded_up(*s.factor));
        if (const auto advice = nerve_advice(scene_.innervation->plan.classes[s.class_index].afferent); s.max_force > 0 && !advice.empty())
            text += "; " + advice;
        messages.push_back(std::move(text));
        if (s.factor) min_factor = std::min(*s.factor, min_factor.value_or(*s.factor));
    }
    if (silent.empty()) return;
    const bool any_force = std::any_of(silent.begin(), silent.end(), [](const SilentClass& s) { return s.max_force > 0; });
    const bool all = silent.size() == scene_.innervation->plan.classes.size();
    auto text = fmt::format("{}: {}", all ? "no afferent fired" : "never fired", joined(messages, "; "));
    if (all && min_factor)
        if (const auto remedy = stronger_stimulus_advice(margin * *min_factor); !remedy.empty()) text += "; " + remedy;
    if (all && !any_force && scene_.contact)
        text += fmt::format(
            "; --set contact.x=... and --set contact.y=... place the indenter (for positions see afferents.csv, or type: corpuscle list {} "
            "--sites)",
            quote_shell_word(args_.population));
    (all ? notes_.warnings : notes_.notes).push_back(std::move(text));
}

/// Warns of classes in which afferents fire faster than a nerve fibre can.
void SkinRun::add_rate_warnings() {
    for (std::size_t c = 0; c < scene_.innervation->plan.classes.size(); ++c) {
        const auto& plan = scene_.innervation->plan.classes[c].afferent;
        const auto [count, rate] = summary_.count_faster_than(c, max_nerve_rate);
        if (count > 0)
            notes_.warnings.push_back(
                fmt::format("{} of {} {} afferents: {}", count, scene_.innervation->class_begin[c + 1] - scene_.innervation->class_begin[c],
                            scene_.innervation->plan.classes[c].name,
                            excessive_rate_warning(rate, source_->clock().T(), plan, scene_.innervation->plan.classes[c].name)));
    }
}

}  // namespace corpuscle
