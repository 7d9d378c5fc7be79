#include "sweep/subject/subject.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/variant/netlist_overrides.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "model/catalog.hpp"
#include "sweep/spec/mismatch_samples.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr double max_seed = 0x1p53 - 1;

/// Reads the varied quantities of a sweep file into a plan.
class PlanReader {
    const SweepText& spec_;
    const VariableQuantities& quantities_;
    const circuit::NetlistVariants* variants_;
    circuit::ChipSpec chips_{0, 0, false, false};  // neither process nor mismatch is sampled yet
    SamplingSpec sampling_;
    std::vector<SweepAxis> axes_;

    bool netlist_samples_chips() const { return variants_ && variants_->has_chips(); }
    /// The first [[vary]] of the sweep file that samples process or mismatch, or null.
    const AxisSpec* chips_axis() const {
        for (const auto& a : spec_.axes)
            if (a.name.text == "process" || a.name.text == "mismatch") return &a;
        return nullptr;
    }

    /// Reads whether process and mismatch are sampled: from the sweep file; if it samples neither, from the netlist's .mc.
    Result<void> chips() {
        chips_.seed = sampling_.seed;
        const auto* spec = chips_axis();
        if (spec && !quantities_.can_sample_chips)
            return spec->name.error_here(
                fmt::format("{} is a model; '{}' applies to the chips of a circuit", quantities_.subject_name, spec->name.text));
        if (!spec && netlist_samples_chips()) {
            chips_.has_process = variants_->chips().has_process, chips_.has_mismatch = variants_->chips().has_mismatch;
            if (!spec_.seed) chips_.seed = sampling_.seed = variants_->chips().seed;
        }
        for (const auto& a : spec_.axes) {
            if (a.name.text != "process" && a.name.text != "mismatch") continue;
            if (a.distribution || a.from || a.to || a.count || a.list || a.mean || a.sigma || a.log || a.min || a.max)
                return a.name.error_here(
                    fmt::format("{}: its distribution comes from the process card; remove the other keys", a.name.text));
            bool& one = a.name.text == "process" ? chips_.has_process : chips_.has_mismatch;
            if (one) return a.name.error_here(fmt::format("'{}' varies twice", a.name.text));
            one = true;
        }
        return {};
    }

    /// Reads the number of samples of each point.
    Result<void> samples() {
        const AxisSpec* sampled_axis = chips_axis();  // the first axis with random samples, or null
        for (const auto& a : spec_.axes)
            if (!sampled_axis && is_sampled(a)) sampled_axis = &a;
        if (spec_.samples) {
            const auto samples = TRY(parse_integer(*spec_.samples, "samples", 1, 1e9));
            if (!sampled_axis && !netlist_samples_chips() && samples > 1)
                return spec_.samples->error_here(
                    fmt::format("samples = {}, but nothing is sampled, so all samples would be equal; remove samples (the number of items "
                                "follows from the listed values)",
                                samples));
            sampling_.samples = static_cast<std::uint64_t>(samples);
        } else if (netlist_samples_chips()) {
            sampling_.samples = static_cast<std::uint64_t>(variants_->chips().count);
        } else if (sampled_axis) {
            return sampled_axis->name.error_here(
                fmt::format("{} is sampled, but the number of samples is missing: samples = 1000", sampled_axis->name.text));
        }
        return {};
    }

    /// True if the sweep file varies this quantity.
    bool is_in_file(std::string_view name) const {
        return std::any_of(spec_.axes.begin(), spec_.axes.end(), [&](const AxisSpec& a) { return equal_ignoring_case(a.name.text, name); });
    }

    /// Adds the axes of the netlist's own .step, except those of quantities that the sweep file varies.
    Result<void> steps() {
        if (!variants_) return {};
        for (const auto& step : variants_->axes()) {
            if (is_in_file(step.name)) continue;
            const auto target = TRY(quantities_.find_quantity({step.name, {}}));
            SweepAxis axis{target.column, step.values};
            quantities_.vary(axis, step.name, axes_.size());
            axes_.push_back(std::move(axis));
        }
        return {};
    }

    /// The unit of the first value in the [[vary]], for quantities whose unit the subject does not know, such as netlist parameters.
    static std::string unit_in(const AxisSpec& spec) {
        const LocatedText* first = spec.list && !spec.list->empty() ? &spec.list->front()
                                   : spec.from                      ? &*spec.from
                                   : spec.mean                      ? &*spec.mean
                                                                    : nullptr;
        const auto value = first ? circuit::parse_number_with_unit(first->text) : Result<circuit::NumberWithUnit>(Error{});
        return value ? std::string(value->unit) : "";
    }

    /// Adds the axis of one [[vary]].
    Result<void> axis(const AxisSpec& spec) {
        for (const auto& other : axes_)
            if (equal_ignoring_case(other.column.name, spec.name.text))
                return spec.name.error_here(fmt::format("'{}' varies twice", spec.name.text));
        auto target = TRY(quantities_.find_quantity(spec.name));
        if (target.column.unit.empty() && target.check) target.column.unit = unit_in(spec);
        auto axis = TRY(axis_of(spec, target, sampling_));
        quantities_.vary(axis, spec.name.text, axes_.size());
        axes_.push_back(std::move(axis));
        return {};
    }

public:
    PlanReader(const SweepText& spec, const VariableQuantities& quantities, const circuit::NetlistVariants* variants)
        : spec_(spec), quantities_(quantities), variants_(variants) {}

