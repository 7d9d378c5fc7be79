// Charge conservation on floating nets, which only capacitances connect to the rest of the circuit, over ten thousand cycles.
//
// The charge of such a net is the sum over its nodes of the charges of capacitors, junctions and transistors. An integration rule based on
// charges conserves it up to Newton's residual, independent of the integration error. A rule based on capacitances does not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "circuit/netlist_runner.hpp"
#include "circuit/solve/transient.hpp"

namespace corpuscle::circuit {
namespace {

struct ChargeDrift {
    double drift = 0;  ///< C; largest difference of the net's charge from its initial value
    double swing = 0;  ///< C; largest range of the charge of any single node
    long steps = 0;
};

std::unique_ptr<AnalysisContext> context_of_text(const std::string& text) {
    const auto netlist = parse_netlist_text(text);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), nullptr;
    auto circuit = netlist->elaborate();
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), nullptr;
    auto context = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!context) return ADD_FAILURE() << context.error().text(), nullptr;
    return std::move(*context);
}

/// Simulates ten thousand cycles of `cycle` s; `net` names the nodes of the floating net. Nodes without .ic start at 0 V.
ChargeDrift measure_drift(const std::string& text, double cycle, const std::vector<std::string>& net) {
    const double stop = 1e4 * cycle;
    ChargeDrift out;
    const auto context = context_of_text(text);
    if (!context) return out;
    std::vector<double> start(static_cast<std::size_t>(context->system.size()));
    for (const auto& [node, v] : context->circuit->ic) start[static_cast<std::size_t>(node) - 1] = v;
    std::vector<std::size_t> nodes;
    for (const auto& name : net) nodes.push_back(static_cast<std::size_t>(context->system.unknown("v(" + name + ")")));

    SystemEvaluation evaluation;
    auto memory = context->system.initial_limiting_state();
    EvalContext eval_context;
    eval_context.gmin = context->tolerances.gmin;
    double initial = 0;  // C
    std::vector<double> low(nodes.size(), 1e300), high(nodes.size(), -1e300);
    const auto record_charges = [&](double t, std::span<const double> x) {
        eval_context.time = t;
        for (int iteration = 0; iteration < 100; ++iteration) {
            context->system.eval(x, eval_context, memory, evaluation);
            if (!evaluation.is_limited) break;
        }
        double all = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double q = evaluation.q[nodes[k]];
            all += q, low[k] = std::min(low[k], q), high[k] = std::max(high[k], q);
        }
        if (t == 0) initial = all;
        out.drift = std::max(out.drift, std::abs(all - initial));
    };
    context->system.start_transient(cycle / 100, stop);
    TransientPlan plan;
    plan.stop = stop, plan.max_step = cycle / 8;  // long steps could coincide with the zeros of a sine
    plan.reltol = 1e-3;                           // charge conservation does not depend on accuracy
    Transient transient(context->system, context->newton, plan);
    auto stepped = Result<bool>(true);
    EXPECT_TRUE(transient.begin(start));
    for (record_charges(0, start); stepped && transient.time() < stop; record_charges(transient.time(), transient.x()))
        stepped = transient.step(stop);
    EXPECT_TRUE(stepped) << (stepped ? "" : stepped.error().text());
    for (std::size_t k = 0; k < nodes.size(); ++k) out.swing = std::max(out.swing, high[k] - low[k]);
    out.steps = transient.stats().steps;
    std::printf("%ld steps: a drift of %.2g C, %.2g of the swing\n", out.steps, out.drift, out.drift / out.swing);
    return out;
}

/// Limit of the drift relative to the swing: 1e-8 per cycle, over ten thousand cycles.
constexpr double bound = 1e-4;

TEST(ChargeConservation, NonlinearCapacitorsInSeriesConserveTheChargeBetweenThem) {
    const auto result = measure_drift(
        "divider of charge\nv1 in 0 sin(0 1 1k)\nc1 in a q='1u*v(in,a)+0.5u*tanh(3*v(in,a))'\nr1 a b 100\n"
        "c2 b 0 q='0.5u*v(b)+2u*v(b)*v(b)*v(b)'\nr2 a 0 1e17\n.end\n",
        1e-3, {"a", "b"});
    ASSERT_GT(result.swing, 1e-7);
    EXPECT_LE(result.drift, bound * result.swing);
}

TEST(ChargeConservation, ARingOfDiodesConservesItsCharge) {
    const auto result = measure_drift(
        "three phases push charge around\nva ka 0 sin(0 1 1meg 0 0 0)\nvb kb 0 sin(0 1 1meg 0 0 120)\nvc kc 0 sin(0 1 1meg 0 0 240)\n"
        "ca ka a 10p\ncb kb b 10p\ncc kc c 10p\nd1 a b d\nd2 b c d\nd3 c a d\n.model d d(is=1e-12 n=1.05 cjo=2p vj=0.6 m=0.45 tt=5n)\n"
        "r1 a 0 1e18\n.ic v(kb)=0.8660254 v(kc)=-0.8660254\n.end\n",
        1e-6, {"a", "b", "c"});
    ASSERT_GT(result.swing, 1e-13);
    EXPECT_LE(result.drift, bound * result.swing);
}

TEST(ChargeConservation, TransistorsTransferChargeAndConserveIt) {
    // the card's transistors without junction currents
    const std::string card = "level=80 isq=112n vto=0.46 n=1.27 zetal=15n cox=8.42m cgso=0.37n cgdo=0.37n cj=1m cjsw=0.23n pb=0.75 mj=0.38";
    const auto result =
        measure_drift("a gate opens between two nets, and pushes both\n.options gmin=1e-20\n.model n nmos(" + card +
                          ")\nva k 0 pulse(0 1.5 1u 0.2u 0.2u 2.8u 8u)\nm1 a k b 0 n w=6u l=0.5u\nm2 b b a 0 n w=1.5u l=0.5u\n"
                          "ca a 0 0.1p\ncb b k 50f\nr1 a 0 1e20\n.ic v(a)=0.5 v(b)=0.3\n.end\n",
                      8e-6, {"a", "b"});
    ASSERT_GT(result.swing, 1e-15);
    EXPECT_LE(result.drift, bound * result.swing);
}

}  // namespace
}  // namespace corpuscle::circuit
