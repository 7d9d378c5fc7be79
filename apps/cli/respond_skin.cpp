// corpuscle respond --population: a force through a whole skin.

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "force_words.hpp"
#include "printable.hpp"
#include "recording_words.hpp"
#include "signal/stimuli.hpp"
#include "signal/text.hpp"
#include "skin/class_settings.hpp"
#include "skin_outputs.hpp"
#include "study/skin_checkpoint.hpp"
#include "study/skin_ranks.hpp"
#include "terminal.hpp"

namespace corpuscle {
namespace {

constexpr double skin_rate = 1e3;  // Hz, of stimuli
constexpr const char* usual_indenter = "flat";

/// What is said for afferents on channels, and means nothing to a skin.
Result<void> check_skin_words(const RespondWords& w) {
    const RespondWords plain;
    const std::pair<const char*, bool> words[] = {{"--afferent", w.afferents != plain.afferents},
                                                  {"--copies", w.copies > 0},
                                                  {"--spread", !w.spreads.empty()},
                                                  {"--noise", w.noise.has_value()},
                                                  {"--float", w.in_float},
                                                  {"--traces", w.traces},
                                                  {"--vectors", w.vectors},
                                                  {"--npz", w.npz},
                                                  {"--wav", w.wav},
                                                  {"--trace", !w.netlists.traces.empty()},
                                                  {"--corner", w.netlists.corner.has_value()},
                                                  {"--supply", w.netlists.supply.has_value()},
                                                  {"--temp", w.netlists.temp.has_value()},
                                                  {"--mismatch", w.netlists.mismatch.has_value()}};
    for (const auto& [word, said] : words)
        if (said)
            return bad_usage(
                fmt::format("{} does not go with --population: a population file says which afferents stand in a skin and how "
                            "they differ ('corpuscle list skins', doc/skin.md)",
                            word));
    if (w.forces.size() != 1) return bad_usage(fmt::format("--population answers one FORCE, not {}", w.forces.size()));
    return {};
}

/// A force that has a name as a touch, or null.
const NamedTouch* touch_of(const std::string& force) {
    const auto all = named_touches();
    const auto at = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == force; });
    return at == all.end() ? nullptr : &*at;
}

/// What is to be answered, made from words.
struct SkinJob {
    std::vector<Wish> wishes;
    std::unique_ptr<Source> source;
    std::shared_ptr<const Innervation> skin;
    std::unique_ptr<Contact> contact;  ///< none: force at the sites
    std::unique_ptr<SkinForce> force;
    SkinTold told;
    std::string name;
};

/// Wishes for a touch's own parts, behind the user's, which go before them.
void add_touch(std::vector<Wish>& wishes, const NamedTouch& touch) {
    const auto add = [&](std::string_view of, const std::vector<Setting>& settings) {
        for (const auto& s : settings)
            if (std::none_of(wishes.begin(), wishes.end(), [&](const Wish& w) { return w.of == of && w.parameter == s.name; }))
                wishes.push_back({std::string(of), std::string(s.name), fmt::format("{}", s.value), true});
    };
    add("contact", touch.settings);
    add(touch.force, touch.force_settings);
}

Result<void> check_skin_wishes(const SkinJob& job) {
    std::vector<std::string_view> names = {"contact", job.source->name()};
    for (const auto& c : job.skin->plan.classes) names.push_back(c.name);
    for (const auto& w : job.wishes)
        if (!w.used) return bad_usage(fmt::format("--set {}: no '{}' takes part{}", w.text(), w.of, did_you_mean(w.of, names)));
    return {};
}