    Result<SweepPlan> read() {
        const auto seed = TRY(seed_of(spec_));
        sampling_.seed = seed;
        TRY(chips());
        TRY(samples());
        TRY(steps());
        for (const auto& a : spec_.axes)
            if (a.name.text != "process" && a.name.text != "mismatch") TRY(axis(a));
        double count = static_cast<double>(sampling_.samples);
        for (const auto& a : axes_) count *= a.values.empty() ? 1 : static_cast<double>(a.values.size());
        if (count > SweepPlan::max_items)
            return bad_input(fmt::format("{:g} items are more than the limit of {:g}", count, SweepPlan::max_items), {spec_.file});
        return SweepPlan(std::move(axes_), chips_, static_cast<std::int64_t>(sampling_.samples));
    }
};

/// Reads one line of [limits] into its column.
Result<void> set_limit(const LimitSpec& limit, const MeasureLookup& lookup, std::vector<SweepColumn>& columns) {
    const auto at = TRY(lookup.column(limit.measure));
    auto& column = columns[at];
    const auto wrong = [&](const LocatedText& s, std::string why) { return s.error_here(fmt::format("{}: {}", limit.measure.text, why)); };
    const auto read = [&](const LocatedText& s) {
        const auto value = parse_quantity(s.text, column.unit);
        return value ? value : Result<double>(wrong(s, value.error().message));
    };
    if (limit.like) {
        if (limit.min || limit.max) return wrong(*limit.like, "give either like and within, or at_least and at_most");
        if (!limit.within) return wrong(*limit.like, "within is missing: the allowed distance from the model, such as 3 or \"10%\"");
        const auto model = TRY(lookup.model_value(*limit.like, at));
        if (std::isnan(model)) return wrong(*limit.like, fmt::format("{} has no value for this force", limit.like->text));
        // A percentage is relative to the model's value, also for a measure without unit, where read() turns "10%" into 0.1.
        const bool is_percentage = trimmed(limit.within->text).ends_with('%') && !column.unit.empty();
        auto within = is_percentage ? parse_quantity(limit.within->text, "") : read(*limit.within);
        if (!within) return wrong(*limit.within, within.error().message);
        if (is_percentage || trimmed(limit.within->text).ends_with('%')) *within *= std::abs(model);
        if (!(*within >= 0)) return wrong(*limit.within, "within must not be negative");
        column.min = model - *within, column.max = model + *within;
        return {};
    }
    if (limit.within) return wrong(*limit.within, "within is allowed only with like, such as like = \"sa1\"");
    for (const auto& [spec, end] : {std::pair{&limit.min, &column.min}, {&limit.max, &column.max}}) {
        if (!*spec) continue;
        *end = TRY(read(**spec));
    }
    if (!limit.min && !limit.max) return wrong(limit.measure, "the limit is empty; write at_least, at_most or both");
    if (column.min && column.max && *column.min > *column.max)
        return wrong(limit.min ? *limit.min : limit.measure, "at_least is above at_most");
    return {};
}

}  // namespace

void PlannedSweep::add_mismatch_metadata(const std::string& subject, const circuit::Circuit& circuit) {
    if (!plan_.chips().has_mismatch) return;
    MismatchSamples samples;
    samples.seed = plan_.chips().seed, samples.chips = plan_.samples();
    samples.subjects.push_back({subject, mismatch_devices(circuit)});
    metadata_.push_back({mismatch_metadata_name, format_mismatch_samples(samples)});
}

Result<std::uint64_t> seed_of(const SweepText& spec) {
    if (!spec.seed) return std::uint64_t{0};
    const auto seed = TRY(parse_integer(*spec.seed, "seed", 0, max_seed));
    return static_cast<std::uint64_t>(seed);
}

Result<SweepPlan> plan_of(const SweepText& spec, const VariableQuantities& quantities, const circuit::NetlistVariants* variants) {
    return PlanReader(spec, quantities, variants).read();
}

Result<void> set_limits(const SweepText& spec, const MeasureLookup& lookup, std::vector<SweepColumn>& columns) {
    for (const auto& limit : spec.limits) TRY(set_limit(limit, lookup, columns));
    return {};
}

Result<bool> keeps_spikes(const SweepText& spec) {
    if (!spec.keep) return true;
    for (const auto& word : *spec.keep)
        if (word.text != "spikes")
            return word.error_here(fmt::format("keep: '{}' is unknown; try \"spikes\" (traces are kept with traces = [...])", word.text));
    return !spec.keep->empty();
}

Result<std::size_t> probe_stride(const SweepText& spec, double T) {
    double every = 1e-3;
    if (spec.every) {
        const auto value = parse_quantity(spec.every->text, "s");
        if (!value) return spec.every->error_here("every: " + value.error().message);
        if (!(*value > 0 && *value < 1e9))
            return spec.every->error_here(fmt::format("every = {} must be above 0 s and below 1e9 s", spec.every->text));
        every = *value;
    }
    return static_cast<std::size_t>(std::max(1.0, std::round(every / T)));
}

std::vector<Sweep::MetadataText> first_metadata(const SweepText& spec, const std::string& title) {
    std::vector<Sweep::MetadataText> out = {{"title", spec.title ? spec.title->text : title},
                                            {"results format", fmt::format("{}", results_format)}};
    if (!spec.canonical.empty()) out.push_back({"sweep file", spec.canonical});
    return out;
}

}  // namespace corpuscle::sweeps
