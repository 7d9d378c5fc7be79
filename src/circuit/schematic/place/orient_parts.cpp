#include "circuit/schematic/place/orient_parts.hpp"

#include "circuit/schematic/shape/block_shape.hpp"

namespace corpuscle::circuit::schematic {
namespace {

class PartOrienter {
    Drawing& drawing_;
    const std::vector<int>& position_;
    std::vector<std::vector<std::size_t>> parts_of_net_;

    bool is_wired(const Pin& pin) const { return connection_of(drawing_.level, drawing_.styles, pin) == Connection::wire; }

    /// The mean position of the other parts of a net, relative to that of the part; 0 if there are none.
    double side_of(std::size_t p, const Pin& pin) const {
        if (!is_wired(pin)) return 0;
        double sum = 0, count = 0;
        for (const auto other : parts_of_net_[static_cast<std::size_t>(pin.net)])
            if (position_[other] != position_[p]) sum += position_[other] - position_[p], count += 1;
        return count > 0 ? sum / count : 0;
    }
    void orient_block(std::size_t p) const {
        auto& block = drawing_.level.parts[p];
        set_usual_sides(drawing_.level, block);
        for (auto& pin : block.pins) {
            if (pin.side != Direction::left && pin.side != Direction::right) continue;
            if (const double side = side_of(p, pin); side != 0) pin.side = side < 0 ? Direction::left : Direction::right;
        }
    }

public:
    PartOrienter(Drawing& drawing, const std::vector<int>& position)
        : drawing_(drawing), position_(position), parts_of_net_(parts_of_nets(drawing)) {}

    void orient(std::size_t p, Orientation& o) const {
        const auto& part = drawing_.level.parts[p];
        const auto& pins = part.pins;
        if (part.symbol == Symbol::port)
            o.is_mirrored = pins[0].role != PinRole::drive;
        else if (part.symbol == Symbol::block)
            orient_block(p);
        else if (is_transistor(part.symbol))
            o.is_mirrored = side_of(p, pins[1]) > 0;
        else if (o.is_horizontal && pins.size() > 1)
            o.is_flipped = side_of(p, pins[0]) > side_of(p, pins[1]);
        else if (pins.size() > 2)
            o.is_mirrored = side_of(p, pins[2]) > 0;
    }
};

}  // namespace

std::vector<std::vector<std::size_t>> parts_of_nets(const Drawing& drawing) {
    std::vector<std::vector<std::size_t>> out(drawing.level.nets.size());
    for (std::size_t p = 0; p < drawing.level.parts.size(); ++p)
        for (const auto& pin : drawing.level.parts[p].pins) {
            auto& parts = out[static_cast<std::size_t>(pin.net)];
            if (connection_of(drawing.level, drawing.styles, pin) == Connection::wire && (parts.empty() || parts.back() != p))
                parts.push_back(p);
        }
    return out;
}

void orient_parts(Drawing& drawing, const std::vector<int>& position, std::vector<Orientation>& orientations) {
    const PartOrienter orienter(drawing, position);
    for (std::size_t p = 0; p < orientations.size(); ++p) orienter.orient(p, orientations[p]);
}

void make_shapes(Drawing& drawing, const std::vector<Orientation>& orientations) {
    drawing.parts.clear();
    for (std::size_t p = 0; p < orientations.size(); ++p)
        drawing.parts.push_back({p, orientations[p], {}, shape_of(drawing.level, drawing.level.parts[p], drawing.styles, orientations[p])});
}

}  // namespace corpuscle::circuit::schematic
