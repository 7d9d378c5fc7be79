// corpuscle respond --population: a force through a whole skin.

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "force_words.hpp"
#include "printable.hpp"
#include "recording_words.hpp"
#include "signal/stimuli.hpp"
#include "signal/text.hpp"
#include "signal/version.hpp"
#include "skin/class_settings.hpp"
#include "skin/pressed.hpp"
#include "skin_outputs.hpp"
#include "skin_spike_times.hpp"
#include "study/nerve_limit.hpp"
#include "study/silence.hpp"
#include "study/skin_checkpoint.hpp"
#include "study/skin_ranks.hpp"
#include "study/skin_silence.hpp"
#include "terminal.hpp"

namespace corpuscle {
namespace {

constexpr double skin_rate = 1e3;  // Hz, of stimuli
constexpr const char* usual_indenter = "flat";

/// Options of afferents on channels that a skin does not have: each with the reason and what to do.
Result<void> check_skin_words(const RespondWords& w) {
    struct Refusal {
        const char* option;
        bool given;
        const char* reason;
    };
    constexpr const char* in_file = "the population file says which afferents stand in the skin ('corpuscle list skins', doc/skin.md)";
    constexpr const char* spread =
        "the units of a skin are its copies: density, per_site and spread in the population file say how many "
        "there are and how they differ (doc/skin.md)";
    constexpr const char* traces =
        "currents and membranes of a whole skin are not kept; run one afferent without --population for them, or "
        "take units.csv and --bin 10ms";
    constexpr const char* netlists =
        "a skin's afferents are equations, not netlists; run one with --afferent sa1-circuit, without "
        "--population";
    const RespondWords plain;
    const Refusal refusals[] = {
        {"--afferent", w.afferents != plain.afferents, in_file},
        {"--copies", w.copies > 0, spread},
        {"--spread", !w.spreads.empty(), spread},
        {"--noise", w.noise.has_value(), "membranes of a skin have no noise; press+noise as FORCE is a noisy touch"},
        {"--float", w.in_float, "a skin is computed in double precision only; leave --float out"},
        {"--traces", w.traces, traces},
        {"--trace", !w.netlists.traces.empty(), netlists},
        {"--vectors", w.vectors, "afferents of a skin have no converter; run one with --afferent sa1-kim, without --population"},
        {"--wav", w.wav, "a click a spike of thousands of afferents is noise; run one without --population to listen to it"},
        {"--corner", w.netlists.corner.has_value(), netlists},
        {"--supply", w.netlists.supply.has_value(), netlists},
        {"--temp", w.netlists.temp.has_value(), netlists},
        {"--mismatch", w.netlists.mismatch.has_value(), netlists}};
    for (const auto& r : refusals)
        if (r.given) return bad_usage(fmt::format("{} does not go with --population: {}", r.option, r.reason));
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
    std::string taken_for_skin;  ///< the sentence that says so; "": sites stand for what their population says
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
    if (job.source->channels().size() == 1) job.taken_for_skin = take_for_skin(*plan);
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
    if (!job.taken_for_skin.empty()) told.remarks.push_back(job.taken_for_skin);
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

/// The options that make the same stimulus stronger by this factor.
std::string stronger_touch(const SkinJob& job, const RespondWords& w, double factor) {
    const auto& plan = job.skin->plan;
    if (job.contact && plan.sites.area > 0 && !(plan.felt_area > 0)) {
        const auto area = std::max(factor * plan.sites.area, usual_felt_area);
        return fmt::format("set felt_area = \"{} cm2\" in {}: without it a unit feels the mean of what its sites have",
                           rounded_up(1e4 * area), w.population);
    }
    const auto facts = job.source->facts();
    if (!is_stimulus(job.source->name())) {
        const bool has_gain = !facts.empty() && facts[0].name.ends_with("newtons per unit");
        return has_gain ? fmt::format("try --scale {}{}", rounded_up(factor * facts[0].value), w.unit ? " in place of --unit" : "") : "";
    }
    const Fact* most = nullptr;
    for (const auto& f : facts)
        if (f.unit == "N" && (!most || f.value > most->value)) most = &f;
    return most ? fmt::format("try --set {}={}N", most->name, rounded_up(factor * most->value)) : "";
}

/// Classes without a spike: a warning if all are, else a remark.
void tell_of_silence(SkinJob& job, const RespondWords& w, const std::vector<SilentClass>& silent) {
    constexpr double margin = 1.25;  // units differ from their class's afferent, and no two feel the same
    std::vector<std::string> sentences;
    std::optional<double> least;
    for (const auto& s : silent) {
        auto text = job.skin->plan.classes[s.of].name;
        if (!(s.felt > 0))
            text += " felt no force";
        else if (!s.factor)
            text += fmt::format(" felt {:.2g} N at most, and a million times as much would not make it fire", s.felt);
        else
            text += fmt::format(" felt {:.2g} N at most, and fires from about {} N of the same touch on ({} times as much)", s.felt,
                                rounded_up(*s.factor * s.felt), rounded_up(*s.factor));
        sentences.push_back(std::move(text));
        if (s.factor) least = std::min(*s.factor, least.value_or(*s.factor));
    }
    if (silent.empty()) return;
    const bool reached = std::any_of(silent.begin(), silent.end(), [](const SilentClass& s) { return s.felt > 0; });
    const bool all = silent.size() == job.skin->plan.classes.size();
    auto text = fmt::format("{}: {}", all ? "no afferent fired" : "never fired", fmt::join(sentences, "; "));
    if (all && least)
        if (const auto remedy = stronger_touch(job, w, margin * *least); !remedy.empty()) text += "; " + remedy;
    if (all && !reached && job.contact)
        text +=
            "; --set contact.x=... and contact.y=... say where the indenter stands ('corpuscle list skins' and units.csv say where "
            "afferents are)";
    (all ? job.told.warnings : job.told.remarks).push_back(std::move(text));
}

/// Rates that no nerve has.
void tell_of_rates(SkinJob& job, const SkinSummary& summary) {
    for (std::size_t c = 0; c < job.skin->plan.classes.size(); ++c) {
        const auto& plan = job.skin->plan.classes[c].afferent;
        const auto [units, rate] = summary.faster_than(c, nerve_limit);
        if (units > 0)
            job.told.warnings.push_back(fmt::format("{} of {} {} afferents: {}", units, job.skin->first[c + 1] - job.skin->first[c],
                                                    job.skin->plan.classes[c].name,
                                                    rate_sentence(rate, plan, job.skin->plan.classes[c].name)));
    }
}

/// Options that change where or how the answer is written, and not the answer.
constexpr std::string_view output_options[] = {"--checkpoint", "--out",       "--report", "--bin",  "--events",
                                               "--npz",        "--overwrite", "--quiet",  "--json", "--threads"};

/// The checksum of a file's contents, if there is such a file.
Result<void> add_contents(RunFingerprint& all, const std::string& what, const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return {};
    auto contents = contents_of(path);
    if (!contents) return contents.error();
    all.emplace_back(fmt::format("contents of the {}", what), std::move(*contents));
    return {};
}

/// A population file may name others: all of them are in where its sites are.
std::string sites_checksum(const Sites& sites) {
    Checksum sum;
    for (const auto& p : sites.at) sum.add(p.x), sum.add(p.y), sum.add(p.z);
    for (const auto& name : sites.names) sum.add(std::string_view(name));
    for (const auto r : sites.region) sum.add(std::uint64_t{r});
    for (const auto& name : sites.regions) sum.add(std::string_view(name));
    sum.add(sites.area);
    return fmt::format("{} sites, checksum {:016x}", sites.size(), sum.value());
}

/// Everything that decides the response: all options but those of outputs, and the contents of the files they name.
Result<RunFingerprint> fingerprint_of(const SkinJob& job, const RespondWords& w, const Common& common) {
    RunFingerprint all = {{"the program", fmt::format("version {}", version)}, {"FORCE", w.forces[0]}};
    for (const auto& [name, values] : common.typed)
        if (name != "FORCE" && std::find(std::begin(output_options), std::end(output_options), name) == std::end(output_options))
            all.emplace_back(name, fmt::format("{}", fmt::join(values, " ")));
    if (!is_stimulus(w.forces[0]) && !touch_of(w.forces[0]))
        if (auto ok = add_contents(all, "recording", w.forces[0]); !ok) return ok.error();
    if (auto ok = add_contents(all, "population file", w.population); !ok) return ok.error();
    if (auto ok = add_contents(all, "layout file", w.layout); !ok) return ok.error();
    all.emplace_back("contents of the table of sites", sites_checksum(job.skin->plan.sites));
    return all;
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
    SkinSilence silence;
    SkinOutputs outputs;
    OutputCheck check(common.overwrite);
    if (auto ok = outputs.open(w, summary, check); !ok) return ok;
    Pool pool(self.ranks ? std::max(1U, w.threads) : w.threads);
    std::unique_ptr<SkinCheckpoint> checkpoint;
    if (!w.checkpoint.empty()) {
        if (self.ranks) return bad_usage("--checkpoint is for one process, not for ranks");
        auto fingerprint = fingerprint_of(job, w, common);
        if (!fingerprint) return fingerprint.error();
        auto opened = SkinCheckpoint::open(w.checkpoint, **skin, std::move(*fingerprint));
        if (!opened) return opened.error();
        checkpoint = std::move(*opened);
        if (checkpoint->step() > 0 && !common.quiet)
            tell(fmt::format("goes on after {:.3f} s, from {}", job.source->clock().T() * static_cast<double>(checkpoint->step()),
                             w.checkpoint));
    }
    SkinSpikeTimes times;
    std::vector<SkinListener*> listeners = {&summary, &silence};
    if (common.json) listeners.push_back(&times);
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
    tell_of_silence(job, w, silence.found(job.told.method, job.told.sampled));
    tell_of_rates(job, summary);
    auto answer = summary.document(job.told);
    answer["files"] = outputs.names();
    const auto document = json_text(answer) + "\n";
    if (auto ok = outputs.commit(summary, job.told, document, common.command); !ok) return ok;
    if (checkpoint) checkpoint->done();
    for (const auto& r : common.quiet ? std::vector<std::string>{} : job.told.remarks) tell(fmt::format("{}: {}", job.name, r));
    for (const auto& warning : job.told.warnings) tell_warning(warning);
    if (common.json) answer["spikes"] = times.document();
    if (common.json && times.are_too_many())
        tell_warning(fmt::format("{}: more than {} million spikes are not printed; --out DIR writes them to spikes.csv", job.name,
                                 SkinSpikeTimes::most / 1'000'000));
    if (common.json)
        fmt::print("{}\n", json_text(answer));
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
