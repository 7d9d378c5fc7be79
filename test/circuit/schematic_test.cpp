// Schematics: every circuit of the tree, random circuits, and hostile names.

#include <gtest/gtest.h>

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <filesystem>

#include "circuit/schematic/draw_level.hpp"
#include "circuit/schematic/schematic.hpp"
#include "circuit/schematic_checks.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "run/export/targets.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::circuit {
namespace {

using schematic::Drawing;
using schematic::LevelReader;
using schematic::Symbol;

std::vector<std::string> circuit_files() {
    std::vector<std::string> out;
    for (const auto& file : std::filesystem::directory_iterator(corpuscle::test::source_root() + "/circuits"))
        if (file.path().extension() == ".cir") out.push_back(file.path().string());
    std::sort(out.begin(), out.end());
    return out;
}

Netlist drawn_netlist(const std::string& body, const std::string& title = "drawn") {
    const auto no_file = [](const std::string&) -> Result<std::string> { return bad_input("there is no such file"); };
    auto netlist = Netlist::parse(title + "\n" + body, "drawn.cir", no_file);
    EXPECT_TRUE(netlist) << (netlist ? "" : netlist.error().text());
    return netlist ? *netlist : Netlist();
}

std::vector<std::string> paths_of(const LevelReader& levels) {
    std::vector<std::string> out = {""};
    for (const auto path : levels.block_paths()) out.emplace_back(path);
    return out;
}

/// The values of an attribute in a text of XML.
std::vector<std::string> attribute_values(const std::string& svg, const std::string& attribute) {
    std::vector<std::string> out;
    const auto mark = " " + attribute + "=\"";
    for (auto at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at)) {
        at += mark.size();
        out.push_back(svg.substr(at, svg.find('"', at) - at));
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// The first fault of an XML text: tags that do not match, attributes without quotes, bare & or <. "" if it is well-formed.
std::string fault_of_xml(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '&') {
            const auto end = text.find(';', at);
            const auto entity = text.substr(at, end - at + 1);
            if (std::set<std::string>{"&lt;", "&gt;", "&amp;", "&quot;", "&#39;"}.count(entity) == 0) return "entity " + entity;
        }
        if (text[at] == '>') return "'>' at " + text.substr(at, 20);
        if (text[at] != '<') continue;
        auto end = at + 1;
        bool is_quoted = false;
        for (; end < text.size() && (is_quoted || text[end] != '>'); ++end) {
            is_quoted = is_quoted != (text[end] == '"');
            if (text[end] == '<' || static_cast<unsigned char>(text[end]) < 0x20) return "inside of a tag at " + text.substr(at, 60);
        }
        if (end >= text.size()) return "tag without end at " + text.substr(at, 60);
        const auto tag = text.substr(at + 1, end - at - 1);
        const auto name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) return "closing tag " + tag;
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
        at = end;
    }
    return open.empty() ? "" : "tag is not closed: " + open.back();
}

void check_all_levels(const Netlist& netlist) {
    const auto circuit = netlist.elaborate_hierarchy();
    ASSERT_TRUE(circuit) << circuit.error().text();
    LevelReader levels(*circuit);
    for (const auto& path : paths_of(levels)) {
        const auto drawing = schematic::draw_level(levels.read(path));
        schematic::check_that_nothing_overlaps(drawing);
        schematic::check_connections(drawing);
    }
}

TEST(Schematic, OfEveryCircuitOverlapsNothingAndHasItsConnections) {
    const auto files = circuit_files();
    ASSERT_GE(files.size(), 42u);
    for (const auto& file : files) {
        SCOPED_TRACE(file);
        const auto netlist = Netlist::read(file);
        ASSERT_TRUE(netlist);
        check_all_levels(*netlist);
    }
}

TEST(Schematic, OfEveryCircuitHasEachDeviceAndNodeOnce) {
    for (const auto& file : circuit_files()) {
        SCOPED_TRACE(file);
        const auto netlist = Netlist::read(file);
        ASSERT_TRUE(netlist);
        const auto flat = netlist->elaborate();
        const auto all = draw_schematics(*netlist);
        ASSERT_TRUE(flat && all);
        std::vector<std::string> drawn, expected;
        std::set<std::string> nets, nodes;
        for (const auto& one : *all) {
            EXPECT_EQ(fault_of_xml(one.svg), "") << one.block;
            for (const auto& name : attribute_values(one.svg, "data-device")) drawn.push_back(name);
            for (const auto& name : attribute_values(one.svg, "data-net")) nets.insert(name);
        }
        for (const auto& e : flat->elements) {
            expected.push_back(e.name);
            for (const int node : e.nodes) nodes.insert(flat->nodes[static_cast<std::size_t>(node)]);
        }
        std::sort(drawn.begin(), drawn.end()), std::sort(expected.begin(), expected.end());
        EXPECT_EQ(drawn, expected);
        for (const auto& node : nodes) EXPECT_EQ(nets.count(node), 1u) << node;
    }
}

