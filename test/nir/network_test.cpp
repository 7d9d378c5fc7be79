#include "nir/network.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "nir/graph_builder.hpp"
#include "nir/graph_file.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using nir::Network, nir::Update;
using test::NirFile, test::value_or_throw;

constexpr Update all_updates[] = {Update::exact, Update::euler, Update::backward_euler};

Network network_of(const NirFile& file, double dt, Update update = Update::exact) {
    return value_or_throw(
        Network::create(std::make_shared<const nir::Graph>(value_or_throw(nir::graph_of(file.arrays(), "x.nir"))), dt, update));
}

/// The output under these inputs, one for each step, of a graph with one input.
std::vector<double> run(const Network& network, const std::vector<double>& input) {
    auto state = network.start(), workspace = network.workspace();
    std::vector<double> all, out(network.output_count());
    for (const double x : input) {
        network.step(std::span(&x, 1), out, state, workspace);
        all.insert(all.end(), out.begin(), out.end());
    }
    return all;
}

/// A graph of one node of one element between the ports.
NirFile single(const std::string& type, std::initializer_list<std::pair<const char*, double>> parameters) {
    NirFile file;
    file.port("in", "Input", 1), file.port("out", "Output", 1);
    file.node("x", type);
    for (const auto& [name, value] : parameters) file.set("x", name, {value});
    file.chain({"in", "x", "out"});
    return file;
}

TEST(NirNetwork, ALeakyIntegratorFollowsItsClosedForm) {
    const auto file = single("LI", {{"tau", 0.02}, {"r", 3}, {"v_leak", 0.5}});
    const auto v = run(network_of(file, 1e-3), std::vector<double>(100, 2.0));
    for (std::size_t k = 0; k < v.size(); ++k)
        EXPECT_NEAR(v[k], 0.5 + 6 * (1 - std::exp(-1e-3 * static_cast<double>(k + 1) / 0.02)), 1e-12);
}

TEST(NirNetwork, TheErrorOfBothEulerMethodsHalvesWithTheStep) {
    const auto file = single("LI", {{"tau", 0.02}, {"r", 1}, {"v_leak", 0}});
    for (const auto update : {Update::euler, Update::backward_euler}) {
        const auto error = [&](double dt) {
            const auto steps = static_cast<std::size_t>(std::lround(0.02 / dt));
            return run(network_of(file, dt, update), std::vector<double>(steps, 1.0)).back() - (1 - std::exp(-1.0));
        };
        EXPECT_NEAR(error(1e-4) / error(5e-5), 2, 0.01);
    }
}

TEST(NirNetwork, AMembraneBehindASynapseFollowsItsClosedForm) {
    for (const double tau_syn : {0.005, 0.01, 0.01 * (1 + 1e-10), 0.03}) {  // shorter, equal, almost equal, longer
        const auto file = single("CubaLI", {{"tau_syn", tau_syn}, {"tau_mem", 0.01}, {"r", 2}, {"v_leak", 0}, {"w_in", 3}});
        const auto v = run(network_of(file, 1e-3), std::vector<double>(50, 1.0));
        for (std::size_t k = 0; k < v.size(); ++k) {
            const double t = 1e-3 * static_cast<double>(k + 1), tm = 0.01;
            const double decayed = std::abs(tau_syn - tm) < 1e-9 ? t / tm * std::exp(-t / tm)
                                                                 : tau_syn / (tau_syn - tm) * (std::exp(-t / tau_syn) - std::exp(-t / tm));
            EXPECT_NEAR(v[k], 6 * (1 - std::exp(-t / tm) - decayed), 1e-8) << "tau_syn = " << tau_syn << ", step " << k;
        }
    }
}

TEST(NirNetwork, AMembraneThatIsFarQuickerThanTheStepFollowsItsSynapse) {
    const auto file = single("CubaLI", {{"tau_syn", 0.1}, {"tau_mem", 1e-3}, {"r", 1}, {"v_leak", 0}, {"w_in", 1}});
    for (const double dt : {1.0, 0.5, 2e-3}) {
        const double v = run(network_of(file, dt), {1}).back(), es = std::exp(-dt / 0.1), em = std::exp(-dt / 1e-3);
        EXPECT_NEAR(v, 1 - em - 0.1 / (0.1 - 1e-3) * (es - em), 1e-12) << dt;
    }
}

