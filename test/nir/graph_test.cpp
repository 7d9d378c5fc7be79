#include "nir/graph_file.hpp"

#include <gtest/gtest.h>

#include "nir/graph_builder.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::NirFile;

std::string refused(const std::vector<Hdf5Array>& arrays) {
    const auto graph = nir::graph_of(arrays, "x.nir");
    return graph ? "read" : graph.error().text();
}

/// An input, a LIF and an output of `width` elements.
NirFile lif(double width = 1) {
    NirFile file;
    file.port("in", "Input", width), file.port("out", "Output", width);
    file.node("lif", "LIF");
    for (const auto& [name, value] : {std::pair("tau", 0.01), {"r", 1.0}, {"v_leak", 0.0}, {"v_threshold", 1.0}})
        file.set("lif", name, std::vector<double>(static_cast<std::size_t>(width), value));
    file.chain({"in", "lif", "out"});
    return file;
}

TEST(NirGraph, AFileBecomesNodesEdgesAndPorts) {
    const auto graph = test::value_or_throw(nir::graph_of(lif(3).arrays(), "x.nir"));
    EXPECT_EQ(graph.version, "1.0");
    ASSERT_EQ(graph.nodes.size(), 3U);
    EXPECT_EQ(graph.input_count(), 3U);
    EXPECT_EQ(graph.output_count(), 3U);
    const auto& node = graph.nodes[graph.edges[0].to];
    EXPECT_EQ(node.name, "lif");
    EXPECT_EQ(node.value("v_reset"), std::vector<double>(3)) << "0 if the file has none";
    EXPECT_EQ(graph.shortest_time_constant(), 0.01);
}

TEST(NirGraph, ASingleNumberAppliesToAllElements) {
    auto file = lif(2);
    file.numbers("/node/nodes/lif/v_reset", {}, {-1});
    const auto graph = test::value_or_throw(nir::graph_of(file.arrays(), "x.nir"));
    EXPECT_EQ(graph.nodes[1].value("v_reset"), (std::vector<double>{-1, -1}));
}

TEST(NirGraph, AGraphWithinTheGraphBecomesPartOfIt) {
    NirFile file;
    file.port("in", "Input", 1), file.port("out", "Output", 1);
    file.text("/node/nodes/inner/type", "NIRGraph");
    const std::string inner = "/node/nodes/inner/nodes/";
    for (const std::string name : {"a", "b"}) {
        file.text(inner + name + "/type", name == "a" ? "Input" : "Output");
        file.numbers(inner + name + "/shape", {1}, {1});
    }
    file.text(inner + "gain.1/type", "Scale");
    file.numbers(inner + "gain.1/scale", {1}, {2});
    file.chain({"in", "inner", "out"});
    auto arrays = file.arrays();
    arrays.push_back({"/node/nodes/inner/edges", {2, 2}, true, false, {}, {"a", "gain.1", "gain.1", "b"}});
    const auto graph = test::value_or_throw(nir::graph_of(arrays, "x.nir"));
    EXPECT_EQ(graph.nodes.size(), 5U);
    EXPECT_EQ(graph.edges.size(), 4U);
    EXPECT_EQ(graph.inputs.size(), 1U) << "the ports of the inner graph are not ports of the whole";
    auto same = arrays;
    same.push_back({"/node/nodes/inner.a/type", {}, true, false, {}, {"Input"}});
    same.push_back({"/node/nodes/inner.a/shape", {1}, false, false, {1}, {}});
    EXPECT_EQ(refused(same), "x.nir: two nodes have the name 'inner.a', which a graph within the graph gives to one");
    auto more = arrays;
    more.push_back({"/node/nodes/inner/nodes/a2/type", {}, true, false, {}, {"Input"}});
    more.push_back({"/node/nodes/inner/nodes/a2/shape", {1}, false, false, {1}, {}});
    EXPECT_EQ(refused(more), "x.nir: the graph 'inner' within the graph has 2 nodes of the type Input, but one is required");
    arrays.back().texts[3] = "c";
    EXPECT_EQ(refused(arrays), "x.nir: /node/nodes/inner/edges: edge 1 names the node 'c', which does not exist; did you mean 'a'?");
}

TEST(NirGraph, EachPartThatIsMissingIsNamed) {
    const auto file = lif();
    EXPECT_EQ(refused(file.without("/node/type")),
              "x.nir: this HDF5 file is not a NIR graph: it has no dataset /node/type with the text NIRGraph");
    EXPECT_EQ(refused(file.without("/node/edges")), "x.nir: has no dataset /node/edges");
    EXPECT_EQ(refused(file.without("/node/nodes/lif/tau")), "x.nir: node 'lif' (LIF): has no tau");
    EXPECT_EQ(refused(file.without("/node/nodes/lif/type")), "x.nir: /node/nodes/lif has no type");
    EXPECT_EQ(refused(file.without("/node/nodes/in/shape")), "x.nir: node 'in' (Input): has no shape");
    auto others = file;
    others.node("more", "Threshold"), others.set("more", "threshold", {1});
    EXPECT_EQ(refused(others.arrays()), "x.nir: no edge enters node 'more' (Threshold)");
    EXPECT_EQ(refused(NirFile().arrays()), "x.nir: the graph has no node of the type Input");
}

TEST(NirGraph, ValuesShapesAndTypesAreChecked) {
    const auto with = [](const std::string& parameter, std::vector<std::uint64_t> shape, std::vector<double> values) {
        auto arrays = lif().without("/node/nodes/lif/" + parameter);
        arrays.push_back({"/node/nodes/lif/" + parameter, std::move(shape), false, false, std::move(values), {}});
        return refused(arrays);
    };
    EXPECT_EQ(with("tau", {1}, {0}), "x.nir: node 'lif' (LIF): tau[0] = 0, but a number above 0 is required");
    EXPECT_EQ(with("r", {1}, {NAN}), "x.nir: node 'lif' (LIF): r[0] = nan, but a finite number is required");
    EXPECT_EQ(with("tau", {2}, {1, 1}), "x.nir: node 'lif' (LIF): r has the shape [1], but another parameter [2]");
    EXPECT_EQ(with("noise", {1}, {1}), "x.nir: node 'lif' (LIF): unknown parameter 'noise'; a LIF has tau, r, v_leak, v_threshold, v_reset");
    auto typed = lif();
    typed.node("x", "LIFF");
    EXPECT_EQ(refused(typed.arrays()), "x.nir: node 'x' has the unknown type 'LIFF'; did you mean 'LIF'?");
    auto convolution = lif();
    convolution.node("x", "Conv2d");
    EXPECT_NE(refused(convolution.arrays()).find("node 'x' has the type Conv2d, which is not simulated; the types are Input, "), std::string::npos);
    NirFile huge;
    huge.port("in", "Input", 0x1p30), huge.port("out", "Output", 0x1p30), huge.edge("in", "out");
    EXPECT_EQ(refused(huge.arrays()), "x.nir: the nodes of the graph have more than 33554432 elements");
    auto wide = lif();
    wide.matrix("w", 2, {1, 1}), wide.chain({"in", "w", "lif"});
    EXPECT_EQ(refused(wide.arrays()), "x.nir: the edge from 'w' to 'lif' joins different shapes: the output of 'w' (Linear) is [2], the input of "
                                      "'lif' (LIF) is [1]");
}

}  // namespace
}  // namespace corpuscle