TEST(Schematic, ShowsABulkThatIsNotAtItsRail) {
    const auto netlist = drawn_netlist("vdd vdd 0 1\nmp1 a b vdd vdd p\nmn1 a b 0 0 n\nmn2 c b 0 c n\n.model p pmos\n.model n nmos\n");
    const auto circuit = netlist.elaborate_hierarchy();
    ASSERT_TRUE(circuit) << circuit.error().text();
    const auto level = LevelReader(*circuit).read("");
    for (const auto& part : level.parts) {
        if (part.name == "mn2") {
            EXPECT_EQ(part.pins.size(), 4u);
        }
        if (part.name == "mp1" || part.name == "mn1") {
            EXPECT_EQ(part.pins.size(), 3u);
            EXPECT_EQ(level.nets[static_cast<std::size_t>(part.index_of_hidden_bulk_net)].name, part.name == "mp1" ? "vdd" : "0");
        }
    }
}

TEST(Schematic, OfABlockKeepsPortsApartThatAreConnectedOutside) {
    const auto netlist = drawn_netlist("v1 a 0 1\nx1 a a 0 half\n.subckt half in out low\nr1 in out 1k\nr2 out low 1k\n.ends\n");
    const auto drawn = draw_schematic(netlist, "1");
    ASSERT_TRUE(drawn) << drawn.error().text();
    EXPECT_EQ(drawn->block, "x1");
    EXPECT_EQ(drawn->subcircuit, "half");
    EXPECT_EQ(attribute_values(drawn->svg, "data-net"), (std::vector<std::string>{"0", "a", "a"}));
    check_all_levels(netlist);
}

TEST(Schematic, EscapesNamesThatLookLikeMarkup) {
    const auto netlist = drawn_netlist("v1 <script> 0 1\nr1 <script> a&b 1k\nx<b> a&b <i>\n.subckt <i> p\nr1 p 0 1\n.ends\nr3 a&b x>z 1k\n",
                                       "</title>\"><script onload=alert(1)>&");
    const auto all = draw_schematics(netlist);
    ASSERT_TRUE(all) << all.error().text();
    for (const auto& one : *all) {
        EXPECT_EQ(fault_of_xml(one.svg), "");
        EXPECT_EQ(one.svg.find("<script"), std::string::npos);
        EXPECT_EQ(attribute_values(one.svg, "onload").size(), 0u);
    }
    EXPECT_NE(all->front().svg.find("&lt;script&gt;"), std::string::npos);
    EXPECT_EQ(fault_of_xml("<a b=\"<\"/>"), "inside of a tag at <a b=\"<\"/>");
    EXPECT_EQ(fault_of_xml("<a>"), "tag is not closed: a");
    EXPECT_NE(fault_of_xml("<a>&b;</a>"), "");
}

TEST(Schematic, OfTheSameCircuitHasTheSameBytes) {
    for (const auto* name : {"sa1-circuit", "fa1-circuit"}) {
        const auto first = open_netlist(name), second = open_netlist(name);
        ASSERT_TRUE(first && second);
        const auto a = draw_schematics(*first), b = draw_schematics(*second);
        ASSERT_TRUE(a && b);
        ASSERT_EQ(a->size(), b->size());
        for (std::size_t k = 0; k < a->size(); ++k) EXPECT_EQ((*a)[k].svg, (*b)[k].svg);
    }
}

TEST(Schematic, OfTooManyDevicesIsRefusedWithTheLimit) {
    std::string body = "v1 n0 0 1\n";
    for (int k = 0; k < 10000; ++k) body += fmt::format("r{} n{} n{} 1k\n", k, k, k + 1);
    const auto drawn = draw_schematic(drawn_netlist(body), "");
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().message,
              "the top level has 10001 devices, blocks and ports; a schematic has at most 500, so divide it into subcircuits");
}

TEST(Schematic, OfABlockThatDoesNotExistNamesThoseThatDo) {
    const auto netlist = open_netlist("sa1-circuit");
    ASSERT_TRUE(netlist);
    const auto mistyped = draw_schematic(*netlist, "sumer"), none = draw_schematic(*netlist, "comparator");
    const auto several = draw_schematic(*netlist, "trigger");
    ASSERT_FALSE(mistyped || none || several);
    EXPECT_NE(mistyped.error().message.find("did you mean 'summer'?"), std::string::npos) << mistyped.error().message;
    EXPECT_NE(none.error().message.find("there is no block 'comparator'; blocks are x"), std::string::npos) << none.error().message;
    EXPECT_EQ(several.error().message,
              "'trigger' is one of several blocks: xrectb.xtrigger, xrectc.xtrigger, xcco.xtrigger; name one of them");
    ASSERT_TRUE(draw_schematic(*netlist, "hpb.RES"));
}

