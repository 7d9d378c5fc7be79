#include "circuit/analysis/transient_setup.hpp"

#include "circuit/device/named_values.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

struct Accuracy {
    std::string_view word;  // of .options accuracy=word
    double reltol, vntol;   // vntol: V
};
constexpr Accuracy accuracies[] = {{"rough", 1e-3, 1e-5}, {"normal", 1e-5, 1e-6}, {"fine", 1e-6, 1e-7}, {"finest", 1e-8, 1e-9}};

Error invalid_option(const Circuit& c, std::string_view option, std::string_view value, std::string_view known) {
    return error_at({c.file}, ".options {}={}: expected one of {}", option, value, known);
}

constexpr double start_offset = 10e-3;  // V, from an unstable operating point

Error unstable_warning(const AnalysisContext& context, const UnstableMode& mode) {
    const auto& d = mode.direction;
    const auto largest =
        std::max_element(d.begin(), d.begin() + context.system.nodes(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto node = static_cast<std::size_t>(largest - d.begin());
    return error_at({context.circuit->file},
                    "the operating point is unstable: a disturbance grows{}. The transient starts {} from it, at {}. Set .ic to choose the "
                    "start",
                    mode.rate > 0 ? fmt::format(" by a factor of {:.3g} in {}", std::exp(1.0), format_quantity(1 / mode.rate, "s"))
                                  : std::string(" while it oscillates"),
                    format_quantity(start_offset, "V"), context.system.names()[node]);
}

/// By equation, the sum of the charges that capacitors have at their ic= voltages minus those at x. An ic= current of an inductor is an
/// unknown and is written to x.
std::vector<double> charge_of_ics(const AnalysisContext& context, std::vector<double>& x) {
    std::vector<double> out;
    StampBuffer at_x, requested;
    EvalContext eval_context;
    eval_context.gmin = context.tolerances.gmin;
    for (std::size_t k = 0; k < context.circuit->elements.size(); ++k) {
        const auto& e = context.circuit->elements[k];
        const auto ic = e.values.find("ic");
        const bool is_current = has_role(e, Role::inductor);
        if (ic == e.values.end() || !(is_current || has_role(e, Role::capacitor))) continue;
        const auto& device = *context.system.devices()[k];
        if (is_current) {
            x[static_cast<std::size_t>(device.unknowns[2])] = ic->second;
            continue;
        }
        out.resize(x.size());
        const auto v = context.system.terminal_values(device, x);
        auto charged = v;
        charged[0] = v[1] + ic->second;
        const auto before = at_x.eval(device, v, eval_context).q, after = requested.eval(device, charged, eval_context).q;
        for (std::size_t n = 0; n < v.size(); ++n)
            if (const int unknown = device.unknowns[n]; unknown >= 0) out[static_cast<std::size_t>(unknown)] += after[n] - before[n];
    }
    return out;
}

/// True if no unknown jumps when the clamps of .ic at the operating point x are released. A node jumps if no charge at it takes over the
/// current of its clamp: if a short step, of length 1/a, changes its voltage.
bool keeps_released_voltages(AnalysisContext& context, std::span<const double> x) {
    constexpr double of_conductance = 1e9;                // a C, relative to G, so that the matrix is not singular to rounding
    constexpr double relative = 1e-6, v_smallest = 1e-6;  // of a jump that counts; V
    auto sums = evaluate_operating_point(context, x);
    const auto entries = context.system.pattern().entries();
    double largest_G = 0, largest_C = 0;
    for (std::size_t e = 0; e < entries; ++e)
        largest_G = std::max(largest_G, std::abs(sums.G[e])), largest_C = std::max(largest_C, std::abs(sums.C[e]));
    const double a = largest_C > 0 ? of_conductance * largest_G / largest_C : 0;  // 1/s
    for (std::size_t e = 0; e < entries; ++e) sums.G[e] += a * sums.C[e];
    LinearSolver<double> solver(context.system.pattern());
    if (!solver.factor(std::span<const double>(sums.G).first(entries))) return true;
    auto change = sums.f;  // the currents of the clamps; zero elsewhere, up to the tolerances
    const auto clamps = context.initial_clamps();
    for (std::size_t n = 0; n < change.size(); ++n)
        if (n >= clamps.conductance.size() || clamps.conductance[n] == 0) change[n] = 0;
    solver.solve(change);
    for (std::size_t n = 0; n < change.size(); ++n)
        if (context.system.is_voltage(static_cast<int>(n)) && std::abs(change[n]) > relative * std::abs(x[n]) + v_smallest) return false;
    return true;
}

Result<SpikeOutput> parse_spike(const System& system, const Directive& c) {
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    if (c.words.size() < 2)
        return error_at(c.location_of(1), ".spike: {} needs a level to cross: .spike v(NODE) LEVEL [rise|fall]", c.words[0]);
    const auto level = TRY(read_number(c, 1, "the level to cross"));
    SavedQuantity quantity{c.words[0], unknowns};
    SpikeOutput out{std::move(quantity), level, true, c.location};
    if (c.words.size() > 2) {
        if (c.words[2] != "rise" && c.words[2] != "fall")
            return error_at(c.location_of(2), ".spike: '{}' must be rise or fall", c.words[2]);
        out.is_rising = c.words[2] == "rise";
    }
    if (c.words.size() > 3)
        return error_at(c.location_of(3), ".spike: unexpected '{}'; expected .spike v(NODE) LEVEL [rise|fall]", c.words[3]);
    return out;
}

Result<OperatingRange> parse_range(const System& system, const Directive& c) {
    constexpr std::string_view syntax = ".assert v(NODE) LOW HIGH [\"MESSAGE\"]";
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    const double low = TRY(read_number(c, 1, "the lowest value")), high = TRY(read_number(c, 2, "the highest value"));
    if (!(low < high)) return error_at(c.location_of(1), ".assert: {:g} to {:g}: LOW must be below HIGH", low, high);
    std::string message;
    if (c.words.size() > 3) {
        const std::string_view word = c.words[3];
        if (word.size() < 3 || word.front() != '"' || word.back() != '"')
            return error_at(c.location_of(3), ".assert: '{}' must be a message in double quotes: {}", word, syntax);
        message = word.substr(1, word.size() - 2);
    }
    if (c.words.size() > 4) return error_at(c.location_of(4), ".assert: unexpected '{}'; expected {}", c.words[4], syntax);
    SavedQuantity quantity{c.words[0], unknowns};
    return OperatingRange{std::move(quantity), low, high, std::move(message), c.location};
}

/// The noise of a transient from .options noisefmax, noisefmin, noiseseed and noisescale.
Result<NoisePlan> read_noise_plan(const Circuit& c) {
    NoisePlan noise;
    noise.fmax = value_or(c.options, "noisefmax", 0);
    noise.fmin = value_or(c.options, "noisefmin", std::min(noise.fmin, noise.fmax / 10));
    noise.scale = value_or(c.options, "noisescale", noise.scale);
    const double given = value_or(c.options, "noiseseed", 1), seed = std::round(given);
    if (std::abs(given - seed) > 1e-6) return error_at({c.file}, ".options noiseseed={:g}: expected an integer from 0 to 2^53", given);
    noise.seed = static_cast<std::uint64_t>(seed);
    if (noise.is_on() && !(noise.fmin < noise.fmax))
        return error_at({c.file}, ".options noisefmin={:g}: must be below noisefmax, {:g} Hz", noise.fmin, noise.fmax);
    const auto is_noise = [](const Element& e) { return e.waveform.shape == Waveform::Shape::noise; };
    if (!c.options.contains("noisefmax") && std::ranges::none_of(c.elements, is_noise))
        for (const auto* name : {"noisefmin", "noisescale", "noiseseed"})
            if (c.options.contains(name))
                return error_at(
                    {c.file},
                    ".options {}: has no effect without noisefmax, the highest frequency of the noise; add, for example, noisefmax=10k",
                    name);
    return noise;
}

}  // namespace

Result<TransientPlan> read_transient_plan(const Circuit& c) {
    TransientPlan plan;
    plan.noise = TRY(read_noise_plan(c));
    if (const auto given = c.option_words.find("accuracy"); given != c.option_words.end()) {
        const auto* found = std::ranges::find(accuracies, given->second, &Accuracy::word);
        if (found == std::end(accuracies)) return invalid_option(c, "accuracy", given->second, "rough, normal, fine, finest");
        plan.reltol = found->reltol, plan.vntol = found->vntol;
    }
    plan.reltol = value_or(c.options, "reltol", plan.reltol);
    plan.vntol = value_or(c.options, "vntol", plan.vntol);
    plan.abstol = value_or(c.options, "abstol", plan.abstol);
    if (const auto given = c.option_words.find("method"); given != c.option_words.end()) {
        const std::string_view word = given->second;
        if (word != "gear" && word != "bdf" && word != "euler" && !word.starts_with("trap"))
            return invalid_option(c, "method", word, "gear, trap, euler");
        if (word.starts_with("trap") && plan.noise.is_on())
            return error_at({c.file}, ".options method={}: the trapezoidal rule amplifies noise; leave it out, or leave noisefmax out",
                            word);
        if (word.starts_with("trap")) plan.method = Integration::trapezoidal;
        if (word == "euler") plan.max_order = 1;
    }
    const double order = value_or(c.options, "maxord", plan.max_order);
    if (!(order >= 1 && order <= 5 && order == static_cast<int>(order)))
        return error_at({c.file}, ".options maxord={:g}: expected an integer from 1 to 5", order);
    plan.max_order = static_cast<int>(order);
    return plan;
}

Result<TransientTimes> read_transient_times(const Directive& directive) {
    auto c = directive;
    TransientTimes out;
    out.uic = starts_from_initial_conditions(c);
    c.words.erase(std::ranges::find(c.words, "uic"), c.words.end());
    if (const auto sweep = std::ranges::find(c.words, "sweep"); sweep != c.words.end())
        return error_at(c.location_of(static_cast<std::size_t>(sweep - c.words.begin())),
                        ".tran: sweep is not supported; write it as a line of its own: .step param {}",
                        fmt::join(sweep + 1, c.words.end(), " "));
    std::erase_if(c.words, is_modifier_of_tran);
    if (c.words.size() == 1) c.words.insert(c.words.begin(), "0"), c.columns.clear();  // .tran STOP, as in LTspice
    if (c.words.size() < 2 || c.words.size() > 4) return error_at(c.location, ".tran: expected .tran STEP STOP [START [LONGEST]] [uic]");
    out.step = TRY(read_number(c, 0, "the step"));
    out.stop = TRY(read_number(c, 1, "the stop time"));
    if (c.words.size() > 2) out.start = TRY(read_number(c, 2, "the start time"));
    if (c.words.size() > 3) out.max_step = TRY(read_number(c, 3, "the maximum step"));
    // A step of 0 is common in LTspice and Xyce, which use it only for what they print.
    if (out.step == 0 && out.stop > 0) out.step = (out.stop - out.start) / 1000;
    if (!(out.step > 0 && out.stop > 0 && out.start >= 0 && out.start < out.stop && out.max_step.value_or(1) > 0))
        return error_at(c.location,
                        ".tran: step {:g}, stop {:g}, start {:g}{} s: stop and maximum step must be above 0, the step and the start "
                        "at least 0 and below the stop",
                        out.step, out.stop, out.start, out.max_step ? fmt::format(", maximum step {:g}", *out.max_step) : "");
    return out;
}

Result<InitialCondition> find_initial_condition(AnalysisContext& context, bool uic, std::vector<double> guess) {
    context.newton.context.time = 0, context.newton.context.with_charges = false;
    const bool has_ic = !context.circuit->ic.empty();
    auto clamps = context.initial_clamps();
    clamps.voltage.resize(static_cast<std::size_t>(context.system.size()));
    context.system.reset_states();
    if (uic) {
        InitialCondition out{std::move(clamps.voltage), false};
        out.charge = charge_of_ics(context, out.x);
        out.states = context.system.states();
        return out;
    }
    auto rest = TRY(guess.empty() ? context.initial_operating_point()
                                  : find_operating_point(context.newton, std::move(guess), has_ic ? clamps : NodeClamps{}));
    InitialCondition out{std::move(rest.x)};
    out.states = std::move(rest.states);
    if (has_ic) out.is_consistent = keeps_released_voltages(context, out.x);
    if (has_ic || context.system.is_linear()) return out;
    const auto mode = find_unstable_mode(context.newton, out.x);
    if (!mode) return out;
    for (std::size_t n = 0; n < out.x.size(); ++n) out.x[n] += start_offset * mode->direction[n];
    out.warning = unstable_warning(context, *mode);
    return out;
}

Result<std::optional<SpikeOutput>> read_spike_output(const System& system) {
    std::optional<SpikeOutput> out;
    for (const auto& c : system.circuit().directives_named("spike")) {
        if (out) return error_at(c.location, ".spike: only one is allowed; the first is in line {}", out->location.line);
        out = TRY(parse_spike(system, c));
    }
    return out;
}

Result<std::vector<OperatingRange>> read_operating_ranges(const System& system) {
    std::vector<OperatingRange> out;
    for (const auto& c : system.circuit().directives_named("assert")) out.push_back(TRY(parse_range(system, c)));
    return out;
}

}  // namespace corpuscle::circuit
