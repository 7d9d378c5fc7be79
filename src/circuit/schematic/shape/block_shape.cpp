#include "circuit/schematic/shape/block_shape.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr int lead = 10;  // from the rectangle to a pin

std::vector<std::size_t> pins_at(const Part& part, Direction side) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < part.pins.size(); ++k)
        if (part.pins[k].side == side) out.push_back(k);
    return out;
}

int widest_name(const Part& part, const std::vector<std::size_t>& pins) {
    int width = 0;
    for (const auto k : pins) width = std::max(width, text_width(shortened(part.pins[k].name)));
    return width;
}

/// The distance of pins above or below: room for the names of their ports and nets.
int distance_of(const Level& level, const Part& part, const std::vector<std::size_t>& pins) {
    int width = 20;
    for (const auto k : pins)
        width = std::max({width, text_width(shortened(part.pins[k].name)), text_width(shortened(net_of(level, part.pins[k]).name))});
    return grid_ceil(width + 8);
}

struct Sides {
    std::vector<std::size_t> left, right, up, down;
    int distance_up, distance_down;
};

Box rectangle_of(const Part& part, const Sides& sides) {
    const int rows = static_cast<int>(std::max({sides.left.size(), sides.right.size(), std::size_t{2}}));
    const int height = block_pin_distance * (rows + (sides.up.empty() ? 0 : 1) + (sides.down.empty() ? 0 : 1));
    const int centre = std::max(text_width(shortened(part.name)), text_width(shortened(part.type)));
    int width = centre + widest_name(part, sides.left) + widest_name(part, sides.right) + 28;
    width = std::max(width, sides.distance_up * static_cast<int>(sides.up.size()) + 10);
    width = std::max(width, sides.distance_down * static_cast<int>(sides.down.size()) + 10);
    width = std::max(2 * grid_ceil((width + 1) / 2), 80);
    const int top = -grid_floor(height / 2);
    return {-width / 2, top, width / 2, top + height};
}

void add_pin(const Part& part, Shape& shape, std::size_t k, Point edge, Direction side) {
    const auto u = unit_of(side);
    shape.pins[k] = {{edge.x + lead * u.x, edge.y + lead * u.y}, side, part.pins[k].net, Connection::wire};
    Text text{Text::Anchor::middle, Text::Kind::pin, edge, shortened(part.pins[k].name)};
    if (side == Direction::left) text.anchor = Text::Anchor::start, text.at = {edge.x + 4, edge.y + 3};
    if (side == Direction::right) text.anchor = Text::Anchor::end, text.at = {edge.x - 4, edge.y + 3};
    if (side == Direction::up) text.at.y += text_ascent + 3;
    if (side == Direction::down) text.at.y -= text_descent + 2;
    shape.texts.push_back(std::move(text));
}

void add_row_above_or_below(const Part& part, Shape& shape, const std::vector<std::size_t>& pins, int distance, int y, Direction side) {
    const int count = static_cast<int>(pins.size());
    for (int k = 0; k < count; ++k)
        add_pin(part, shape, pins[static_cast<std::size_t>(k)], {grid_floor(distance * (2 * k - count + 1) / 2), y}, side);
}

}  // namespace

void set_usual_sides(const Level& level, Part& block) {
    for (auto& pin : block.pins) {
        const auto kind = net_of(level, pin).kind;
        if (pin.role == PinRole::supply || pin.role == PinRole::bulk)
            pin.side = Direction::up;
        else if (pin.role == PinRole::ground || kind == NetKind::ground)
            pin.side = Direction::down;
        else if (kind == NetKind::supply)
            pin.side = Direction::up;
        else
            pin.side = pin.role == PinRole::drive ? Direction::right : Direction::left;
    }
}

Shape block_shape(const Level& level, const Part& part) {
    Sides sides{pins_at(part, Direction::left),
                pins_at(part, Direction::right),
                pins_at(part, Direction::up),
                pins_at(part, Direction::down),
                0,
                0};
    sides.distance_up = distance_of(level, part, sides.up), sides.distance_down = distance_of(level, part, sides.down);
    Shape shape;
    shape.outline = rectangle_of(part, sides);
    shape.pins.resize(part.pins.size());
    const auto& box = shape.outline;
    const int first = box.top + (sides.up.empty() ? 10 : 30);
    for (std::size_t k = 0; k < sides.left.size(); ++k)
        add_pin(part, shape, sides.left[k], {box.left, first + block_pin_distance * static_cast<int>(k)}, Direction::left);
    for (std::size_t k = 0; k < sides.right.size(); ++k)
        add_pin(part, shape, sides.right[k], {box.right, first + block_pin_distance * static_cast<int>(k)}, Direction::right);
    add_row_above_or_below(part, shape, sides.up, sides.distance_up, box.top, Direction::up);
    add_row_above_or_below(part, shape, sides.down, sides.distance_down, box.bottom, Direction::down);
    const int centre = box.left + (box.right - box.left) / 2 + (widest_name(part, sides.left) - widest_name(part, sides.right)) / 2;
    const int middle = (first - 10 + box.bottom - (sides.down.empty() ? 0 : 20)) / 2;
    shape.texts.push_back({Text::Anchor::middle, Text::Kind::name, {centre, middle - 1}, shortened(part.name)});
    shape.texts.push_back({Text::Anchor::middle, Text::Kind::type, {centre, middle + line_height - 1}, shortened(part.type)});
    return shape;
}

}  // namespace corpuscle::circuit::schematic