const char* const cells =
    ".subckt inv a y vdd vss\nm1 y a vss vss n w=1u l=1u\nm2 y a vdd vdd p w=2u l=1u\n.ends\n"
    ".subckt buf a y vdd vss\nx1 a b vdd vss inv\nx2 b y vdd vss inv\n.ends\n.model n nmos\n.model p pmos\n";

TEST(Schematic, OfASubcircuitThatNoXLineUsesIsItsDefinition) {
    const auto netlist = drawn_netlist(cells);
    const auto inv = draw_schematic(netlist, "INV"), buf = draw_schematic(netlist, "buf");
    ASSERT_TRUE(inv) << inv.error().text();
    ASSERT_TRUE(buf) << buf.error().text();
    EXPECT_EQ(inv->block, "inv");
    EXPECT_EQ(inv->subcircuit, "inv");
    EXPECT_EQ(attribute_values(inv->svg, "data-device"), (std::vector<std::string>{"inv.m1", "inv.m2"}));
    EXPECT_EQ(attribute_values(inv->svg, "data-net"), (std::vector<std::string>{"a", "vdd", "vss", "y"}));
    EXPECT_NE(inv->svg.find("<title>inv</title>"), std::string::npos);
    EXPECT_EQ(attribute_values(buf->svg, "data-block"), (std::vector<std::string>{"buf.x1", "buf.x2"}));
    EXPECT_TRUE(draw_schematic(drawn_netlist("v1 a 0 1\nr1 a 0 1k\n" + std::string(cells)), "inv"));
}

TEST(Schematic, OfAnEmptyTopLevelIsRefusedWithTheSubcircuitsThatCanBeDrawn) {
    const auto message = [](const std::string& body, const std::string& block) {
        const auto drawn = draw_schematic(drawn_netlist(body), block);
        return drawn ? "drawn" : drawn.error().text();
    };
    EXPECT_EQ(message("", ""), "drawn.cir: the circuit has no elements");
    EXPECT_EQ(message(".subckt inv a y\nr1 a y 1k\n.ends\n", ""),
              "drawn.cir: inv is defined, but no X line uses it; add one, such as 'x1 a y inv', or draw it with --block inv");
    EXPECT_EQ(message(cells, ""),
              "drawn.cir: buf, inv are defined, but no X line uses them; add one, such as 'x1 a y vdd vss buf', or draw one of them with "
              "--block buf");
    EXPECT_EQ(message(cells, "x"), "there is no block 'x'; subcircuits are buf, inv");
    EXPECT_EQ(message(cells, "bufs"), "there is no block 'bufs'; did you mean 'buf'?");
    EXPECT_EQ(message(std::string(cells) + "x1 a y vdd vss buf\n", ""), "drawn");
}

TEST(Schematic, OfASubcircuitIsThatOfItsOnlyBlock) {
    const auto body = std::string(cells) + "xneuron a y vdd vss buf\n";
    const auto buf = draw_schematic(drawn_netlist(body), "buf"), inv = draw_schematic(drawn_netlist(body), "inv");
    ASSERT_TRUE(buf) << buf.error().text();
    EXPECT_EQ(buf->block, "xneuron");
    ASSERT_FALSE(inv);
    EXPECT_EQ(inv.error().message, "'inv' is one of several blocks: xneuron.x1, xneuron.x2; name one of them");
}

/// The width and height of an SVG's viewBox.
std::pair<int, int> size_of(const std::string& svg) {
    const auto view = attribute_values(svg, "viewBox").front();
    int left = 0, top = 0, width = 0, height = 0;
    EXPECT_EQ(std::sscanf(view.c_str(), "%d %d %d %d", &left, &top, &width, &height), 4);
    return {width, height};
}

TEST(Schematic, OfALongFlatCircuitIsBrokenIntoRows) {
    std::string chain = "vdd vdd 0 1\nv1 n0 0 1\n.model n nmos\n.model p pmos\n", ladder = "v1 n0 0 1\n", grid = "v1 g0_0 0 1\n";
    for (int k = 0; k < 60; ++k) chain += fmt::format("mp{0} n{1} n{0} vdd vdd p\nmn{0} n{1} n{0} 0 0 n\n", k, k + 1);
    for (int k = 0; k < 100; ++k) ladder += fmt::format("r{0} n{0} n{1} 1k\nc{0} n{1} 0 1p\n", k, k + 1);
    for (int row = 0; row < 15; ++row)
        for (int column = 0; column < 15; ++column)
            grid += fmt::format("ra{0}_{1} g{0}_{1} g{2}_{1} 1k\nrb{0}_{1} g{0}_{1} g{0}_{3} 1k\n", row, column, row + 1, column + 1);
    for (const auto& body : {chain, ladder, grid}) {
        const auto netlist = drawn_netlist(body);
        const auto drawn = draw_schematic(netlist, "");
        ASSERT_TRUE(drawn) << drawn.error().text();
        const auto [width, height] = size_of(drawn->svg);
        EXPECT_LE(std::max(width, height), 4 * std::min(width, height)) << width << " x " << height;
        check_all_levels(netlist);
    }
}