TEST(NirNetwork, EulerBehindASynapseUsesTheCurrentAtTheEndOfTheStep) {
    const auto file = single("CubaLI", {{"tau_syn", 0.005}, {"tau_mem", 0.01}, {"r", 2}, {"v_leak", 1}, {"w_in", 3}});
    const std::vector<double> inputs = {1, 0, 1, 1, 0, 0};
    const auto out = run(network_of(file, 1e-3, Update::euler), inputs);
    double current = 0, v = 1;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        current += 0.2 * (3 * inputs[k] - current);
        v += 0.1 * (1 + 2 * current - v);
        EXPECT_NEAR(out[k], v, 1e-14);
    }
}

TEST(NirNetwork, ANeuronFiresAboveItsThresholdAndIsReset) {
    const auto file = single("IF", {{"r", 1}, {"v_threshold", 3}, {"v_reset", 1}});
    for (const auto update : all_updates) {
        const auto out = run(network_of(file, 1, update), std::vector<double>(10, 1.0));
        EXPECT_EQ(out, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 0, 0, 1})) << "3 is not above 3; after a spike it begins at 1";
    }
    const auto threshold = single("Threshold", {{"threshold", 2}});
    EXPECT_EQ(run(network_of(threshold, 1), {1, 2, 2.5, -3}), (std::vector<double>{0, 0, 1, 0}));
}

TEST(NirNetwork, AMembraneBeginsAtItsLeakPotential) {
    const auto file = single("LI", {{"tau", 0.02}, {"r", 1}, {"v_leak", -0.07}});
    for (const auto update : all_updates) EXPECT_NEAR(run(network_of(file, 1e-3, update), {0, 0})[1], -0.07, 1e-16);
}

TEST(NirNetwork, InputsAddAndMatricesMultiply) {
    NirFile file;
    file.port("in", "Input", 1), file.port("out", "Output", 2);
    file.matrix("a", 2, {1, 10}), file.node("b", "Affine");
    file.numbers("/node/nodes/b/weight", {2, 2}, {1, 2, 3, 4}), file.set("b", "bias", {0.5, 0});
    file.node("s", "Scale"), file.set("s", "scale", {1, -1});
    file.chain({"in", "a", "b", "out"}), file.chain({"a", "s", "out"});
    EXPECT_EQ(run(network_of(file, 1), {2}), (std::vector<double>{42.5 + 2, 86 - 20}));
}

TEST(NirNetwork, InALoopTheOutputOfANeuronArrivesOneStepLater) {
    auto file = single("IF", {{"r", 1}, {"v_threshold", 0.5}});
    file.matrix("w", 1, {-10}), file.chain({"x", "w", "x"});
    EXPECT_EQ(run(network_of(file, 1), std::vector<double>(14, 1.0)), (std::vector<double>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}))
        << "the spike of step 0 takes 10 away in step 1: v = -9, then 1 more in each step, 1 in step 11";
}

TEST(NirNetwork, ALoopWithoutAMembraneIsRefused) {
    NirFile file;
    file.port("in", "Input", 1), file.port("out", "Output", 1);
    file.matrix("a", 1, {1}), file.matrix("b", 1, {1}), file.chain({"in", "a", "b", "a"}), file.edge("b", "out");
    const auto network = Network::create(std::make_shared<const nir::Graph>(value_or_throw(nir::graph_of(file.arrays(), "x.nir"))), 1, Update::exact);
    ASSERT_FALSE(network);
    EXPECT_EQ(network.error().message.find("node 'out'"), std::string::npos) << "it lies behind the loop";
    EXPECT_NE(network.error().message.find("lies in a loop that has no node with a membrane"), std::string::npos);
}

TEST(NirNetwork, ForwardEulerRefusesAStepWithWhichItDiverges) {
    const auto graph = std::make_shared<const nir::Graph>(
        value_or_throw(nir::graph_of(single("LI", {{"tau", 0.02}, {"r", 1}, {"v_leak", 0}}).arrays(), "x.nir")));
    EXPECT_TRUE(Network::create(graph, 0.039, Update::euler));
    EXPECT_TRUE(Network::create(graph, 1, Update::exact));
    const auto network = Network::create(graph, 0.04, Update::euler);
    ASSERT_FALSE(network);
    EXPECT_NE(network.error().message.find("tau = 0.02 s is too short for forward Euler with steps of 0.04 s"), std::string::npos);
}

TEST(NirNetwork, ALongChainIsSimulatedInOneStep) {
    NirFile file;
    file.port("in", "Input", 1), file.port("out", "Output", 1);
    std::string last = "in";
    for (int k = 0; k < 20'000; ++k) {
        const auto name = "w" + std::to_string(k);
        file.matrix(name, 1, {k % 2 == 0 ? 2.0 : 0.5}), file.edge(last, name);
        last = name;
    }
    file.edge(last, "out");
    EXPECT_EQ(run(network_of(file, 1), {3}), std::vector<double>{3});
}

}  // namespace
}  // namespace corpuscle
