// .dc: operating points along one or two sweeps. Each search starts from the previous point of the inner sweep, so that hysteresis is
// visible.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {
namespace {

/// One of the sweeps of a .dc line.
struct Sweep {
    std::string variable;  // name of an element, or "temp"
    double from, to, step;
    std::vector<double> values() const {
        std::vector<double> out;
        const auto count = static_cast<long>(std::floor((to - from) / step * (1 + 1e-12) + 1e-9));
        for (long k = 0; k <= count; ++k) out.push_back(from + static_cast<double>(k) * step);
        return out;
    }
};

/// Reads the four words VARIABLE FROM TO STEP, from this word on.
Result<Sweep> read_sweep(const AnalysisContext& context, const Directive& c, std::size_t word) {
    if (word >= c.words.size()) return error_at(c.location, ".dc: the sweep variable is missing");
    Sweep s{c.words[word], 0, 0, 0};
    s.from = TRY(read_number(c, word + 1, "the first value"));
    s.to = TRY(read_number(c, word + 2, "the last value"));
    const double step = s.step = TRY(read_number(c, word + 3, "the step"));
    if (s.step == 0 && s.to == s.from) s.step = 1;  // one point, with any step
    if (s.step == 0 || (s.to - s.from) / s.step < 0)
        return error_at(c.location, ".dc {}: step {:g} does not lead from {:g} to {:g}", s.variable, step, s.from, s.to);
    if ((s.to - s.from) / s.step > 1e7)
        return error_at(c.location, ".dc {}: {:g} points; the maximum is 10000000", s.variable, (s.to - s.from) / s.step);
    if (s.variable == "temp") return s;
    const auto* device = context.system.device(s.variable);
    if (device == nullptr || !device->principal_value()) {
        std::vector<std::string_view> known = {"temp"};
        for (const auto& d : context.system.devices())
            if (d->principal_value()) known.push_back(d->name);
        return error_at(c.location, ".dc: '{}' is not a source, a resistor or temp{}", s.variable, did_you_mean(s.variable, known));
    }
    return s;
}

/// The plot of a sweep, without values. Names and types of the swept curve are those of ngspice.
Plot plot_of_sweep(const System& system, std::string_view variable) {
    const bool is_temp = variable == "temp";
    const char letter = variable.empty() ? 'v' : variable[0];
    const auto name = is_temp ? "temp-sweep" : letter == 'i' ? "i-sweep" : letter == 'v' ? "v-sweep" : "res-sweep";
    const auto type = is_temp ? "temp-sweep" : letter == 'i' ? "current" : letter == 'v' ? "voltage" : "notype";
    return make_plot(system, "DC transfer characteristic", name, type);
}

/// The circuit of a sweep: the original circuit, whose values are restored at the end, or a copy at another temperature.
class SweptCircuit {
    AnalysisContext& original_;
    std::unique_ptr<AnalysisContext> copy_;  // null: temp is not swept
    struct SweptElement {
        std::string name;
        double original, present;  // principal values before the sweep and now
    };
    std::vector<SweptElement> elements_;

public:
    explicit SweptCircuit(AnalysisContext& original) : original_(original) {}
    SweptCircuit(const SweptCircuit&) = delete;
    ~SweptCircuit() {
        for (const auto& s : elements_) original_.system.device(s.name)->set_principal_value(s.original);
    }
    AnalysisContext& context() { return copy_ ? *copy_ : original_; }

    Result<void> set(const std::string& variable, double value) {
        return variable == "temp" ? set_temperature(value) : set_element(variable, value);
    }

private:
    /// The new circuit keeps the states of the devices.
    Result<void> set_temperature(double value) {
        const auto states = context().system.states();
        auto copy = std::make_shared<Circuit>(*original_.circuit);
        copy->temperature = value;
        copy_ = TRY(AnalysisContext::make(std::move(copy)));
        if (original_.chip_sample()) copy_->apply_variation(*original_.chip_sample());
        for (const auto& s : elements_) copy_->system.device(s.name)->set_principal_value(s.present);
        copy_->system.set_states(states);
        return {};
    }
    Result<void> set_element(const std::string& name, double value) {
        auto element = std::find_if(elements_.begin(), elements_.end(), [&](const SweptElement& s) { return s.name == name; });
        if (element == elements_.end())
            element = elements_.insert(element, {name, original_.system.device(name)->principal_value().value_or(0), value});
        element->present = value;
        if (!context().system.device(name)->set_principal_value(value))
            return error_at({original_.circuit->file}, ".dc: {:g} is not an allowed value of {}", value, name);
        return {};
    }
};

Result<AnalysisResult> analyse_dc(AnalysisContext& original, const Directive& c) {
    auto directive = c;
    const bool up_down = !directive.words.empty() && directive.words.back() == "updown";
    if (up_down) directive.words.pop_back();
    if (directive.words.size() != 4 && directive.words.size() != 8)
        return error_at(c.location, ".dc: {} words; expected .dc SOURCE FROM TO STEP [SOURCE2 FROM TO STEP]", directive.words.size());
    const auto inner = TRY(read_sweep(original, directive, 0));
    std::optional<Sweep> outer;
    if (directive.words.size() == 8) outer = TRY(read_sweep(original, directive, 4));
    auto values = inner.values();
    if (up_down)
        for (std::size_t k = values.size() - 1; k-- > 0;) values.push_back(values[k]);
    const auto outer_values = outer ? outer->values() : std::vector<double>{0};
    if (static_cast<double>(values.size()) * static_cast<double>(outer_values.size()) > 1e7)
        return error_at(c.location, ".dc: {} times {} points; the maximum is 10000000", values.size(), outer_values.size());

    Plot plot = plot_of_sweep(original.system, inner.variable);
    if (outer) plot.inner_points = values.size();
    AnalysisResult result;
    SweptCircuit swept(original);
    for (std::size_t k = 0; k < outer_values.size(); ++k) {
        if (outer) TRY(swept.set(outer->variable, outer_values[k]));
        swept.context().system.reset_states();
        std::vector<double> x;
        for (std::size_t j = 0; j < values.size(); ++j) {
            if (original.is_stopped(static_cast<double>(k * values.size() + j) / static_cast<double>(outer_values.size() * values.size())))
                return interrupted_error();
            TRY(swept.set(inner.variable, values[j]));
            auto& context = swept.context();
            const auto found = find_operating_point(context.newton, x);
            if (!found) {
                auto error = found.error();
                error.message = fmt::format(".dc at {} = {:g}{}: {}", inner.variable, values[j],
                                            outer ? fmt::format(", {} = {:g}", outer->variable, outer_values[k]) : "", error.message);
                return error;
            }
            x = found->x;
            append(plot, values[j], x);
            if (!found->states.empty()) result.states.push_back(found->states);
        }
    }
    result.plots.push_back(std::move(plot));
    return result;
}

Plot expected_dc_plot(const System& system, const Directive& c) { return plot_of_sweep(system, c.words.empty() ? "" : c.words[0]); }

}  // namespace

extern constexpr Analysis dc_analysis = {.name = "dc",
                                         .usage = ".dc SOURCE FROM TO STEP [SOURCE2 FROM TO STEP] [updown]",
                                         .description = "operating points while a source, a resistor or temp is swept",
                                         .run = analyse_dc,
                                         .expected_plot = expected_dc_plot,
                                         .ngspice_order = 2};

}  // namespace corpuscle::circuit