TEST(Schematic, IsAnExportTargetThatTakesABlock) {
    const auto* target = find_export_target("svg");
    ASSERT_NE(target, nullptr);
    ExportRequest request, equations;
    request.subject = "sa1-circuit", request.block = "summer", equations.subject = "sa1";
    const auto summer = write_model(*target, request);
    ASSERT_TRUE(summer) << summer.error().text();
    EXPECT_NE(summer->text.find("data-device=\"xsummer.mn3b\""), std::string::npos);
    EXPECT_NE(summer->text.find(">12 x 4<"), std::string::npos);
    EXPECT_TRUE(target->is_own(summer->text));
    EXPECT_FALSE(target->is_own("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\"/>"));
    const auto other = write_model(*find_export_target("ngspice"), request);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().message, "--block summer is for --for svg; ngspice exports the complete subject");
    EXPECT_FALSE(write_model(*target, equations));
}

TEST(Schematic, ShowsTheValuesOfOverrides) {
    ExportRequest request;
    request.subject = "sa1-circuit", request.block = "summer";
    request.settings.push_back(*parse_netlist_override("sa1-circuit", "summer.N3B=7x3"));
    const auto drawn = write_model(*find_export_target("svg"), request);
    ASSERT_TRUE(drawn) << drawn.error().text();
    EXPECT_NE(drawn->text.find(">7 x 3<"), std::string::npos);
}

TEST(Schematic, OfUnusualCircuitsOverlapsNothing) {
    check_all_levels(drawn_netlist(""));
    check_all_levels(drawn_netlist("r1 0 0 1\nr2 a a 1\nm1 a a a a n\n.model n nmos\n"));
    check_all_levels(drawn_netlist(
        "l1 a 0 1\nl2 b 0 1\nk1 l1 l2 0.5\ne1 c 0 a b 2\nf1 c 0 v1 1\nv1 d 0 0\ng1 c d c d 1\nb1 e 0 i=v(a)*v(b)*v(c)*v(d)\n"));
    check_all_levels(drawn_netlist("x1 a b one\nx2 b a one\n.subckt one p q\nx3 q p two\n.ends\n.subckt two p q\nc1 p q 1p\n.ends\n"));
    check_all_levels(drawn_netlist("m1 a b c d n\nm2 c a b d n\nm3 b c a d p\n.model n nmos\n.model p pmos\n"));
    check_all_levels(drawn_netlist("x1 one\n.subckt one\nr1 a 0 1k\n.ends\n"));
}

/// A random netlist of transistors, passive devices and blocks.
std::string random_body(int devices) {
    const auto node = [] {
        static const char* names[] = {"0", "vdd", "a", "b", "c", "d", "e", "f", "g", "h"};
        return std::string(names[*rc::gen::inRange(0, 10)]);
    };
    std::string body =
        "vdd vdd 0 1\n.model n nmos\n.model p pmos\n.model q npn\n.subckt cell i o s vdd\nm1 o i s vdd p\nm2 o i 0 0 n\n.ends\n";
    for (int k = 0; k < devices; ++k) {
        const int kind = *rc::gen::inRange(0, 12);
        const auto a = node(), b = node(), c = node(), d = node();
        if (kind < 3)
            body += fmt::format("mn{} {} {} {} {} n\n", k, a, b, c, kind == 0 ? "0" : d);
        else if (kind < 6)
            body += fmt::format("mp{} {} {} {} {} p\n", k, a, b, c, kind == 3 ? "vdd" : d);
        else if (kind < 8)
            body += fmt::format("x{} {} {} {} vdd cell\n", k, a, b, c);
        else if (kind == 8)
            body += fmt::format("q{} {} {} {} q\n", k, a, b, c);
        else if (kind == 9)
            body += fmt::format("e{} {} {} {} {} 1\n", k, a, b, c, d);
        else
            body += fmt::format("{}{} {} {} 1\n", "rci"[*rc::gen::inRange(0, 3)], k, a, b);
    }
    return body;
}

RC_GTEST_PROP(Schematic, OfRandomCircuitsOverlapsNothingAndHasItsConnections, ()) {
    check_all_levels(drawn_netlist(random_body(*rc::gen::inRange(1, 40))));
    RC_ASSERT(!::testing::Test::HasFailure());
}

}  // namespace
}  // namespace corpuscle::circuit
