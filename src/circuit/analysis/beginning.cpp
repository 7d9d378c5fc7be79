#include "circuit/analysis/beginning.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/solve/stability.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double kick = 10e-3;  // V

Error kicked(const TestBench& bench, const Growth& growth) {
    const auto& d = growth.direction;
    const auto most =
        std::max_element(d.begin(), d.begin() + bench.system.nodes(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto node = static_cast<std::size_t>(most - d.begin());
    return bad_input(
        fmt::format("the circuit would not stay where it rests: a disturbance grows{}; it begins {} beside, at {}; .ic says where else",
                    growth.rate > 0 ? fmt::format(" {:.3g}-fold within {}", std::exp(1.0), format_quantity(1 / growth.rate, "s"))
                                    : std::string(" as it swings"),
                    format_quantity(kick, "V"), bench.system.names()[node]),
        Place{bench.circuit->file});
}

std::vector<double> charges_of(const Device& device, const std::vector<double>& v, const Instant& at) {
    const auto n = v.size();
    std::vector<double> room(2 * n + 2 * n * n);
    const auto all = std::span(room);
    device.eval(v, at, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
    return {room.begin() + static_cast<std::ptrdiff_t>(n), room.begin() + static_cast<std::ptrdiff_t>(2 * n)};
}

/// Each element's charge as its ic= asks for, less its charge at x. An inductor's current is an unknown: x takes it.
std::vector<double> charge_of_ics(const TestBench& bench, std::vector<double>& x) {
    std::vector<double> out;
    Instant at;
    at.gmin = bench.tolerances.gmin;
    for (std::size_t k = 0; k < bench.circuit->elements.size(); ++k) {
        const auto& e = bench.circuit->elements[k];
        const auto ic = e.values.find("ic");
        if (ic == e.values.end() || (e.letter != 'c' && e.letter != 'l')) continue;
        const auto& device = *bench.system.devices()[k];
        if (e.letter == 'l') {
            x[static_cast<std::size_t>(device.unknowns[2])] = ic->second;
            continue;
        }
        out.resize(x.size());
        const auto v = bench.system.terminals(device, x);
        auto charged = v;
        charged[0] = v[1] + ic->second;
        const auto here = charges_of(device, v, at), wanted = charges_of(device, charged, at);
        for (std::size_t n = 0; n < v.size(); ++n)
            if (const int unknown = device.unknowns[n]; unknown >= 0) out[static_cast<std::size_t>(unknown)] += wanted[n] - here[n];
    }
    return out;
}

}  // namespace

Result<Beginning> beginning(TestBench& bench, bool uic, std::vector<double> from) {
    bench.newton.instant.time = 0, bench.newton.instant.charges = false;
    const bool held_there = !bench.circuit->ic.empty();
    auto springs = bench.held();
    springs.to.resize(static_cast<std::size_t>(bench.system.size()));
    if (uic) {
        Beginning out{std::move(springs.to), false};
        out.charge = charge_of_ics(bench, out.x);
        return out;
    }
    auto rest = from.empty() ? bench.rest_held() : operating_point(bench.newton, std::move(from), held_there ? springs : Springs{});
    if (!rest) return rest.error();
    Beginning out{std::move(rest->x)};
    if (held_there || bench.system.linear()) return out;
    const auto growth = growth_at(bench.newton, out.x);
    if (!growth) return out;
    for (std::size_t n = 0; n < out.x.size(); ++n) out.x[n] += kick * growth->direction[n];
    out.remark = kicked(bench, *growth);
    return out;
}

}  // namespace corpuscle::circuit
