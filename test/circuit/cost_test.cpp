// Area and power of circuits, compared with manual sums, closed forms and the thesis's tables.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "circuit/cost/cost.hpp"
#include "circuit/device/physical_constants.hpp"
#include "netlist_runner.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit {
namespace {

using test::TemporaryFolder;

std::unique_ptr<AnalysisContext> cost_context(std::shared_ptr<const Circuit> circuit) {
    if (!circuit) return nullptr;
    auto context = AnalysisContext::make(std::move(circuit));
    if (!context) return ADD_FAILURE() << context.error().text(), nullptr;
    return std::move(*context);
}

std::shared_ptr<const Circuit> elaborate_file(const std::string& name, const Values& parameters = {}) {
    const auto netlist = Netlist::read(test::source_root() + "/circuits/" + name);
    if (!netlist) return ADD_FAILURE() << netlist.error().text(), nullptr;
    auto circuit = netlist->elaborate(parameters);
    if (!circuit) return ADD_FAILURE() << circuit.error().text(), nullptr;
    return std::make_shared<const Circuit>(std::move(*circuit));
}

Cost cost(std::shared_ptr<const Circuit> circuit) {
    auto context = cost_context(std::move(circuit));
    auto result = cost_of(*context);
    if (!result) return ADD_FAILURE() << result.error().text(), Cost();
    return std::move(*result);
}

/// Cost of a circuit including the power during the transients of its netlist.
Cost cost_in_time(std::shared_ptr<const Circuit> circuit) {
    auto context = cost_context(std::move(circuit));
    CostMeter meter(*context);
    RunOptions options;
    if (const auto attached = meter.attach(options); !attached) ADD_FAILURE() << attached.error().text();
    if (const auto ran = run_directives(*context, options); !ran) ADD_FAILURE() << ran.error().text();
    auto result = meter.cost();
    if (!result) return ADD_FAILURE() << result.error().text(), Cost();
    return std::move(*result);
}

const BlockCost& block(const Cost& c, std::string_view name) {
    for (const auto& b : c.blocks)
        if (b.name == name) return b;
    ADD_FAILURE() << "no block " << name;
    return c.blocks.at(0);
}

double dissipated(const Cost& c, std::string_view when, std::string_view name) {
    const auto* p = c.powers(when);
    return p ? p->blocks[static_cast<std::size_t>(&block(c, name) - c.blocks.data())] : std::nan("");
}

double sum(const std::vector<double>& of) { return std::accumulate(of.begin(), of.end(), 0.0); }

constexpr double um = 1e-6, um2 = 1e-12;

TEST(Cost, ArrayAreasEqualTheThesissTables) {
    struct Array {
        const char* name;
        double units, W, L, A_T, tolerance;  // W, L in um, A_T in um^2; relative tolerance
    };
    for (const auto& a : {Array{"A", 1, 0.42, 0.18, 1.0120, 0.037},
                          {"B1", 2, 0.42, 0.90, 3.0132, 1e-9},
                          {"B2", 4, 0.42, 0.18, 3.0132, 1e-9},
                          {"C1", 1, 1.12, 0.90, 3.0132, 1e-9},
                          {"C2", 4, 0.42, 0.18, 3.0132, 1e-9},
                          {"D1", 2, 1.12, 0.18, 3.0132, 1e-9},
                          {"D2", 4, 0.42, 0.18, 3.0132, 1e-9},
                          {"E", 1, 0.42, 5.22, 5.6856, 1e-9},
                          {"G1", 8, 0.42, 0.18, 5.6856, 0.061}})  // laid out as one row, not as the smallest rectangle
        EXPECT_NEAR(array_area(a.W * um, a.L * um, a.units) / um2, a.A_T, a.tolerance * a.A_T) << a.name;
    EXPECT_NEAR(rectangle_area(0.42 * um, 0.18 * um, 1, 8) / um2, 5.6856, 1e-9) << "G1 to G3";
}

TEST(Cost, AnArrayIsSmallerThanItsSeparateElementsAndLargerThanItsGates) {
    for (const double count : {2.0, 3.0, 7.0, 16.0, 1000.0, 1e5}) {
        const double together = array_area(6 * um, 0.5 * um, count);
        EXPECT_LT(together, count * rectangle_area(6 * um, 0.5 * um, 1, 1)) << count;
        EXPECT_GT(together, count * 3 * um2) << count;
    }
    EXPECT_NEAR(array_area(6 * um, 0.5 * um, 1e5), 1e5 * 6.28 * 1.04 * um2, 1e-3 * 1e5 * 6.53 * um2);  // the borders are negligible
}

TEST(Cost, ABlocksAreaEqualsTheManualSum) {
    const auto c = cost(elaborate_file("sa1.cir"));
    const auto& cco = block(c, "cco");  // 4 mirror arrays of 8 P elements, a trigger of 32 P and 32 N, switches
    EXPECT_EQ(cco.transistors, 14U);
    EXPECT_EQ(cco.unit_transistors, 4U * 8 + 64 + 8);
    EXPECT_NEAR(cco.area.gates / um2, 32 * 3 + 32 * (3 + 0.75) + 4 * 3 + 4 * 0.75, 1e-9);
    EXPECT_NEAR(cco.area.islands / um2, (32 + 32 + 4) * 6.5 * 1.46 + (32 + 4) * 2 * 1.46, 1e-9);
    EXPECT_NEAR(cco.area.capacitors / um2, 2700, 1e-6) << "three of 30 x 30 um";
    EXPECT_NEAR(block(c, "hpb").area.capacitors / um2, 400, 1e-6) << "20 x 20 um are 0.8 pF";
    EXPECT_EQ(block(c, "fsr").area.total(), 0);
    EXPECT_EQ(block(c, "ideal currents").area.total(), 0);
    const auto two =
        cost(make_circuit("t\n.lib 'tsmc180.lib' tt\nv1 v 0 0.7\nx1 v o v 0 pair\n.subckt pair a b c d\n"
                          "mp b a c c pch w=6u l=0.5u m=2\nmn b a d d nch w=1.5u l=0.5u m=2\n.ends\n.op\n"));
    EXPECT_NEAR(block(two, "1").area.arrays / um2, 6.5 * 2.5 + 2 * 2.5, 1e-9) << "each in one row: 2 x 0.5 + 0.54 + 0.96 um long";
}

TEST(Cost, SourcesDeliverThePowerThatBlocksDissipateInEveryCircuit) {
    int seen = 0, with_supply = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_root() + "/circuits")) {
        if (entry.path().extension() != ".cir") continue;
        const auto name = entry.path().filename().string();
        auto context = cost_context(elaborate_file(name));
        const auto result = cost_of(*context);
        ASSERT_TRUE(result) << name << ": " << result.error().text();
        const auto& p = result->power[0].second;
        EXPECT_NEAR(p.supplies, sum(p.blocks), 1e-6 * p.supplies + 1e-15) << name;
        with_supply += p.supplies > 0;
        const auto x = context->operating_point()->x;
        for (std::size_t k = 0; k < result->sources.size(); ++k) {  // also compare each source with its solved branch current
            if (result->sources[k][0] != 'v') continue;
            const auto v = context->system.terminal_values(*context->system.device(result->sources[k]), x);
            EXPECT_NEAR(p.sources[k], -(v[0] - v[1]) * v[2], 1e-12 * std::abs(p.sources[k])) << name << ", " << result->sources[k];
        }
        ++seen;
    }
    EXPECT_GE(seen, 40);
    EXPECT_GE(with_supply, 30) << "ideal circuits need no supply";
}

