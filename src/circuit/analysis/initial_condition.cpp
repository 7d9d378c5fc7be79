#include "circuit/analysis/initial_condition.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/solve/stability.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double start_offset = 10e-3;  // V, from an unstable operating point

Error unstable_warning(const AnalysisContext& context, const UnstableMode& mode) {
    const auto& d = mode.direction;
    const auto largest =
        std::max_element(d.begin(), d.begin() + context.system.nodes(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto node = static_cast<std::size_t>(largest - d.begin());
    return bad_input(
        fmt::format("the operating point is unstable: a disturbance grows{}. The transient starts {} from it, at {}. Set .ic to choose the "
                    "start",
                    mode.rate > 0 ? fmt::format(" by a factor of {:.3g} in {}", std::exp(1.0), format_quantity(1 / mode.rate, "s"))
                                  : std::string(" while it oscillates"),
                    format_quantity(start_offset, "V"), context.system.names()[node]),
        SourceLocation{context.circuit->file});
}

/// The charges of a device whose unknowns are v.
std::vector<double> charges_of(const Device& device, const std::vector<double>& v, const EvalContext& eval_context) {
    const auto n = v.size();
    std::vector<double> stamp(2 * n + 2 * n * n);
    const auto all = std::span(stamp);
    device.eval(v, eval_context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
    return {stamp.begin() + static_cast<std::ptrdiff_t>(n), stamp.begin() + static_cast<std::ptrdiff_t>(2 * n)};
}

/// By equation, the sum of the charges that capacitors have at their ic= voltages minus those at x. An ic= current of an inductor is an
/// unknown and is written to x.
std::vector<double> charge_of_ics(const AnalysisContext& context, std::vector<double>& x) {
    std::vector<double> out;
    EvalContext eval_context;
    eval_context.gmin = context.tolerances.gmin;
    for (std::size_t k = 0; k < context.circuit->elements.size(); ++k) {
        const auto& e = context.circuit->elements[k];
        const auto ic = e.values.find("ic");
        if (ic == e.values.end() || (e.letter != 'c' && e.letter != 'l')) continue;
        const auto& device = *context.system.devices()[k];
        if (e.letter == 'l') {
            x[static_cast<std::size_t>(device.unknowns[2])] = ic->second;
            continue;
        }
        out.resize(x.size());
        const auto v = context.system.terminal_values(device, x);
        auto charged = v;
        charged[0] = v[1] + ic->second;
        const auto at_x = charges_of(device, v, eval_context), requested = charges_of(device, charged, eval_context);
        for (std::size_t n = 0; n < v.size(); ++n)
            if (const int unknown = device.unknowns[n]; unknown >= 0) out[static_cast<std::size_t>(unknown)] += requested[n] - at_x[n];
    }
    return out;
}

}  // namespace

Result<InitialCondition> find_initial_condition(AnalysisContext& context, bool uic, std::vector<double> guess) {
    context.newton.context.time = 0, context.newton.context.with_charges = false;
    const bool has_ic = !context.circuit->ic.empty();
    auto clamps = context.initial_clamps();
    clamps.voltage.resize(static_cast<std::size_t>(context.system.size()));
    if (uic) {
        InitialCondition out{std::move(clamps.voltage), false};
        out.charge = charge_of_ics(context, out.x);
        return out;
    }
    auto rest = TRY(guess.empty() ? context.initial_operating_point()
                                  : find_operating_point(context.newton, std::move(guess), has_ic ? clamps : NodeClamps{}));
    InitialCondition out{std::move(rest.x)};
    if (has_ic || context.system.is_linear()) return out;
    const auto mode = find_unstable_mode(context.newton, out.x);
    if (!mode) return out;
    for (std::size_t n = 0; n < out.x.size(); ++n) out.x[n] += start_offset * mode->direction[n];
    out.warning = unstable_warning(context, *mode);
    return out;
}

}  // namespace corpuscle::circuit
