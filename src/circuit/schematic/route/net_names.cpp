#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {
namespace {

/// Boxes that a name must not touch.
class OccupiedArea {
    std::vector<Box> boxes_;

public:
    explicit OccupiedArea(const Drawing& drawing) {
        for (const auto& placed : drawing.parts) {
            for (const auto& box : placed.shape.obstacles) boxes_.push_back(box.shifted(placed.at));
            for (const auto& pin : placed.shape.pins) {  // its lead
                const auto p = placed.at + pin.at, u = unit_of(pin.out);
                Box lead;
                lead.include(p), lead.include(Point{p.x - 12 * u.x, p.y - 12 * u.y});
                boxes_.push_back(widened(lead));
            }
        }
        for (const auto& net : drawing.nets)
            for (const auto& wire : net.wires) boxes_.push_back(widened(wire.box()));
    }
    static Box widened(Box box) { return {box.left - 4, box.top - 1, box.right + 4, box.bottom + 1}; }
    bool is_free(const Box& box) const {
        return std::none_of(boxes_.begin(), boxes_.end(), [&](const Box& b) { return b.overlaps(box); });
    }
    void add(const Box& box) { boxes_.push_back(box); }
};

int length_of(const Segment& s) { return s.to.x - s.from.x + s.to.y - s.from.y; }

/// Places for a name at a segment, the best first.
std::vector<Text> places_at(const Segment& s, const std::string& name, int net) {
    std::vector<Text> out;
    const bool is_horizontal = s.from.y == s.to.y;
    for (const int eighths : {4, 3, 5, 2, 6, 1, 7, 0, 8}) {
        const int along = length_of(s) * eighths / 8;
        if (is_horizontal) {
            out.push_back({Text::Anchor::middle, Text::Kind::net, {s.from.x + along, s.from.y - 4}, name, net});
            continue;
        }
        out.push_back({Text::Anchor::start, Text::Kind::net, {s.from.x + 4, s.from.y + along + 3}, name, net});
        out.push_back({Text::Anchor::end, Text::Kind::net, {s.from.x - 4, s.from.y + along + 3}, name, net});
    }
    if (is_horizontal)
        for (const int eighths : {4, 2, 6})
            out.push_back({Text::Anchor::middle, Text::Kind::net, {s.from.x + length_of(s) * eighths / 8, s.from.y + 12}, name, net});
    return out;
}

/// Segments by their length; horizontal ones have an advantage, because a name above them is read as theirs.
std::vector<Segment> by_merit(std::vector<Segment> wires) {
    const auto merit = [](const Segment& s) { return length_of(s) * (s.from.y == s.to.y ? 3 : 1); };
    std::sort(wires.begin(), wires.end(), [&](const Segment& a, const Segment& b) {
        return merit(a) != merit(b) ? merit(a) > merit(b) : a.from.y != b.from.y ? a.from.y < b.from.y : a.from.x < b.from.x;
    });
    return wires;
}

bool place_name(DrawnNet& drawn, const std::string& name, int net, OccupiedArea& occupied) {
    for (const auto& segment : by_merit(drawn.wires))
        for (auto& place : places_at(segment, name, net))
            if (occupied.is_free(place.box())) {
                occupied.add(place.box());
                drawn.names.push_back(std::move(place));
                return true;
            }
    return false;
}

}  // namespace

std::vector<int> place_net_names(Drawing& drawing) {
    OccupiedArea occupied(drawing);
    std::vector<bool> is_labelled(drawing.nets.size()), has_flag(drawing.nets.size());
    for (const auto& placed : drawing.parts)
        for (const auto& pin : placed.shape.pins) {
            const auto net = static_cast<std::size_t>(pin.net);
            if (drawing.level.parts[placed.part].symbol == Symbol::port)
                has_flag[net] = true;
            else if (pin.connection == Connection::label)
                is_labelled[net] = true;
        }
    std::vector<int> failed;
    for (const bool is_needed : {true, false})
        for (std::size_t k = 0; k < drawing.nets.size(); ++k) {
            auto& drawn = drawing.nets[k];
            if (drawn.wires.empty() || has_flag[k] || is_labelled[k] != is_needed) continue;
            const bool is_placed = place_name(drawn, shortened(drawing.level.nets[k].name), static_cast<int>(k), occupied);
            if (!is_placed && is_needed) failed.push_back(static_cast<int>(k));
        }
    for (const auto& net : drawing.nets) {
        for (const auto& wire : net.wires) drawing.extent.include(wire.box());
        for (const auto& name : net.names) drawing.extent.include(name.box());
    }
    return failed;
}

}  // namespace corpuscle::circuit::schematic
