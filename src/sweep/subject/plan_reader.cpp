// Reads the varied quantities of a sweep file into a plan.

#include <fmt/format.h>

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "core/text/ascii_text.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr double max_seed = 0x1p53 - 1;

/// The first axis for which `is` returns true, or null.
template <class F>
const ConfigNode* find_axis(const SweepText& spec, const F& is) {
    for (const auto& a : spec.axes())
        if (is(a)) return &a;
    return nullptr;
}

/// The unit of the first value in the [[vary]], for quantities whose unit the subject does not know, such as netlist parameters.
std::string unit_in(const ConfigNode& axis) {
    const auto list = axis.elements_of("list");
    const auto* first = !list.empty() ? &list.front() : axis.has("from") ? axis.get("from") : axis.get("mean");
    const auto value = first ? circuit::parse_number_with_unit(first->text) : Result<circuit::NumberWithUnit>(Error{});
    return value ? std::string(value->unit) : "";
}

}  // namespace

Result<std::uint64_t> seed_of(const SweepText& spec) {
    const auto* given = spec.get("seed");
    const auto seed = TRY(given ? parse_integer(*given, "seed", 0, max_seed) : 0);
    return static_cast<std::uint64_t>(seed);
}

class PlannedSweep::PlanReader {
    const SweepText& spec_;
    PlannedSweep& sweep_;
    std::optional<circuit::NetlistVariants> variants_;  // axes and chips of the .step and .mc lines of a netlist; none for a model
    SweepPlan plan_;

    bool netlist_samples_chips() const { return variants_ && variants_->has_chips(); }

    /// Reads whether process and mismatch are sampled: from the sweep file; if it samples neither, from the netlist's .mc.
    Result<void> chips() {
        const auto* first = find_axis(spec_, is_chips_axis);
        if (first && !variants_)
            return axis_name(*first).error_here(
                fmt::format("{} is a model; '{}' applies to the chips of a circuit", sweep_.subject_name(), axis_name(*first).text));
        if (!first && netlist_samples_chips()) {
            plan_.chips.has_process = variants_->chips().has_process, plan_.chips.has_mismatch = variants_->chips().has_mismatch;
            if (!spec_.get("seed")) plan_.chips.seed = variants_->chips().seed;
        }
        for (const auto& a : spec_.axes()) {
            if (!is_chips_axis(a)) continue;
            const auto& name = axis_name(a);
            if (a.entries.size() > 1)
                return name.error_here(fmt::format("{}: its distribution comes from the {}; remove the other keys", name.text,
                                                   name.text == "noise" ? "devices" : "process card"));
            bool& one = name.text == "process"    ? plan_.chips.has_process
                        : name.text == "mismatch" ? plan_.chips.has_mismatch
                                                  : plan_.chips.has_noise;
            if (name.text == "noise" && !TRY(circuit::read_transient_plan(*sweep_.circuit())).noise.is_on())
                return name.error_here("noise: the transients have none; add its highest frequency, such as set.noisefmax = \"1kHz\"");
            if (name.text != "noise" && !circuit::varies_with_chip(*sweep_.circuit()))
                return name.error_here(
                    fmt::format("{}: nothing in the netlist varies, so all chips would be equal: it has no UICM transistor (level=80), no "
                                "tolerance and no random value; remove this axis",
                                name.text));
            if (one) return name.error_here(fmt::format("'{}' varies twice", name.text));
            one = true;
        }
        return {};
    }

    /// Reads the number of samples of each point.
    Result<void> samples() {
        const auto* sampled_axis = find_axis(spec_, is_chips_axis);
        if (!sampled_axis) sampled_axis = find_axis(spec_, is_sampled);
        if (const auto* given = spec_.get("samples")) {
            plan_.samples = TRY(parse_integer(*given, "samples", 1, 1e9));
            if (!sampled_axis && !netlist_samples_chips() && plan_.samples > 1)
                return given->error_here(
                    fmt::format("samples = {}, but nothing is sampled, so all samples would be equal; remove samples (the number of items "
                                "follows from the listed values)",
                                plan_.samples));
        } else if (netlist_samples_chips()) {
            plan_.samples = static_cast<std::int64_t>(variants_->chips().count);
        } else if (sampled_axis) {
            return axis_name(*sampled_axis)
                .error_here(
                    fmt::format("{} is sampled, but the number of samples is missing: samples = 1000", axis_name(*sampled_axis).text));
        }
        return {};
    }

    /// Adds the axes of the netlist's own .step, except those of quantities that the sweep file varies.
    Result<void> steps() {
        if (!variants_) return {};
        for (const auto& step : variants_->axes()) {
            if (find_axis(spec_, [&](const ConfigNode& a) { return equal_ignoring_case(axis_name(a).text, step.name); })) continue;
            const auto target = TRY(sweep_.find_quantity({step.name, {}}));
            SweepAxis axis{target.column, step.values};
            target.vary(plan_.axes.size(), {});
            plan_.axes.push_back(std::move(axis));
        }
        return {};
    }

    /// Adds the axis of one [[vary]].
    Result<void> axis(const ConfigNode& in) {
        const auto& name = axis_name(in);
        for (const auto& other : plan_.axes)
            if (equal_ignoring_case(other.column.name, name.text)) return name.error_here(fmt::format("'{}' varies twice", name.text));
        auto target = TRY(sweep_.find_quantity(name));
        if (target.column.unit.empty() && target.check) target.column.unit = unit_in(in);
        auto axis = TRY(axis_of(in, target, plan_));
        target.vary(plan_.axes.size(), axis.column.labels);
        plan_.axes.push_back(std::move(axis));
        return {};
    }

public:
    PlanReader(const SweepText& spec, PlannedSweep& sweep) : spec_(spec), sweep_(sweep) {}

    Result<SweepPlan> read() {
        if (sweep_.circuit()) variants_ = TRY(circuit::NetlistVariants::create(TRY(sweep_.netlist_.nominal())));
        plan_.chips.seed = TRY(seed_of(spec_));
        TRY(chips());
        TRY(samples());
        TRY(steps());
        for (const auto& a : spec_.axes())
            if (!is_chips_axis(a)) TRY(axis(a));
        double count = static_cast<double>(plan_.samples);
        for (const auto& a : plan_.axes) count *= a.values.empty() ? 1 : static_cast<double>(a.values.size());
        if (count > SweepPlan::max_items)
            return bad_input(fmt::format("{:g} items are more than the limit of {:g}", count, SweepPlan::max_items), {spec_.file()});
        return std::move(plan_);
    }
};

Result<SweepPlan> PlannedSweep::read_plan(const SweepText& spec) { return PlanReader(spec, *this).read(); }

}  // namespace corpuscle::sweeps
