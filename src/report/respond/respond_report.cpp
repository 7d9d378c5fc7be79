#include "report/respond/respond_report.hpp"

#include <algorithm>

#include "report/page_template.hpp"
#include "report/trials_document.hpp"
#include "run/channels/channel_population.hpp"
#include "run/summary/grouped_notes.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_input_labels = 8;  // of compared inputs: more could not be told apart by colour, so all are averaged together

Json parameter_or_null(const AfferentPlan& plan, std::string_view name) {
    const auto value = plan.value(name);
    return value ? Json(*value) : Json(nullptr);
}

/// The length of a part for dividing `length` into at least `parts` parts: the largest such number of the form 1, 2 or 5 times a power of
/// ten.
double round_part(double length, int parts) {
    const double max = length / parts * (1 + 1e-9);
    double decade = 1;
    while (decade > max) decade /= 10;
    while (10 * decade <= max) decade *= 10;
    return decade * (max >= 5 * decade ? 5 : max >= 2 * decade ? 2 : 1);
}

/// The entries of a list whose channel is one of the first `count`.
Json first_channels(const Json& all, std::uint32_t count, const char* key = "channel") {
    Json out = Json::array();
    for (const auto& entry : all)
        if (entry[key] < count) out.push_back(entry);
    return out;
}

/// The rows of a table whose cell in this column is one of the names.
Json rows_of(const Json& rows, std::size_t column, const std::vector<std::string>& names) {
    Json out = Json::array();
    for (const auto& row : rows)
        if (std::find(names.begin(), names.end(), row[column].get_ref<const std::string&>()) != names.end()) out.push_back(row);
    return out;
}

/// Reduces the data of a page to the first channels.
void keep_first_channels(Json& document, std::uint32_t count) {
    std::vector<std::string> names;
    for (auto& input : document["inputs"]) {
        input["channels"] = first_channels(input["channels"], count, "id");
        for (const auto& channel : input["channels"]) names.push_back(channel["name"]);
    }
    for (const auto* list : {"traces", "spikes"}) document[list] = first_channels(document[list], count);
    if (document.contains("copies")) document["copies"]["rates"] = first_channels(document["copies"]["rates"], count);
    for (const auto& [table, column] : {std::pair{"table", 1U}, {"comparisons", 1U}, {"quality", 0U}})
        document[table]["rows"] = rows_of(document[table]["rows"], column, names);
}

}  // namespace

Result<void> RespondReport::begin(const Input& input) {
    const auto& afferents = input.on_channels();
    const auto channels = afferents.channels();
    groups_ = copy_group_starts(afferents.plans());
    std::size_t traces = 1;  // number of traces per channel: the force and all probes
    for (std::size_t g = 0; g < groups(); ++g) traces += afferents.plan_probes(groups_[g]).size();
    // The limit of samples of one trace. The factor 2 is for longer traces, which are kept as pairs of minimum and maximum.
    const std::size_t max_points =
        std::clamp<std::size_t>(max_points_ / (2 * traces * channels * input.input_count), 16, std::size_t{1} << 20);
    forces_.assign(channels, Envelope(max_points));
    probes_.clear(), hidden_pulses_.clear();
    for (std::size_t k = 0; wants_probes() && k < channels * groups(); ++k) {
        const auto first_copy = groups_[k % groups()];
        probes_.emplace_back(afferents.plan_probes(first_copy).size(), Envelope(max_points));
        hidden_pulses_.emplace_back(afferents.plans()[first_copy], afferents.plan_probes(first_copy));
    }
    trains_.assign(afferents.size(), {});
    if (recordables_.empty())
        for (std::size_t g = 0; g < groups(); ++g) {
            Json probe_list = Json::array();
            for (const auto& p : afferents.plan_probes(groups_[g])) probe_list.push_back({{"name", p.name}, {"unit", p.unit}});
            recordables_.push_back(std::move(probe_list));
            first_copies_.push_back(afferents.plans()[groups_[g]]);
        }  // once: the plans and probes are the same for every input
    if (!compared_inputs_ && compares_inputs_ && input.input_count > 1 && copies_.count == 0)
        compared_inputs_.emplace(TrialOptions{}, std::vector<Trial>{});
    return compared_inputs_ ? compared_inputs_->begin(input) : Result<void>();
}

