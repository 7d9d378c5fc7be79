#include "sweep/subject/subject.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "measure/measure_base.hpp"
#include "sweep/spec/mismatch_samples.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr auto limit_keys = std::to_array<ConfigKey>({"at_least", "at_most", "like", "within"});

/// True for the limits of one measure, {at_least = 1}, rather than a table of further measures.
bool is_limit(const ConfigNode& table) {
    return table.is_inline || table.entries.empty() ||
           std::any_of(std::begin(limit_keys), std::end(limit_keys), [&](const ConfigKey& key) { return table.has(key.name); });
}

/// True if spike trains are written to the results (key keep), which is the default.
Result<bool> keeps_spikes(const SweepText& spec) {
    const auto* keep = spec.get("keep");
    if (!keep) return true;
    for (const auto& word : keep->elements)
        if (word.text != "spikes")
            return word.error_here(fmt::format("keep: '{}' is unknown; try \"spikes\" (traces are kept with traces = [...])", word.text));
    return !keep->elements.empty();
}

}  // namespace

/// Reads the limits of one measure, {at_least = ..., at_most = ...} or {like = "sa1", within = ...}, into its column.
Result<void> PlannedSweep::set_limit(const ConfigNode& node, const LocatedText& measure) {
    const auto at = TRY(measure_column(measure));
    auto& column = measures[at];
    const auto wrong = [&](const LocatedText& s, std::string why) { return s.error_here(fmt::format("{}: {}", measure.text, why)); };
    const auto read = [&](const LocatedText& s, const std::string& unit) {
        return s.located(parse_quantity(s.text, unit), measure.text + ": ");
    };
    const auto *min = node.is_list() ? &node.elements[0] : node.get("at_least"),
               *max = node.is_list() ? &node.elements[1] : node.get("at_most"), *like = node.get("like"), *within = node.get("within");
    if (like) {
        if (min || max) return wrong(*like, "give either like and within, or at_least and at_most");
        if (!within) return wrong(*like, "within is missing: the allowed distance from the model, such as 3 or \"10%\"");
        const auto model = TRY(model_value(*like, at));
        if (std::isnan(model)) return wrong(*like, fmt::format("{} has no value for this force", like->text));
        const bool is_percentage = trimmed(within->text).ends_with('%');  // of the model's value; also for a measure without unit
        const double given = TRY(read(*within, is_percentage ? "" : column.unit));
        const double distance = is_percentage ? given * std::abs(model) : given;
        if (!(distance >= 0)) return wrong(*within, "within must not be negative");
        column.min = model - distance, column.max = model + distance;
        return {};
    }
    if (within) return wrong(*within, "within is allowed only with like, such as like = \"sa1\"");
    if (min) column.min = TRY(read(*min, column.unit));
    if (max) column.max = TRY(read(*max, column.unit));
    if (!min && !max) return wrong(measure, "the limit is empty; write at_least, at_most or both");
    if (column.min && column.max && *column.min > *column.max) return wrong(min ? *min : measure, "at_least is above at_most");
    return {};
}

/// Reads [limits]. Without quotes, a measure with a dot in its name (spikes.plateau) is a nested table in TOML, so this calls itself.
/// `prefix`: the part of the name up to the dot.
Result<void> PlannedSweep::set_limits(const ConfigNode& table, const std::string& prefix) {
    for (const auto& [key, value] : table.entries) {
        const LocatedText measure{prefix + key.text, key.location};
        if (value.is_table() && !is_limit(value)) {
            TRY(set_limits(value, measure.text + "."));
            continue;
        }
        if (!value.is_list() && !value.is_table())
            return value.error_here(
                fmt::format("{0}: write {0} = [min, max], or {{at_least = ...}}, {{at_most = ...}}, {{like = \"sa1\", "
                            "within = ...}}",
                            measure.text));
        if (value.is_list() && value.elements.size() != 2)
            return value.error_here(fmt::format("{}: a limit needs two numbers, [min, max]", measure.text));
        for (const auto& number : value.elements) TRY(check_scalar(number, measure.text));
        TRY(check_keys(value, limit_keys, measure.text + ": "));
        TRY(set_limit(value, measure));
    }
    return {};
}

Result<void> PlannedSweep::prepare(const SweepText& spec, const std::string& folder) {
    TRY(open(spec, folder));
    plan_ = TRY(read_plan(spec));
    item_count = plan_.item_count(), axes = plan_.columns();
    if (plan_.samples_chips() && circuit()->mismatch_seed)
        return bad_input("[set] selects one chip by mismatch = ..., but the sweep samples others; remove one of the two", {spec.file()});
    if (const auto* given = spec.get("iterations"); given && circuit()) {
        iteration_limit_ = static_cast<long>(TRY(parse_integer(*given, "iterations", 1, 1e12)));
    }
    TRY(select_measures(spec));
    if (const auto* limits = spec.get("limits")) TRY(set_limits(*limits, ""));
    const bool keeps = TRY(keeps_spikes(spec));
    TRY(select_outputs(spec, keeps));
    const auto* given_title = spec.get("title");
    metadata = {{"title", given_title ? given_title->text : title()}, {"results format", fmt::format("{}", results_format)}};
    if (!spec.canonical.empty()) metadata.push_back({"sweep file", spec.canonical});
    if (circuit())
        for (auto& entry : netlist_.metadata()) metadata.push_back(std::move(entry));
    if (auto recorded = force_.recording_summary(); !recorded.empty())
        metadata.push_back({"recording " + force_.name(), std::move(recorded)});
    if (plan_.chips.has_mismatch) {
        const MismatchSamples samples{plan_.chips.seed, plan_.samples, {{subject_name(), mismatch_devices(*circuit())}}};
        metadata.push_back({mismatch_metadata_name, format_mismatch_samples(samples)});
    }
    return {};
}

long PlannedSweep::find_iteration_limit(const std::function<bool()>& stop) const {
    if (iteration_limit_ > 0) return iteration_limit_;
    const std::lock_guard lock(mutex_);
    if (nominal_iteration_limit_) return *nominal_iteration_limit_;
    const auto iterations = nominal_iterations(stop);
    if (!iterations && iterations.error().code == ErrorCode::interrupted) return 0;
    nominal_iteration_limit_ = iterations ? static_cast<long>(iteration_limit_factor_ * static_cast<double>(*iterations)) : 0;
    return *nominal_iteration_limit_;
}

ItemOutcome PlannedSweep::failed_outcome(std::int64_t item, std::string reason, ItemEnd end) const {
    ItemOutcome out{item, end, std::move(reason)};
    out.measures.assign(measures.size(), no_value);
    out.spikes.resize(train_names.size());
    out.probes = padded_probes({});
    return out;
}

std::vector<std::vector<float>> PlannedSweep::padded_probes(std::vector<std::vector<float>> samples) const {
    samples.resize(probe_names.size());
    for (auto& probe : samples) probe.resize(probe_times.size(), std::numeric_limits<float>::quiet_NaN());
    return samples;
}

}  // namespace corpuscle::sweeps