TEST(Cost, DeviceCurrentsFollowOhmsLaw) {
    const auto context =
        cost_context(make_circuit("t\nvdd vdd 0 2\nxa vdd a one\nxb a 0 one\n.subckt one p q\nr1 p q 1k\n.ends\nr2 0 vdd 2k\n.op\n"));
    const auto x = context->operating_point()->x;
    const PowerMeter meter(context->system, x, 1e-12);
    std::map<std::string, double> found;
    for (const auto& device : meter.device_currents(x, 0)) found[meter.blocks().names[device.block] + ":" + device.name] = device.current;
    ASSERT_EQ(found.size(), 3U) << "not the source";
    EXPECT_NEAR(found["a:xa.r1"], 1e-3, 1e-11);
    EXPECT_NEAR(found["b:xb.r1"], 1e-3, 1e-11);
    EXPECT_NEAR(found["top level:r2"], -1e-3, 1e-11) << "into the first terminal";
}

TEST(Cost, PowerFollowsOhmsLaw) {
    const auto c =
        cost(make_circuit("t\nvdd vdd 0 2\nvf force 0 0.5 force 1\n"
                          "xa vdd a one\nxb a 0 one\n.subckt one p q\nr1 p q 1k\n.ends\n"                            // 1 mA: 1 mW each
                          "xs force vdd x sens\n.subckt sens force p q\nb1 p q i={v(force)*1m}\n.ends\nrx x 0 1k\n"  // 0.5 mA
                          "idrain vdd d 1m\nrd d 0 1k\n"                                                             // drops 1 V, 1 mA
                          "iup 0 u 3m\nru u 0 1k\n.op\n"));                                                          // delivers 3 mA at 3 V
    const auto& p = *c.powers("op");
    EXPECT_DOUBLE_EQ(c.supply, 2);
    EXPECT_EQ(c.sources, (std::vector<std::string>{"vdd", "vf", "iup"}));
    EXPECT_NEAR(p.sources[0], 2 * (1e-3 + 0.5e-3 + 1e-3), 1e-12);
    EXPECT_NEAR(p.sources[2], 9e-3, 1e-12);
    EXPECT_NEAR(p.sensor, 2 * 0.5e-3, 1e-12) << "power that the supply delivers to the sensor and its other terminals";
    EXPECT_NEAR(p.without_sensor, 13e-3, 1e-12);
    EXPECT_NEAR(dissipated(c, "op", "a"), 1e-3, 1e-12);
    EXPECT_NEAR(dissipated(c, "op", "b"), 1e-3, 1e-12);
    EXPECT_NEAR(dissipated(c, "op", "s"), 1.5 * 0.5e-3, 1e-12);
    EXPECT_NEAR(dissipated(c, "op", "ideal currents"), 1e-3, 1e-12);
    EXPECT_NEAR(dissipated(c, "op", "top level"), 0.25e-3 + 1e-3 + 9e-3, 1e-12);
    EXPECT_EQ(c.unknown_areas, 5U);
}

