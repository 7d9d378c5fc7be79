// Symbols of schematics: their lines end at the pins in every orientation, and their texts have room and tell all values.

#include <gtest/gtest.h>

#include <sstream>

#include "circuit/schematic/draw_level.hpp"
#include "circuit/schematic/level/level_nets.hpp"
#include "circuit/schematic/schematic.hpp"
#include "circuit/schematic/svg_text.hpp"
#include "circuit/schematic_checks.hpp"

namespace corpuscle::circuit::schematic {
namespace {

/// The linear map and the shift of an SVG transform that is one of translate, scale, rotate (by right angles) and matrix.
struct Transform {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
    Point operator()(double x, double y) const {
        return {static_cast<int>(std::lround(a * x + c * y + e)), static_cast<int>(std::lround(b * x + d * y + f))};
    }
};

Transform transform_of(const std::string& text) {
    const auto open = text.find('(');
    if (open == std::string::npos) return {};
    std::istringstream numbers(text.substr(open + 1));
    std::vector<double> n(std::istream_iterator<double>(numbers), {});
    const auto kind = text.substr(0, open);
    if (kind == "translate") return {1, 0, 0, 1, n[0], n[1]};
    if (kind == "scale") return {n[0], 0, 0, n.size() > 1 ? n[1] : n[0], 0, 0};
    if (kind == "matrix") return {n[0], n[1], n[2], n[3], n[4], n[5]};
    EXPECT_EQ(kind, "rotate");
    const double angle = n[0] * 3.14159265358979323846 / 180;
    return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
}

/// The points at which the lines of path data begin and end.
std::vector<std::pair<double, double>> points_of_path(const std::string& data) {
    std::vector<std::pair<double, double>> out;
    std::size_t at = 0;
    const auto number = [&] {
        while (data[at] == ' ' || data[at] == ',') ++at;
        std::size_t used = 0;
        const double value = std::stod(data.substr(at), &used);
        at += used;
        return value;
    };
    double x = 0, y = 0;
    while (at < data.size()) {
        const char command = data[at++];
        switch (command) {
            case 'M':
            case 'L':
                x = number(), y = number();
                break;
            case 'H':
                x = number();
                break;
            case 'V':
                y = number();
                break;
            case 'h':
                x += number();
                break;
            case 'v':
                y += number();
                break;
            case 'a':
                for (int k = 0; k < 5; ++k) number();
                [[fallthrough]];
            case 'l':
                x += number(), y += number();
                break;
            default:
                EXPECT_EQ(command, 'z');
        }
        out.emplace_back(x, y);
    }
    return out;
}

std::string attribute(const std::string& tag, const std::string& name) {
    const auto at = tag.find(" " + name + "=\"");
    if (at == std::string::npos) return "";
    const auto begin = at + name.size() + 3;
    return tag.substr(begin, tag.find('"', begin) - begin);
}

/// The points of all paths of an SVG, as they are seen.
std::vector<Point> drawn_points(const std::string& svg) {
    std::vector<Point> out;
    Transform group;
    for (auto at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
        const auto tag = svg.substr(at, svg.find('>', at) - at);
        if (tag.starts_with("<g ")) group = transform_of(attribute(tag, "transform"));
        if (!tag.starts_with("<path")) continue;
        const auto own = transform_of(attribute(tag, "transform"));
        for (const auto& [x, y] : points_of_path(attribute(tag, "d"))) {
            const auto p = own(x, y);
            out.push_back(group(p.x, p.y));
        }
    }
    return out;
}

/// A drawing of one part, whose pins are connected to a net each.
Drawing drawing_of(Symbol symbol, std::size_t pins, Orientation orientation) {
    Drawing drawing;
    Part part;
    part.symbol = symbol, part.name = "part", part.path = "part";
    part.has_controlling_pair = symbol != Symbol::block && !is_transistor(symbol) && pins == 4;
    drawing.level.nets.resize(pins + 1);
    for (std::size_t k = 0; k < pins; ++k)
        part.pins.push_back({static_cast<int>(k) + 1, PinRole::passive, "", static_cast<Direction>(k % 4)});
    drawing.level.parts.push_back(part);
    drawing.styles.is_label.resize(pins + 1);
    drawing.nets.resize(pins + 1);
    drawing.parts.push_back({0, orientation, {200, 100}, shape_of(drawing.level, part, drawing.styles, orientation)});
    return drawing;
}

TEST(SchematicSymbols, EndAtTheirPinsInEveryOrientation) {
    for (auto symbol = Symbol::nmos; symbol <= Symbol::port; symbol = static_cast<Symbol>(static_cast<int>(symbol) + 1)) {
        const std::size_t least = symbol == Symbol::note ? 0 : symbol == Symbol::port ? 1 : is_transistor(symbol) ? 3 : 2;
        const std::size_t most = symbol == Symbol::port || symbol == Symbol::note ? least : is_transistor(symbol) ? 4 : 5;
        for (std::size_t pins = least; pins <= most; ++pins)
            for (int turn = 0; turn < 8; ++turn) {
                const Orientation o{(turn & 1) != 0, (turn & 2) != 0, (turn & 4) != 0};
                const auto drawing = drawing_of(symbol, pins, o);
                const auto points = drawn_points(svg_of(drawing));
                for (std::size_t k = 0; k < pins; ++k) {
                    const auto pin = drawing.parts[0].pin(k);
                    EXPECT_NE(std::find(points.begin(), points.end(), pin), points.end())
                        << "symbol " << static_cast<int>(symbol) << " with " << pins << " pins, turn " << turn
                        << ": nothing is drawn at pin " << k + 1 << " (" << pin.x << ", " << pin.y << ")";
                }
            }
    }
}

Netlist parsed(const std::string& body) {
    const auto no_file = [](const std::string&) -> Result<std::string> { return bad_input("there is no such file"); };
    auto netlist = Netlist::parse("title\n" + body, "drawn.cir", no_file);
    EXPECT_TRUE(netlist) << (netlist ? "" : netlist.error().text());
    return netlist ? *netlist : Netlist();
}

Drawing top_level_of(const std::string& body) {
    const auto circuit = parsed(body).elaborate_hierarchy();
    EXPECT_TRUE(circuit) << circuit.error().text();
    return draw_level(LevelReader(*circuit).read(""));
}

/// The texts beside a device: its name, its values and its model.
std::vector<std::string> texts_beside(const Drawing& drawing, const std::string& name) {
    std::vector<std::string> out;
    for (const auto& placed : drawing.parts)
        if (drawing.level.parts[placed.part].name == name)
            for (const auto& text : placed.shape.texts)
                if (text.kind != Text::Kind::net) out.push_back(text.text);
    return out;
}

TEST(SchematicSymbols, ShowAllValuesOfTheirDevices) {
    using Texts = std::vector<std::string>;
    const auto drawing = top_level_of(
        "v1 a 0 dc 1 ac 1 pulse(0 1 1m)\niin 0 a dc 10n force 60n\nr1 a b 1k m=3\nc1 a b 1p m=4\nr2 a b r={1k*v(a)}\n"
        "d1 a b dz area=2 m=5\ns1 a b a 0 sw1\nv0 e 0 0\nw1 a b v0 sw2\ng1 a b a 0 1m m=2\nh1 f 0 v0 50\ne1 g 0 a b 2\nf1 a b v0 3\n"
        "q1 a b 0 0 qn 3 m=2\nr3 f g rm l=2u w=1u\n"
        ".model dz d\n.model sw1 sw\n.model sw2 csw\n.model qn npn\n.model rm r rsh=100\n");
    EXPECT_EQ(texts_beside(drawing, "v1"), (Texts{"v1", "pulse", "dc 1 V", "ac 1 V"}));
    EXPECT_EQ(texts_beside(drawing, "iin"), (Texts{"iin", "force, 60 nA/N", "dc 10 nA"}));
    EXPECT_EQ(texts_beside(drawing, "r1"), (Texts{"r1", "1 kohm", "m = 3"}));
    EXPECT_EQ(texts_beside(drawing, "c1"), (Texts{"c1", "1 pF", "m = 4"}));
    EXPECT_EQ(texts_beside(drawing, "r2"), (Texts{"r2", "r = f(...)"}));
    EXPECT_EQ(texts_beside(drawing, "d1"), (Texts{"d1", "area 2", "m = 5", "dz"}));
    EXPECT_EQ(texts_beside(drawing, "s1"), (Texts{"s1", "sw1"}));
    EXPECT_EQ(texts_beside(drawing, "w1"), (Texts{"w1", "i(v0)", "sw2"}));
    EXPECT_EQ(texts_beside(drawing, "g1"), (Texts{"g1", "1 mS", "m = 2"}));
    EXPECT_EQ(texts_beside(drawing, "h1"), (Texts{"h1", "50 ohm", "i(v0)"}));
    EXPECT_EQ(texts_beside(drawing, "e1"), (Texts{"e1", "gain 2"}));
    EXPECT_EQ(texts_beside(drawing, "f1"), (Texts{"f1", "gain 3", "i(v0)"}));
    EXPECT_EQ(texts_beside(drawing, "q1"), (Texts{"q1", "area 3", "m = 2", "qn"}));
    EXPECT_EQ(texts_beside(drawing, "r3"), (Texts{"r3", "200 ohm", "rm"}));
}

TEST(SchematicSymbols, HaveTextsBesideTheMarksOfTheirPins) {
    for (const auto* body :
         {"vcc c 0 5\nvb b 0 0.6\nq1 c b 0 0 qn 3\n.model qn npn\n", "vdd vdd 0 1\nm1 0 vdd vdd 0 p w=1u l=1u\n.model p pmos\n",
          "vcc vcc 0 5\nq1 vcc b 0 vcc qn 3 m=2\n.model qn pnp\n", "q1 c b 0 sub qn 3\n.model qn npn\n"}) {
        const auto drawing = top_level_of(body);
        for (const auto& placed : drawing.parts) {
            if (!is_transistor(drawing.level.parts[placed.part].symbol)) continue;
            ASSERT_EQ(placed.shape.pins.size(), 4u);
            const auto& boxes = placed.shape.obstacles;
            for (std::size_t a = 0; a < boxes.size(); ++a)
                for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(boxes[a].overlaps(boxes[b])) << body << ": boxes " << a << " and " << b;
        }
    }
}

TEST(SchematicSymbols, HaveSignsAtTheNodesOfAControllingVoltageOnly) {
    const auto count = [](const std::string& body) {
        const auto svg = draw_schematic(parsed(body), "")->svg;
        std::size_t plus = 0;
        for (auto at = svg.find("v6"); at != std::string::npos; at = svg.find("v6", at + 1)) ++plus;
        return plus;
    };
    EXPECT_EQ(count("e1 a 0 b c 2\nr1 a 0 1\nr2 b c 1\n"), 2u);  // one in the diamond
    EXPECT_EQ(count("g1 a 0 b c 2\nr1 a 0 1\nr2 b c 1\n"), 1u);
    EXPECT_EQ(count("s1 a 0 b c m\nr1 a 0 1\nr2 b c 1\n.model m sw\n"), 1u);
    EXPECT_EQ(count("b1 a 0 i=v(b)*v(c)\nr1 a 0 1\nr2 b c 1\n"), 0u);
}

TEST(SchematicSymbols, AreCountedInTheSingular) {
    const auto netlist = parsed("r1 0 0 1\n");
    const auto drawn = draw_schematic(netlist, "");
    ASSERT_TRUE(drawn) << drawn.error().text();
    EXPECT_NE(drawn->svg.find("<desc>Schematic with 1 device, 0 blocks and 1 net</desc>"), std::string::npos) << drawn->svg;
}

}  // namespace
}  // namespace corpuscle::circuit::schematic