Result<void> RespondReport::block(const Input& input, const RunBlock& response) {
    for (std::size_t c = 0; c < forces_.size(); ++c)
        for (const double f : response.force[c]) forces_[c].add(f);
    for (std::size_t u = 0; u < probes_.size(); ++u)
        for (std::size_t p = 0; p < probes_[u].size(); ++p)
            for (std::size_t k = 0; k < response.steps; ++k) {
                const double value = response.probes[afferent_index(u / groups(), u % groups())][p][k];
                probes_[u][p].add(value);
                if (hidden_pulses_[u].uses(p)) hidden_pulses_[u].add(value);
            }
    for (const auto& s : response.spikes) trains_[input.afferent_of(s)].push_back(input.clock.time(s.step, s.offset));
    return compared_inputs_ ? compared_inputs_->block(input, response) : Result<void>();
}

/// Adds to the page the spike trains of an afferent (or of its first max_copies copies) on a channel of this input.
void RespondReport::add_spikes(const Input& input, std::size_t channel, std::size_t group) {
    const std::size_t shown = std::min<std::size_t>(groups_[group + 1] - groups_[group], max_copies);
    for (std::size_t k = 0; k < shown; ++k) {
        const auto& train = trains_[afferent_index(channel, group) + k];
        spikes_.push_back({{"afferent", input.on_channels().plans()[groups_[group] + k].name},
                           {"channel", first_channel_ + channel},
                           {"count", train.size()},
                           {"times", array_document(train)}});
    }
}

/// Adds to the page the firing rate in equal bins, Hz: the mean over the copies of an afferent.
void RespondReport::add_rate(const Input& input, std::size_t channel, std::size_t group, std::int64_t samples) {
    auto clock = input.clock;
    // With t0 = 0 the clock gives the duration of `samples` samples.
    const double t0 = std::exchange(clock.t0, 0.0), length = clock.time(samples), bin = round_part(length, 100);
    const auto copies = groups_[group + 1] - groups_[group];
    std::vector<double> rates(static_cast<std::size_t>(std::max(std::ceil(length / bin - 1e-9), 1.0)));
    for (std::size_t k = 0; k < copies; ++k)
        for (const double t : trains_[afferent_index(channel, group) + k])
            ++rates[std::min(static_cast<std::size_t>(std::max(t - t0, 0.0) / bin + 1e-9), rates.size() - 1)];
    for (std::size_t b = 0; b < rates.size(); ++b)
        rates[b] /= static_cast<double>(copies) * std::min(bin, length - static_cast<double>(b) * bin);  // the last bin may be shorter
    rates_.push_back({{"afferent", base_name(input.on_channels().plans()[groups_[group]])},
                      {"channel", first_channel_ + channel},
                      {"bin", bin},
                      {"values", rates}});
}

void RespondReport::add_hidden_notes(const Input& input) {
    const auto& afferents = input.on_channels();
    for (std::size_t u = 0; u < hidden_pulses_.size(); ++u) {
        const auto index = afferent_index(u / groups(), u % groups());
        if (const auto note = hidden_pulses_[u].note(trains_[index].size(), input.clock.T()); !note.empty())
            hidden_notes_.push_back(
                fmt::format("{} on {}: {}", afferents.plans()[groups_[u % groups()]].name, afferents.channel_name(index), note));
    }
}

Result<void> RespondReport::end(const Input& input, std::int64_t samples, std::span<const Spike> last) {
    const auto& afferents = input.on_channels();
    Json channels = Json::array(), phases = Json::array();
    for (std::size_t c = 0; c < forces_.size(); ++c) {
        channels.push_back({{"id", first_channel_ + c}, {"name", afferents.channel(c)}, {"unit", "N"}});
        traces_.push_back(curve_document(first_channel_ + static_cast<std::uint32_t>(c), nullptr, "force", "N", forces_[c]));
    }
    for (const auto& p : input.phases) phases.push_back({{"name", p.name}, {"from", p.from}, {"to", p.to}});
    for (std::size_t c = 0; c < forces_.size(); ++c)
        for (std::size_t g = 0; g < groups(); ++g) {
            const auto probes = afferents.plan_probes(groups_[g]);
            for (std::size_t p = 0; !probes_.empty() && p < probes.size(); ++p)
                traces_.push_back(curve_document(first_channel_ + static_cast<std::uint32_t>(c), base_name(afferents.plans()[groups_[g]]),
                                                 probes[p].name, probes[p].unit, probes_[c * groups() + g][p]));
            add_spikes(input, c, g);
            if (copies_.count > 0) add_rate(input, c, g, samples);
        }
    add_hidden_notes(input);
    inputs_.push_back({{"name", input.name},
                       {"description", input.description},
                       {"t0", input.clock.t0},
                       {"T", input.clock.T()},
                       {"samples", samples},
                       {"phases", phases},
                       {"channels", channels}});
    first_channel_ += static_cast<std::uint32_t>(forces_.size());
    return compared_inputs_ ? compared_inputs_->end(input, samples, last) : Result<void>();
}