TEST(Cost, ChargingAndDischargingACapacitorTakesItsChargeTimesTheSupply) {
    const auto c = cost_in_time(make_circuit("t\nv1 in 0 pulse(0 2 1m 1u 1u 20m 100m)\nr1 in out 1k\nc1 out 0 1u\n.tran 10u 50m\n"));
    const double energy = 1e-6 * 2 * 2;  // C V^2, J: half is dissipated while charging, half while discharging
    EXPECT_NEAR(c.powers("mean")->supplies, energy / 50e-3, 2e-3 * energy / 50e-3);
    EXPECT_NEAR(dissipated(c, "mean", "top level"), energy / 50e-3, 2e-3 * energy / 50e-3);
    EXPECT_NEAR(c.powers("peak")->supplies, 2 * 2 / 1e3, 0.01 * 4e-3);
}

TEST(Cost, OverAPressTheChipDissipatesTheDeliveredPower) {
    const auto c = cost_in_time(elaborate_file("sa1.cir"));
    ASSERT_NE(c.powers("plateau"), nullptr);
    const auto &mean = *c.powers("mean"), &rest = *c.powers("rest"), &hold = *c.powers("plateau");
    EXPECT_NEAR(mean.supplies, sum(mean.blocks), 1e-3 * mean.supplies);
    for (const auto& [powers, force] : {std::pair{&rest, 0.2}, {&hold, 4.0}}) {  // eq. 13 at 0.1 V, held to 0.3 %
        const double current = 0.1 * (std::pow(force / 9.80665e-3, 0.72) / 170e3 + 1 / 10e6);
        EXPECT_NEAR(powers->sensor, 0.7 * current, 4e-3 * powers->sensor) << force;
    }
    double energy_of_phases = 0;  // J, over 1 s
    for (const auto& [name, seconds] :
         {std::pair{"rest", 0.25}, {"protraction", 0.125}, {"plateau", 0.25}, {"retraction", 0.125}, {"post", 0.25}})
        energy_of_phases += c.powers(name)->without_sensor * seconds;
    EXPECT_NEAR(energy_of_phases, mean.without_sensor, 1e-9 * mean.without_sensor);
    for (std::size_t b = 0; b < c.blocks.size(); ++b) EXPECT_GE(c.powers("peak")->blocks[b], mean.blocks[b]);
    EXPECT_TRUE(c.is_afferent);
    EXPECT_TRUE(c.has_sensor);
}

