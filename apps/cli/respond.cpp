// corpuscle respond: words to sources, afferents and listeners; the run; what is printed of it.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "force_words.hpp"
#include "netlist_words.hpp"
#include "outputs.hpp"
#include "printable.hpp"
#include "recording_words.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"
#include "study/afferents.hpp"
#include "study/nerve_limit.hpp"
#include "study/silence.hpp"
#include "study/summary.hpp"
#include "terminal.hpp"
#include "verbs.hpp"
#include "versions_table.hpp"

namespace corpuscle {
namespace {

constexpr double default_rate = 10e3;          // Hz, of stimuli
constexpr std::size_t most_rows = 60;          // of the table on a terminal
constexpr std::size_t most_rows_in_full = 24;  // silence is shown up to here

struct Job {
    std::vector<Wish> wishes;
    std::vector<AfferentPlan> afferents;  // as asked for
    Copies population;
    std::vector<AfferentPlan> copies;  // of each afferent, or each itself
    std::vector<std::unique_ptr<Source>> sources;
    RespondOptions options;
    std::vector<std::string> warnings;
};

Result<std::vector<Wish>> spread_wishes(const RespondWords& w) {
    if (w.copies == 0 && !w.spreads.empty())
        return bad_usage(fmt::format("--spread {}: it tells copies apart; say how many: --copies 100", w.spreads[0]));
    std::vector<Wish> wishes;
    for (const auto& text : w.spreads) {
        auto wish = parse_wish(text);
        if (!wish) return bad_usage(fmt::format("--spread '{}': write NAME.PARAMETER=DEVIATION, such as 'sa1.f_B=10%'", text));
        wishes.push_back(std::move(*wish));
    }
    return wishes;
}

/// A netlist's parameters have no capitals.
std::vector<Wish> in_small_letters(std::vector<Wish> wishes) {
    for (auto& w : wishes) w.parameter = lower(w.parameter);
    return wishes;
}

/// Puts the copies of every afferent in its place, if copies are asked for.
Result<void> populate(Job& job, const RespondWords& w) {
    const auto wishes = spread_wishes(w);
    if (!wishes) return wishes.error();
    job.population.copies = w.copies;
    if (w.copies == 0) job.copies = job.afferents;
    for (std::size_t a = 0; w.copies > 0 && a < job.afferents.size(); ++a) {
        const auto own = job.afferents[a].design ? in_small_letters(*wishes) : *wishes;
        auto spreads = spreads_for(job.afferents[a], w.afferents[a], own);
        for (std::size_t k = 0; k < own.size(); ++k) (*wishes)[k].used |= own[k].used;
        if (!spreads) return spreads.error();
        auto copies = copies_of(job.afferents[a], w.copies, *spreads, w.seed);
        if (!copies) return copies.error();
        for (auto& copy : *copies)
            if (auto ok = remake(copy, job.afferents[a]); !ok) return ok;
        std::move(copies->begin(), copies->end(), std::back_inserter(job.copies));
        std::move(spreads->begin(), spreads->end(), std::back_inserter(job.population.spreads));
    }
    std::vector<std::string_view> names;
    for (const auto& a : job.afferents) names.push_back(a.name);
    for (const auto& wish : *wishes)
        if (!wish.used)
            return bad_usage(fmt::format("--spread {}: no afferent '{}' takes part{}", wish.text(), wish.of, did_you_mean(wish.of, names)));
    return {};
}

/// Units have numbers of 32 bits.
Result<void> check_units(const Job& job) {
    std::uint64_t units = 0;
    for (const auto& s : job.sources) units += s->channels().size() * job.copies.size();
    if (units <= std::numeric_limits<std::uint32_t>::max()) return {};
    return bad_usage(fmt::format("--copies {}: {} afferents on their channels are too many; ask for fewer copies or channels",
                                 job.population.copies, units));
}

/// Every wish must have found whom it is for.
Result<void> check_wishes(const Job& job) {
    std::vector<std::string_view> names;
    for (const auto& a : job.afferents) names.push_back(a.name);
    for (const auto& s : job.sources) names.push_back(s->name());
    for (const auto& w : job.wishes)
        if (!w.used)
            return bad_usage(fmt::format("--set {}: no afferent or stimulus '{}' takes part{}", w.text(), w.of, did_you_mean(w.of, names)));
    return {};
}

/// What is asked of netlists must have found one.
Result<void> check_netlist_words(const NetlistWords& w, const OfNetlists& asked) {
    if (const auto said = said_of(w); !said.empty() && !asked.used)
        return bad_usage(fmt::format("{}: no netlist takes part; try --afferent sa1-circuit", said));
    for (std::size_t k = 0; k < asked.traces.size(); ++k)
        if (!asked.traced[k])
            return bad_input(
                fmt::format("--trace {}: no netlist that takes part has such a node or device{}", asked.traces[k], asked.hint));
    return {};
}

Result<void> plan_afferents(Job& job, const RespondWords& w) {
    const OfNetlists asked{knobs_of(w.netlists), traces_of(w.netlists)};
    for (const auto& name : w.afferents) {
        auto plan = plan_any_afferent(name, job.wishes, asked);
        if (!plan) return plan.error();
        if (std::any_of(job.afferents.begin(), job.afferents.end(), [&](const auto& a) { return a.name == plan->name; }))
            return bad_usage(fmt::format("--afferent {}: given twice", name));
        job.afferents.push_back(std::move(*plan));
    }
    return check_netlist_words(w.netlists, asked);
}

Result<Job> prepare(const RespondWords& w, bool quiet) {
    Job job;
    if (w.forces.empty()) return bad_usage("respond: no FORCE given; try 'corpuscle respond press'");
    for (const auto& text : w.settings) {
        auto wish = parse_wish(text);
        if (!wish) return wish.error();
        job.wishes.push_back(std::move(*wish));
    }
    if (auto ok = plan_afferents(job, w); !ok) return ok.error();
    if (auto ok = populate(job, w); !ok) return ok.error();
    auto options = recording_options(w);
    if (!options) return options.error();
    Progress progress(quiet);
    options->keep_on = [&](double share) { return progress.at(share), !interrupted(); };
    for (const auto& force : w.forces) {
        auto source = open_force(force, *options, job.wishes, default_rate, w.seed);
        if (!source) return source.error();
        job.sources.push_back(std::move(*source));
    }
    if (auto ok = check_wishes(job); !ok) return ok.error();
    if (auto ok = check_recording_words(w); !ok) return ok.error();
    if (auto ok = check_units(job); !ok) return ok.error();
    if (w.vectors && !w.out.empty() &&
        std::all_of(job.afferents.begin(), job.afferents.end(), [](const auto& a) { return a.converter.empty(); }))
        return bad_usage(
            fmt::format("--vectors: {} has no converter, and so no words; try 'adc+{}'", job.afferents[0].name, job.afferents[0].name));
    job.options.method = w.method == "exact" ? Method::exact : Method::backward_euler;
    job.options.sampled = w.sampled;
    job.options.precision = w.in_float ? Precision::in_float : Precision::in_double;
    const auto noise = quantity(w.noise, "A", "--noise");
    if (!noise) return noise.error();
    if (noise->value_or(0) < 0)
        return bad_usage(fmt::format("--noise '{}' is below 0; write a standard deviation, such as '50 nA'", *w.noise));
    job.options.noise = noise->value_or(0);
    job.options.seed = w.seed;
    job.warnings = rate_warnings(job.sources, job.afferents);
    for (auto& warning : noise_warnings(job.afferents, job.options.noise)) job.warnings.push_back(std::move(warning));
    return job;
}

std::string cell(const Measure& m, double x) { return std::isnan(x) ? "-" : fmt::format("{:.{}f}", x, m.decimals); }

/// Of copies: their mean and standard deviation, a count with a decimal.
std::string cell(const RateRow& row, std::size_t m) {
    if (row.over.empty()) return cell(measures[m], row.values[m]);
    const int decimals = std::max(measures[m].decimals, 1);
    const double mean = row.over[m].mean(), deviation = row.over[m].deviation();
    if (std::isnan(mean)) return "-";
    return fmt::format("{:.{}f}", mean, decimals) + (std::isnan(deviation) ? "" : fmt::format(" +- {:.{}f}", deviation, decimals));
}

/// A line an input: what was answered, so that a wrong unit or clock is seen.
std::string inputs_table(const Summary& summary) {
    std::string text;
    for (const auto& i : summary.inputs())
        text += fmt::format("{}: {}{} samples at {}, {}, {:.4g} to {:.4g} N\n", printable(i.name),
                            i.channels.size() == 1 ? "" : fmt::format("{} channels, ", i.channels.size()), i.samples,
                            format_quantity(i.clock.rate(), "Hz"), format_quantity(static_cast<double>(i.samples) * i.clock.T(), "s"),
                            i.least + 0.0, i.greatest + 0.0);  // no -0
    return text;
}

std::string copies_line(const Copies& population) {
    if (population.copies == 0) return "";
    return population.copies == 1
               ? "1 copy of each afferent\n"
               : fmt::format("{} copies of each afferent; mean +- standard deviation of those that have a value\n", population.copies);
}

/// With many rows, those of an afferent that no channel made fire say nothing.
std::string rate_table(const Summary& summary) {
    std::map<std::pair<std::string, std::string>, double> spikes;
    for (const auto& r : summary.rows()) spikes[{r.afferent, r.channel}] += r.values[0];
    const bool all = summary.rows().size() <= most_rows_in_full;
    std::vector<std::vector<std::string>> rows = {{"afferent", "channel", "phase"}};
    const auto columns = summary.columns();
    for (const auto c : columns) rows[0].push_back(heading(measures[c]));
    std::size_t more = 0;
    for (const auto& r : summary.rows()) {
        if (!all && spikes[{r.afferent, r.channel}] == 0) continue;
        if (rows.size() > most_rows && ++more) continue;
        rows.push_back({r.afferent, r.channel, r.phase});
        for (const auto c : columns) rows.back().push_back(cell(r, c));
    }
    auto text = table(rows);
    if (more > 0) text += fmt::format("... and {} rows more; --out writes them all to summary.json\n", more);
    const auto silent = std::count_if(spikes.begin(), spikes.end(), [](const auto& s) { return s.second == 0; });
    if (!all && silent > 0) text += fmt::format("Silent, and not shown: {} of {} afferents on their channels.\n", silent, spikes.size());
    return text;
}

/// Warnings are printed always, remarks unless it is to be quiet.
void print_remarks(const Job& job, bool quiet) {
    for (const auto& s : job.sources)
        for (const auto& r : quiet ? std::vector<std::string>{} : s->remarks()) tell(fmt::format("{}: {}", s->name(), r));
    for (const auto& w : job.warnings) tell_warning(w);
}

void warn(Job& job, std::string sentence) {
    tell_warning(sentence);
    job.warnings.push_back(std::move(sentence));
}

/// What was found of the recordings while they were read.
void print_quality(Job& job, const Summary& summary, bool quiet) {
    for (const auto& i : summary.inputs()) {
        for (const auto& s : quiet ? std::vector<std::string>{} : i.quality.sentences) tell(fmt::format("{}: {}", i.name, s));
        for (const auto& s : i.quality.warnings) warn(job, fmt::format("{}: {}", i.name, s));
    }
}

/// Rates that no nerve has, of each afferent on the channel where it is fastest.
void warn_of_rates(Job& job, const Summary& summary) {
    constexpr auto peak = place_of_measure<PeakRate>;
    for (const auto& plan : job.afferents) {
        const RateRow* fastest = nullptr;
        double rate = nerve_limit;
        for (const auto& row : summary.rows())
            if (const double r = row.over.empty() ? row.values[peak] : row.over[peak].greatest; row.afferent == plan.name && r > rate)
                fastest = &row, rate = r;
        if (fastest) warn(job, fmt::format("{}: on {} {}", plan.name, fastest->channel, rate_sentence(rate, plan, plan.name)));
    }
}

/// Netlists on their channels.
std::size_t netlists(const Job& job) {
    std::size_t all = 0;
    for (const auto& s : job.sources)
        for (const auto& a : job.copies) all += a.design ? s->channels().size() : 0;
    return all;
}

/// The spikes of every unit, for the document on standard output.
class SpikeTimes final : public Listener {
    nlohmann::ordered_json units_ = nlohmann::ordered_json::array();
    std::size_t first_ = 0;

public:
    Result<void> begin(const Input& input) override {
        first_ = units_.size();
        for (std::size_t u = 0; u < input.units(); ++u)
            units_.push_back({{"afferent", input.afferent_of(u).name},
                              {"channel", input.channel_name(input.channel_of(u))},
                              {"times_s", nlohmann::ordered_json::array()}});
        return {};
    }
    Result<void> block(const Input& input, const Answered& answered) override {
        for (const auto& s : answered.spikes)
            units_[first_ + s.unit - input.first_unit]["times_s"].push_back(input.source.clock().time(s.step, s.offset));
        return {};
    }
    const nlohmann::ordered_json& document() const { return units_; }
};

/// Files of which there is one an input, an afferent or a channel.
std::vector<std::string> later_names(const Job& job, const RespondWords& w) {
    std::vector<std::string> all;
    std::size_t channels = 0;
    for (std::size_t k = 0; k < job.sources.size(); ++k) {
        const auto number = k == 0 ? "" : fmt::format("-{}", k + 1);
        if (w.traces) all.push_back(fmt::format("traces{}.csv", number));
        if (w.wav) all.push_back(fmt::format("spikes{}.wav", number));
        channels += job.sources[k]->channels().size();
    }
    for (const auto& a : job.copies) {
        if (!w.vectors || a.converter.empty()) continue;
        all.push_back(fmt::format("rom-{}.csv", a.name));
        for (std::size_t c = 1; c <= channels; ++c)
            all.push_back(fmt::format("vectors-{}{}.csv", a.name, c == 1 ? "" : fmt::format("-{}", c)));
    }
    return all;
}

Result<void> run(const RespondWords& w, const Common& common) {
    auto job = prepare(w, common.quiet);
    if (!job) return job.error();
    Outputs outputs;
    OutputCheck check(common.overwrite);
    if (auto ok = outputs.open(w, job->population, later_names(*job, w), check); !ok) return ok;
    print_remarks(*job, common.quiet);

    Pool pool(w.threads);
    job->options.pool = &pool;
    Summary summary;
    Silence silence;
    std::vector<Listener*> listeners = {&summary, &silence};
    outputs.listen(listeners);
    SpikeTimes times;
    if (common.json) listeners.push_back(&times);
    Result<Work> work = [&] {
        Progress progress(common.quiet);
        job->options.keep_on = [&](double share) { return progress.at(share), !interrupted(); };
        return respond(job->sources, job->copies, listeners, job->options);
    }();
    if (!work) return work.error();
    print_quality(*job, summary, common.quiet);
    for (const auto& warning : work_warnings(*work)) warn(*job, warning);
    warn_of_rates(*job, summary);
    const auto silent = silence.found(job->copies, job->options);
    for (const auto& s : common.quiet ? std::vector<SilentAfferent>{} : silent) fmt::print(stderr, "corpuscle: {}\n", sentence_of(s));
    auto answer = summary.document(job->afferents, *work, job->options, w.seed, job->warnings);
    if (job->population.copies > 0) answer["copies"] = document_of(job->population);
    for (const auto& s : silent)
        answer["silent"].push_back({{"afferent", s.name},
                                    {"force_max_N", s.force},
                                    {"factor_to_fire", s.factor ? nlohmann::ordered_json(*s.factor) : nlohmann::ordered_json(nullptr)}});
    const auto costs = answer.value("costs", nlohmann::ordered_json::array());
    answer["files"] = outputs.names();
    const auto document = json_text(answer) + "\n";
    if (auto ok = outputs.commit(summary, job->afferents, job->warnings, document, common.command, costs); !ok) return ok;
    if (common.json) answer["spikes"] = times.document();
    if (common.json)
        fmt::print("{}\n", json_text(answer));
    else if (!common.quiet)
        show(inputs_table(summary) + copies_line(job->population) + rate_table(summary) + versions_table(summary.comparisons()) +
             outputs.told());
    if (!work->lost.empty()) {
        auto error = work->lost[0];
        error.sentence = fmt::format("{} of {} netlists on their channels did not converge; the first: {}", work->lost.size(),
                                     netlists(*job), error.sentence);
        return error;
    }
    return {};
}

}  // namespace

int respond(const RespondWords& asked, const Common& common) {
    if (!asked.population.empty()) return respond_skin(asked, common);
    catch_interrupt();
    auto words = asked;
    if (!words.netlists.traces.empty()) {
        if (words.out.empty() && !words.report)
            return fail(bad_usage(
                fmt::format("{} needs --out DIR or --report to be written into", said_of({{}, {}, {}, {}, words.netlists.traces}))));
        words.traces |= !words.out.empty();
    }
    const auto done = run(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