Json RespondReport::compared_inputs_document() const {
    if (!compared_inputs_) return nullptr;
    auto inputs = *compared_inputs_;
    if (inputs.responses.labels().size() > max_input_labels)
        for (auto& trial : inputs.responses.trials) trial.label = "all inputs";
    return trials_document(inputs, inputs.responses.default_bin({}));
}

std::string RespondReport::page(const RunSummary& summary, std::span<const AfferentPlan> plans, const std::string& command,
                                const std::vector<std::string>& warnings, const Json& costs, std::size_t max_bytes,
                                const Json& trials) const {
    std::vector<std::string> names, texts(warnings);
    for (const auto& i : summary.inputs) names.push_back(i.name);
    const auto title = short_list(names);
    Json afferents = Json::array(), notes = Json::array();
    for (std::size_t a = 0; a < plans.size(); ++a) {
        const auto& plan = plans[a];
        afferents.push_back({{"name", plan.name},
                             {"type", afferent_type_of(plan.name)},
                             {"netlist", plan.traits().is_implementation},
                             {"composition", plan.composition()},
                             {"description", plan.description},
                             {"V_th", parameter_or_null(first_copies_[a], "V_th")},
                             {"V_reset", parameter_or_null(first_copies_[a], "V_reset")},
                             {"parameters", parameters_document(plan, copies_.distributions)},
                             {"probes", recordables_[a]}});
    }
    for (const auto& i : summary.inputs)
        for (const auto& r : i.notes) texts.push_back(i.name + ": " + r);
    texts.insert(texts.end(), hidden_notes_.begin(), hidden_notes_.end());
    for (auto& text : grouped_notes(texts)) notes.push_back(std::move(text));
    Json document = {{"inputs", inputs_},
                     {"afferents", afferents},
                     {"traces", traces_},
                     {"spikes", spikes_},
                     {"table", rates_document(summary)},
                     {"comparisons", implementations_document(summary.comparisons)},
                     {"quality", quality_document(summary)},
                     {"notes", notes},
                     {"versions", versions_document()},
                     {"costs", costs}};
    if (auto shown_trials = trials.is_null() ? compared_inputs_document() : trials; !shown_trials.is_null())
        document["trials"] = std::move(shown_trials);
    if (copies_.count > 0)
        document["copies"] = {
            {"count", copies_.count}, {"shown", std::min(copies_.count, max_copies)}, {"has_probes", wants_probes()}, {"rates", rates_}};
    const auto shown = channels_within(max_bytes);
    if (shown == 0) return "";
    if (shown < first_channel_) {
        keep_first_channels(document, shown);
        document["notes"].push_back(fmt::format("This page shows {} of {} channels.", shown, first_channel_));
    }
    return report_page("respond", title, command, document);
}

std::uint32_t RespondReport::channels_within(std::size_t max_bytes) const {
    constexpr std::size_t per_entry = 200;  // bytes of names and punctuation
    std::vector<std::size_t> bytes(first_channel_);
    for (const auto& t : traces_) bytes[t["channel"]] += encoded_size(t["data"]) + per_entry;
    for (const auto& s : spikes_) bytes[s["channel"]] += encoded_size(s["times"]) + 2 * per_entry;  // a row of the table
    std::size_t total = 0;
    std::uint32_t count = 0;
    while (count < bytes.size() && (total += bytes[count]) <= max_bytes) ++count;
    return count;
}

}  // namespace corpuscle
