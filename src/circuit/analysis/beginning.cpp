#include "circuit/analysis/beginning.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/solve/stability.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double start_offset = 10e-3;  // V, from an unstable operating point

Error unstable_warning(const TestBench& context, const Growth& mode) {
    const auto& d = mode.direction;
    const auto largest =
        std::max_element(d.begin(), d.begin() + context.system.nodes(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto node = static_cast<std::size_t>(largest - d.begin());
    return bad_input(
        fmt::format("the operating point is unstable: a disturbance grows{}; the transient starts {} from it, at {}; set .ic to choose the "
                    "start",
                    mode.rate > 0 ? fmt::format(" by a factor of {:.3g} in {}", std::exp(1.0), format_quantity(1 / mode.rate, "s"))
                                  : std::string(" while it oscillates"),
                    format_quantity(start_offset, "V"), context.system.names()[node]),
        SourceLocation{context.circuit->file});
}

std::vector<double> charges_of(const Device& device, const std::vector<double>& v, const Instant& eval_context) {
    const auto n = v.size();
    std::vector<double> stamp(2 * n + 2 * n * n);
    const auto all = std::span(stamp);
    device.eval(v, eval_context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
    return {stamp.begin() + static_cast<std::ptrdiff_t>(n), stamp.begin() + static_cast<std::ptrdiff_t>(2 * n)};
}

/// The charge of each element at its ic= voltage minus its charge at x. The current of an inductor is an unknown and is written to x.
std::vector<double> charge_of_ics(const TestBench& context, std::vector<double>& x) {
    std::vector<double> out;
    Instant eval_context;
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
        const auto v = context.system.terminals(device, x);
        auto charged = v;
        charged[0] = v[1] + ic->second;
        const auto here = charges_of(device, v, eval_context), requested = charges_of(device, charged, eval_context);
        for (std::size_t n = 0; n < v.size(); ++n)
            if (const int unknown = device.unknowns[n]; unknown >= 0) out[static_cast<std::size_t>(unknown)] += requested[n] - here[n];
    }
    return out;
}

}  // namespace

Result<Beginning> beginning(TestBench& context, bool uic, std::vector<double> guess) {
    context.newton.instant.time = 0, context.newton.instant.charges = false;
    const bool has_ic = !context.circuit->ic.empty();
    auto clamps = context.held();
    clamps.to.resize(static_cast<std::size_t>(context.system.size()));
    if (uic) {
        Beginning out{std::move(clamps.to), false};
        out.charge = charge_of_ics(context, out.x);
        return out;
    }
    auto rest = guess.empty() ? context.rest_held() : operating_point(context.newton, std::move(guess), has_ic ? clamps : Springs{});
    if (!rest) return rest.error();
    Beginning out{std::move(rest->x)};
    if (has_ic || context.system.linear()) return out;
    const auto mode = growth_at(context.newton, out.x);
    if (!mode) return out;
    for (std::size_t n = 0; n < out.x.size(); ++n) out.x[n] += start_offset * mode->direction[n];
    out.remark = unstable_warning(context, *mode);
    return out;
}

}  // namespace corpuscle::circuit