TEST(Cost, ATransistorsLeakageFollowsFromItsThreshold) {
    const double phi_t = thermal_voltage(300.15), closed = 2 * std::exp(1.0) * 100e-9 * 6 * std::exp(-0.45 / (1.3 * phi_t));
    for (const bool pmos : {false, true}) {
        const auto circuit = make_circuit(std::string("t\nvdd vdd 0 0.7\nm1 ") + (pmos ? "0 vdd vdd vdd x w=1.5u" : "vdd 0 0 0 x w=1.5u") +
                                          " l=0.5u m=2\n.model x " + (pmos ? "pmos" : "nmos") +
                                          " (level=80 isq=100n vto=0.45 n=1.3 ve=1e30)\nib vdd 0 5p\n.op\n");
        const auto c = cost(circuit);
        EXPECT_NEAR(block(c, "top level").worst_leak.current, closed, 1e-4 * closed);
        ASSERT_EQ(c.leaks.size(), 1U);
        EXPECT_EQ(c.leaks[0].name, "m1");
        EXPECT_EQ(c.leaks[0].capacitor_node, "");
        EXPECT_DOUBLE_EQ(c.smallest_bias, 5e-12);
    }
}

TEST(Cost, SwitchesLeakOntoTheMembraneUnlessTheyHaveTheHigherThreshold) {
    const auto onto_u = [](const Cost& c) {
        std::map<std::string, double> out;
        for (std::size_t k = 0; k < c.leaks.size(); ++k)
            if (c.leaks[k].capacitor_node == "u") out[c.leaks[k].name] = c.leaks[k].current;
        return out;
    };
    const auto leaks = onto_u(cost(elaborate_file("sa1.cir", {{"hv_membrane", 0}})));
    const double phi_t = thermal_voltage(300.15);
    const double n_switch = 2 * std::exp(1.0) * 112e-9 * 6 * std::exp(-0.461 / (1.27 * phi_t));  // M6: 2 elements of 1.5/0.5 um
    for (const char* name : {"xrectb.mn6a", "xrectc.mn6a", "xcco.mn6b"}) {
        ASSERT_TRUE(leaks.contains(name)) << name;
        EXPECT_NEAR(leaks.at(name), n_switch * (1 + 0.7 / 4) / 1.03, 0.04 * n_switch)
            << "with the effects of the Early voltage of 4 V and of zeta";
    }
    EXPECT_TRUE(leaks.contains("xcco.mp5b"));
    EXPECT_EQ(leaks.size(), 4U);
    EXPECT_TRUE(onto_u(cost(elaborate_file("sa1.cir"))).empty());
}

TEST(Cost, JunctionLeakageIsCounted) {
    const auto c = cost(make_circuit(
        "t\nvdd vdd 0 0.7\nm1 vdd 0 0 0 x w=1u l=1u\n.model x nmos (level=80 isq=1e-15 vto=2 js=5u jssw=1p ldif=0.5u)\n.op\n"));
    EXPECT_NEAR(c.blocks[0].worst_leak.current, 5e-6 * 0.5e-12 + 1e-12 * 3e-6, 1e-6 * 2.5e-18 + 1e-22);
}

TEST(Cost, TransistorsOfLevelOneAreCounted) {
    const TemporaryFolder folder;
    folder.write("x.cir",
                 "t\nvdd vdd 0 1\nm1 a vdd 0 0 n w=1u l=1u m=3\nm2 a a 0 0 n w=1u l=1u\nr1 vdd a 1k\n.model n nmos (level=1)\n.op\n");
    const auto ran = test::run_program(folder, "run x.cir --budget --json");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto top = nlohmann::json::parse(ran.out)["budget"]["blocks"][0];
    EXPECT_EQ(top["arrays"], 2) << top;
    EXPECT_EQ(top["unit_transistors"], 4) << top;
}