Result<void> open_contact(SkinJob& job, const RespondWords& w, const NamedTouch* touch) {
    const auto& sites = job.skin->plan.sites;
    const std::size_t channels = job.source->channels().size();
    if (channels > 1 || sites.size() == 1) {
        if (!w.contact.empty())
            return bad_usage(
                fmt::format("--contact {}: {} has {} channels; an indenter is pressed with one", w.contact, job.source->name(), channels));
        auto at = sites_of(job.skin->plan, *job.source);
        if (!at) return at.error();
        job.force = site_force(*job.source, std::move(*at), sites.size());
        return {};
    }
    const std::string indenter = !w.contact.empty() ? w.contact : touch ? std::string(touch->indenter) : usual_indenter;
    auto contact = make_contact(indenter, job.wishes, sites, job.source->clock());
    if (!contact) return contact.error();
    job.contact = std::move(*contact);
    job.force = pressed_force(*job.source, *job.contact);
    return {};
}

Result<SkinJob> prepare_skin(const RespondWords& w) {
    if (auto ok = check_skin_words(w); !ok) return ok.error();
    SkinJob job;
    for (const auto& text : w.settings) {
        auto wish = parse_wish(text);
        if (!wish) return wish.error();
        job.wishes.push_back(std::move(*wish));
    }
    const auto* touch = touch_of(w.forces[0]);
    if (touch) add_touch(job.wishes, *touch);
    auto options = recording_options(w);
    if (!options) return options.error();
    auto source = open_force(touch ? std::string(touch->force) : w.forces[0], *options, job.wishes, skin_rate, w.seed);
    if (!source) return source.error();
    job.source = std::move(*source);
    job.name = touch ? std::string(touch->name) : job.source->name();
    auto plan = plan_skin(w.population, job.source->channels());
    if (!plan) return plan.error();
    if (auto ok = set_classes(*plan, job.wishes); !ok) return ok.error();
    if (w.seed != 0) plan->seed = w.seed;
    auto skin = innervate(std::move(*plan));
    if (!skin) return skin.error();
    job.skin = std::move(*skin);
    if (auto ok = open_contact(job, w, touch); !ok) return ok.error();
    if (auto ok = check_skin_wishes(job); !ok) return ok.error();
    if (!touch)
        if (auto ok = check_recording_words(w); !ok) return ok.error();
    job.told.method = w.method == "exact" ? Method::exact : Method::backward_euler;
    job.told.sampled = w.sampled;
    return job;
}

void tell_of_force(SkinJob& job) {
    auto& told = job.told;
    told.facts = job.source->facts();
    told.remarks = job.source->remarks();
    const auto quality = job.source->quality();
    told.remarks.insert(told.remarks.end(), quality.sentences.begin(), quality.sentences.end());
    told.warnings.insert(told.warnings.end(), quality.warnings.begin(), quality.warnings.end());
    if (job.contact) {
        told.contact = job.contact->sentence();
        for (auto& f : job.contact->facts()) told.facts.push_back(std::move(f));
        for (auto& r : job.contact->remarks()) told.remarks.push_back(std::move(r));
    }
    for (const auto& c : job.skin->plan.classes)
        if (job.source->clock().rate() < c.afferent.least_rate * (1 - 1e-9))
            told.warnings.push_back(fmt::format("{}: the force has {:g} samples a second; {:g} are needed", c.name,
                                                job.source->clock().rate(), c.afferent.least_rate));
    if (told.work.capped > 0)
        told.warnings.push_back(
            fmt::format("{} steps would have held more spikes than one step can and were cut short; raise the rate, or the "
                        "threshold",
                        told.work.capped));
}

/// The words that decide what is answered: a checkpoint is of these.
std::string likeness_of(const RespondWords& w) {
    return fmt::format("{} --population {} --contact '{}' --set '{}' --rate '{}' --seed {} --method {}{}", w.forces[0], w.population,
                       w.contact, fmt::join(w.settings, " "), w.rate.value_or(""), w.seed, w.method, w.sampled ? " --sampled" : "");
}

/// Who of several processes this is.
struct SkinSelf {
    std::unique_ptr<Ranks> ranks;  ///< none: alone
    bool leads() const { return !ranks || ranks->rank() == 0; }
    SkinShare share() const {
        return ranks ? SkinShare{static_cast<std::uint32_t>(ranks->rank()), static_cast<std::uint32_t>(ranks->size())} : SkinShare{};
    }
};

