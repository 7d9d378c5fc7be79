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

}  // namespace

Result<Beginning> beginning(TestBench& bench, bool uic, std::vector<double> from) {
    bench.newton.instant.time = 0, bench.newton.instant.charges = false;
    const bool held_there = !bench.circuit->ic.empty();
    auto springs = bench.held();
    springs.to.resize(static_cast<std::size_t>(bench.system.size()));
    if (uic) return Beginning{std::move(springs.to), false};
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