TEST(Cost, TheJsonHasTheBudgetAndTheTableItsHeadings) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nvdd vdd 0 1\nr1 vdd a 1k\nc1 a 0 2p\ni1 a 0 1u\n.op\n.tran 1n 10n\n");
    const auto ran = test::run_program(folder, "run x.cir --budget --json");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto budget = nlohmann::json::parse(ran.out)["budget"];
    for (const char* when : {"op", "mean", "peak"}) {
        EXPECT_NEAR(budget["power"][when]["delivered_W"].get<double>(), 1e-6, 1e-12) << when;
        EXPECT_NEAR(budget["power"][when]["blocks_W"]["top level"].get<double>(), 1e-9, 1e-13) << when;
        EXPECT_NEAR(budget["power"][when]["sources_W"]["vdd"].get<double>(), 1e-6, 1e-12) << when;
        EXPECT_EQ(budget["power"][when]["sensor_W"], 0) << when;
    }
    EXPECT_NEAR(budget["area"]["total_m2"].get<double>(), 1000e-12, 1e-18);
    EXPECT_EQ(budget["blocks"].size(), 2U);
    EXPECT_EQ(budget["unsized_elements"], 1);
    EXPECT_FALSE(budget.contains("afferents"));
    EXPECT_FALSE(nlohmann::json::parse(test::run_program(folder, "run x.cir --json").out).contains("budget"));
    const auto table = test::run_program(folder, "run x.cir --budget").out;
    for (const char* word : {"power, nW", "delivered", "dissipated in ideal currents", "area, um2", "1 device of unknown area (resistors"})
        EXPECT_NE(table.find(word), std::string::npos) << word << "\n" << table;
}

TEST(Cost, RespondReportsThePowerAtRestAndTheMeanOverTheResponse) {
    const TemporaryFolder folder;
    const std::string chip = "'" + test::source_root() + "/circuits/sa1.cir'", words = "respond press --json --afferent sa1," + chip;
    const auto ran = test::run_program(folder, words + " -j1");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto costs = nlohmann::json::parse(ran.out)["costs"];
    ASSERT_EQ(costs.size(), 1U) << "equations have no known cost";
    EXPECT_TRUE(costs[0]["afferent"].get<std::string>().ends_with("sa1.cir"));
    EXPECT_EQ(costs[0]["rest_force_N"], 0.2);
    const auto c = cost_in_time(elaborate_file("sa1.cir"));
    for (const auto& [word, of] : {std::pair{"delivered_W", &PowerBreakdown::supplies},
                                   {"sensor_W", &PowerBreakdown::sensor},
                                   {"without_sensor_W", &PowerBreakdown::without_sensor}}) {
        EXPECT_NEAR(costs[0]["power"]["op"][word].get<double>(), c.powers("rest")->*of, 1e-4 * c.powers("rest")->*of) << word;
        // after the press of 1 s the run continues at rest for a step of at most 20 ms, which moves the mean towards the rest value
        const double press = c.powers("mean")->*of, rest = c.powers("rest")->*of, farthest = (press + 20e-3 * rest) / (1 + 20e-3);
        const double mean = costs[0]["power"]["mean"][word].get<double>();
        EXPECT_GT(mean, farthest - 1e-3 * press) << word;
        EXPECT_LT(mean, press + 1e-3 * press) << word;
    }
    EXPECT_NEAR(costs[0]["afferents"]["per_mm2"].get<double>(), c.per_mm2(), 1e-9 * c.per_mm2());
    EXPECT_EQ(ran.out, test::run_program(folder, words + " -j2").out);
    EXPECT_FALSE(nlohmann::json::parse(test::run_program(folder, "respond press --json").out).contains("costs"));
}

TEST(Cost, EachVariantOfAStepHasItsLine) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\n.param r=1k\nvdd vdd 0 1\nr1 vdd 0 {r}\n.op\n.step param r list 1k 2k\n");
    const auto ran = test::run_program(folder, "run x.cir --budget");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("power 1 mW"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("power 500 uW"), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace corpuscle::circuit
