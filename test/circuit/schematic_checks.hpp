#pragma once
// Checks of a drawing: nothing overlaps, and its wires and labels connect the same pins as the netlist.

#include <gtest/gtest.h>

#include <set>

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

/// True if a wire passes through the inside of a box.
inline bool crosses(const Segment& wire, const Box& box) {
    return wire.from.x < box.right && wire.to.x > box.left && wire.from.y < box.bottom && wire.to.y > box.top;
}

/// The boxes of a placed part that nothing else may touch.
inline std::vector<Box> boxes_of(const PlacedPart& placed) {
    std::vector<Box> out;
    for (const auto& box : placed.shape.obstacles) out.push_back(box.shifted(placed.at));
    return out;
}

inline void check_that_nothing_overlaps(const Drawing& drawing) {
    const auto name = [&](const PlacedPart& placed) { return drawing.level.path + ": " + drawing.level.parts[placed.part].name; };
    std::vector<Box> names;
    for (const auto& net : drawing.nets)
        for (const auto& text : net.names) names.push_back(text.box());
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(names[a].overlaps(names[b])) << drawing.level.path << ": names of two nets";
    for (std::size_t a = 0; a < drawing.parts.size(); ++a)
        for (const auto& box : boxes_of(drawing.parts[a])) {
            for (std::size_t b = 0; b < a; ++b)
                for (const auto& other : boxes_of(drawing.parts[b]))
                    EXPECT_FALSE(box.overlaps(other)) << name(drawing.parts[a]) << " and " << name(drawing.parts[b]);
            for (const auto& text : names) EXPECT_FALSE(box.overlaps(text)) << name(drawing.parts[a]) << " and the name of a net";
            for (std::size_t net = 0; net < drawing.nets.size(); ++net)
                for (const auto& wire : drawing.nets[net].wires)
                    EXPECT_FALSE(crosses(wire, box)) << name(drawing.parts[a]) << " and a wire of " << drawing.level.nets[net].name;
        }
    for (const auto& net : drawing.nets)
        for (const auto& wire : net.wires)
            for (const auto& text : names) EXPECT_FALSE(crosses(wire, text)) << drawing.level.path << ": a wire and the name of a net";
}

/// Sets of numbers that are joined one after the other.
class JoinedSets {
    std::vector<std::size_t> parent_;

public:
    std::size_t add() { return parent_.push_back(parent_.size()), parent_.size() - 1; }
    std::size_t find(std::size_t k) const {
        while (parent_[k] != k) k = parent_[k];
        return k;
    }
    void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }
};

inline bool is_on(Point p, const Segment& s) { return p.x >= s.from.x && p.x <= s.to.x && p.y >= s.from.y && p.y <= s.to.y; }

/// Reads the connections of a drawing from its geometry, as a reader does. Wires are joined where one ends on another, and at junctions. A
/// pin is joined with the wires that end at it. Equal labels are joined, also with the name beside a wire.
class ConnectionReader {
    const Drawing& drawing_;
    JoinedSets sets_;
    std::vector<std::pair<Segment, std::size_t>> wires_;
    std::map<std::string, std::size_t> labels_;

    void join_label(const std::string& name, std::size_t set) {
        const auto [at, is_new] = labels_.emplace(name, set);
        if (!is_new) sets_.join(at->second, set);
    }
    /// The label of a pin: the text of a port's flag, or the mark at the pin.
    std::string label_of(const PlacedPart& placed, std::size_t pin) const {
        const auto connection = placed.shape.pins[pin].connection;
        if (connection == Connection::ground) return "(ground)";
        const bool is_port = drawing_.level.parts[placed.part].symbol == Symbol::port;
        if (connection == Connection::wire && !is_port) return "";
        const auto at = placed.shape.pins[pin].at;
        const Text* nearest = nullptr;
        int least = 0;
        for (const auto& text : placed.shape.texts) {
            if (text.kind != Text::Kind::net) continue;
            const auto box = text.box();
            const int far = std::max({box.left - at.x, at.x - box.right, 0}) + std::max({box.top - at.y, at.y - box.bottom, 0});
            if (nearest == nullptr || far < least) nearest = &text, least = far;
        }
        return nearest == nullptr ? "" : nearest->text;
    }

public:
    explicit ConnectionReader(const Drawing& drawing) : drawing_(drawing) {
        std::vector<Point> junctions;
        for (const auto& net : drawing.nets) {
            for (const auto& wire : net.wires) wires_.emplace_back(wire, sets_.add());
            junctions.insert(junctions.end(), net.junctions.begin(), net.junctions.end());
        }
        for (const auto& [a, set_a] : wires_)
            for (const auto& [b, set_b] : wires_)
                if (is_on(a.from, b) || is_on(a.to, b)) sets_.join(set_a, set_b);
        for (const auto point : junctions) {
            std::optional<std::size_t> first;
            for (const auto& [wire, set] : wires_)
                if (is_on(point, wire)) sets_.join(set, first.value_or(set)), first = set;
        }
        for (const auto& net : drawing.nets)
            for (const auto& text : net.names)
                for (const auto& [wire, set] : wires_) {
                    auto box = text.box();
                    box.left -= 5, box.right += 5, box.top -= 5, box.bottom += 5;
                    if (crosses(wire, box) && std::any_of(net.wires.begin(), net.wires.end(),
                                                          [&](const Segment& s) { return s.from == wire.from && s.to == wire.to; }))
                        join_label(text.text, set);
                }
    }

    /// The sets of pins (part, pin) that are connected.
    std::set<std::set<std::pair<std::size_t, std::size_t>>> connected_pins() {
        std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::size_t>> pins;
        for (const auto& placed : drawing_.parts)
            for (std::size_t k = 0; k < placed.shape.pins.size(); ++k) {
                const auto set = sets_.add();
                pins.push_back({{placed.part, k}, set});
                for (const auto& [wire, wire_set] : wires_)
                    if (is_on(placed.pin(k), wire)) sets_.join(set, wire_set);
                for (const auto& [other, other_set] : pins)
                    if (other_set != set && position(other) == placed.pin(k)) sets_.join(set, other_set);
                if (const auto label = label_of(placed, k); !label.empty()) join_label(label, set);
            }
        std::map<std::size_t, std::set<std::pair<std::size_t, std::size_t>>> groups;
        for (const auto& [pin, set] : pins) groups[sets_.find(set)].insert(pin);
        std::set<std::set<std::pair<std::size_t, std::size_t>>> out;
        for (const auto& [set, group] : groups) out.insert(group);
        return out;
    }
    Point position(const std::pair<std::size_t, std::size_t>& pin) const { return drawing_.parts[pin.first].pin(pin.second); }
};

/// The sets of pins that the level connects.
inline std::set<std::set<std::pair<std::size_t, std::size_t>>> connected_pins_of(const Level& level) {
    std::map<int, std::set<std::pair<std::size_t, std::size_t>>> groups;
    for (std::size_t p = 0; p < level.parts.size(); ++p)
        for (std::size_t k = 0; k < level.parts[p].pins.size(); ++k) groups[level.parts[p].pins[k].net].insert({p, k});
    std::set<std::set<std::pair<std::size_t, std::size_t>>> out;
    for (const auto& [net, group] : groups) out.insert(group);
    return out;
}

inline void check_connections(const Drawing& drawing) {
    EXPECT_EQ(ConnectionReader(drawing).connected_pins(), connected_pins_of(drawing.level)) << drawing.level.path;
}

}  // namespace corpuscle::circuit::schematic