Result<std::unique_ptr<Skin>> seat_skin(const SkinJob& job, const SkinSelf& self) {
    const auto set = instruction_set();
    if (!set) return set.error();
    return Skin::make(job.skin, {job.source->clock().T(), job.told.method, job.told.sampled, 0, 0}, *set, self.share());
}

Result<void> lead_skin(SkinJob& job, const RespondWords& w, const Common& common, const SkinSelf& self) {
    auto skin = seat_skin(job, self);
    if (!skin) return skin.error();
    SkinSummary summary;
    SkinOutputs outputs;
    OutputCheck check(common.overwrite);
    if (auto ok = outputs.open(w, summary, check); !ok) return ok;
    Pool pool(self.ranks ? std::max(1U, w.threads) : w.threads);
    std::unique_ptr<SkinCheckpoint> checkpoint;
    if (!w.checkpoint.empty()) {
        if (self.ranks) return bad_usage("--checkpoint is for one process, not for ranks");
        auto opened = SkinCheckpoint::open(w.checkpoint, **skin, likeness_of(w));
        if (!opened) return opened.error();
        checkpoint = std::move(*opened);
        if (checkpoint->step() > 0 && !common.quiet)
            tell(fmt::format("goes on after {:.3f} s, from {}", job.source->clock().T() * static_cast<double>(checkpoint->step()),
                             w.checkpoint));
    }
    std::vector<SkinListener*> listeners = {&summary};
    outputs.listen(listeners);
    const auto answerer = self.ranks ? leading_answerer(*self.ranks, **skin, pool) : alone_answerer(**skin, pool);
    const SkinInput input{job.name, job.source->sentence(), job.source->clock(), job.source->phases(), *job.skin};
    const auto work = [&] {
        Progress progress(common.quiet);
        return run_skin(*job.force, input, *answerer, listeners,
                        {[&](double share) { return progress.at(share), !interrupted(); }, checkpoint.get()});
    }();
    if (!work && work.error().code == Code::interrupted && checkpoint)
        return Error{Code::interrupted, fmt::format("interrupted; the same command goes on from {}", w.checkpoint)};
    if (!work) return work.error();
    job.told.work = *work;
    tell_of_force(job);
    auto answer = summary.document(job.told);
    answer["files"] = outputs.names();
    const auto document = json_text(answer) + "\n";
    if (auto ok = outputs.commit(summary, job.told, document, common.command); !ok) return ok;
    if (checkpoint) checkpoint->done();
    for (const auto& r : common.quiet ? std::vector<std::string>{} : job.told.remarks) tell(fmt::format("{}: {}", job.name, r));
    for (const auto& warning : job.told.warnings) tell_warning(warning);
    if (common.json)
        fmt::print("{}", document);
    else if (!common.quiet)
        show(table(summary.table()) + outputs.told());
    return {};
}

Result<void> run_as(const RespondWords& w, const Common& common, const SkinSelf& self) {
    auto job = prepare_skin(w);
    if (!self.leads()) {
        Pool pool(std::max(1U, w.threads));
        if (!job) return follow_skin(*self.ranks, job.error(), nullptr, pool);
        auto skin = seat_skin(*job, self);
        if (!skin) return follow_skin(*self.ranks, skin.error(), nullptr, pool);
        return follow_skin(*self.ranks, job->force.get(), skin->get(), pool);
    }
    auto done = job ? lead_skin(*job, w, common, self) : Result<void>(job.error());
    if (self.ranks) dismiss_skin(*self.ranks);
    return done;
}

}  // namespace

int respond_skin(const RespondWords& words, const Common& common) {
    catch_interrupt();
    SkinSelf self;
    if (Ranks::are_started()) {
        auto ranks = Ranks::join();
        if (!ranks) return Ranks::speaks() ? fail(ranks.error()) : static_cast<int>(ranks.error().code);
        if ((*ranks)->size() > 1) self.ranks = std::move(*ranks);
    }
    const auto done = run_as(words, common, self);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
