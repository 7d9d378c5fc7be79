#include "circuit/schematic/shape/shape.hpp"

#include "circuit/schematic/shape/block_shape.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr int half_height = 30;  // from the centre of a device to its pins

Direction direction_to(Point p) {
    if (std::abs(p.x) > std::abs(p.y)) return p.x < 0 ? Direction::left : Direction::right;
    return p.y < 0 ? Direction::up : Direction::down;
}

/// The pin of a device before it is turned.
Point device_pin(const Part& part, std::size_t k) {
    if (is_transistor(part.symbol)) {
        if (k == 1) return {-half_height, 0};
        if (k == 3) return {grid_step, 0};
        return {0, (k == 0) == is_p_type(part.symbol) ? half_height : -half_height};
    }
    if (k < 2) return {0, k == 0 ? -half_height : half_height};
    const int others = static_cast<int>(part.pins.size()) - 2, place = static_cast<int>(k) - 2;
    const int offset = others == 2 ? 2 * place * grid_step - grid_step : (place - (others - 1) / 2) * grid_step;
    return {-half_height, offset};
}

void add_device_texts(const Part& part, Orientation o, Shape& shape) {
    std::vector<Text> lines = {{.kind = Text::Kind::name, .at = {}, .text = shortened(part.name)}};
    for (const auto& text : part.texts) lines.push_back({.kind = Text::Kind::value, .at = {}, .text = shortened(text)});
    const bool has_bulk = is_transistor(part.symbol) && part.pins.size() > 3;
    if (!part.type.empty()) lines.push_back({.kind = Text::Kind::type, .at = {}, .text = shortened(part.type)});
    const int count = static_cast<int>(lines.size());
    const int beside = is_transistor(part.symbol) ? 5 : part.symbol == Symbol::note ? 0 : 18;
    for (int k = 0; k < count; ++k) {
        auto& line = lines[static_cast<std::size_t>(k)];
        if (o.is_horizontal)
            line.at = {0, -20 - line_height * (count - 1 - k)}, line.anchor = Text::Anchor::middle;
        else if (has_bulk)  // the bulk's mark is in the middle
            line.at = {beside, k < 2 ? -22 + 11 * k : 16 + 11 * (k - 2)};
        else
            line.at = {beside, text_ascent / 2 - line_height * (count - 1) / 2 + line_height * k};
        if (o.is_mirrored && !o.is_horizontal) line.at.x = -beside, line.anchor = Text::Anchor::end;
        shape.texts.push_back(line);
    }
}

Shape device_shape(const Part& part, Orientation o) {
    Shape shape;
    const auto turn = map_of(o);
    for (std::size_t k = 0; k < part.pins.size(); ++k) {
        const auto at = turn(device_pin(part, k));
        shape.pins.push_back({at, direction_to(at), part.pins[k].net, Connection::wire});
    }
    add_device_texts(part, o, shape);
    const int left = is_transistor(part.symbol) ? -20 : part.has_controlling_pair ? -26 : -16;
    const Point corner = turn({left, -20}), other = turn({is_transistor(part.symbol) ? 2 : 16, 20});
    if (part.symbol == Symbol::note) return shape;
    shape.outline.include(corner), shape.outline.include(other);
    return shape;
}

/// A port: a flag with its name. An input is drawn with its pin at the right, an output (mirrored) at the left.
Shape port_shape(const Part& part, Orientation o) {
    Shape shape;
    const int side = o.is_mirrored ? -1 : 1;
    shape.pins.push_back({{side * grid_step, 0}, side > 0 ? Direction::right : Direction::left, part.pins[0].net, Connection::wire});
    shape.texts.push_back(
        {side > 0 ? Text::Anchor::end : Text::Anchor::start, Text::Kind::net, {-side * 10, 4}, shortened(part.name), part.pins[0].net});
    shape.outline = {-8, -6, 8, 6};
    return shape;
}

Text label_text(const ShapePin& pin, const std::string& name, int distance) {
    const auto p = pin.at;
    switch (pin.out) {
        case Direction::left:
            return {Text::Anchor::end, Text::Kind::net, {p.x - distance, p.y + 3}, name, pin.net};
        case Direction::right:
            return {Text::Anchor::start, Text::Kind::net, {p.x + distance, p.y + 3}, name, pin.net};
        case Direction::up:
            return {Text::Anchor::middle, Text::Kind::net, {p.x, p.y - distance}, name, pin.net};
        default:
            return {Text::Anchor::middle, Text::Kind::net, {p.x, p.y + distance + text_ascent}, name, pin.net};
    }
}

void add_mark(const Level& level, Shape& shape, const ShapePin& pin) {
    if (pin.connection == Connection::wire) return;
    const auto u = unit_of(pin.out);
    if (pin.connection == Connection::ground) {
        Box box;
        box.include(Point{pin.at.x + 8 * u.y, pin.at.y + 8 * u.x}), box.include(Point{pin.at.x - 8 * u.y, pin.at.y - 8 * u.x});
        box.include(Point{pin.at.x + 14 * u.x, pin.at.y + 14 * u.y});
        shape.obstacles.push_back(box);
        return;
    }
    const bool is_bar = pin.connection == Connection::supply;
    auto text = label_text(pin, shortened(level.nets[static_cast<std::size_t>(pin.net)].name), is_bar ? 10 : 4);
    auto box = text.box();
    box.include(pin.at);
    if (is_bar)
        box.include(Point{pin.at.x + 8 * u.y + 8 * u.x, pin.at.y + 8 * u.x + 8 * u.y}),
            box.include(Point{pin.at.x - 8 * u.y + 8 * u.x, pin.at.y - 8 * u.x + 8 * u.y});
    shape.texts.push_back(std::move(text));
    shape.obstacles.push_back(box);
}

void finish(const Level& level, const Part& part, const NetStyles& styles, Shape& shape) {
    for (const auto& text : shape.texts) shape.obstacles.push_back(text.box());
    shape.obstacles.push_back(shape.outline);
    for (std::size_t k = 0; k < shape.pins.size(); ++k) {
        auto& pin = shape.pins[k];
        pin.connection = connection_of(level, styles, part.pins[k]);
        if (is_mos(part.symbol) && k == 3) pin.connection = pin.net == 0 ? Connection::ground : Connection::label;
        if (part.symbol != Symbol::port) add_mark(level, shape, pin);
        shape.extent.include(pin.at);
    }
    for (const auto& box : shape.obstacles) shape.extent.include(box);
}

}  // namespace

PlaneMap map_of(Orientation o) {
    if (o.is_horizontal) return {0, o.is_flipped ? -1 : 1, -1, 0};
    return {o.is_mirrored ? -1 : 1, 0, 0, o.is_flipped ? -1 : 1};
}

int text_width(std::string_view text) {
    int width = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        width += byte < 0x80 ? 6 : byte >= 0xC0 ? 12 : 0;
    }
    return width;
}

std::string shortened(const std::string& text, std::size_t most) {
    std::vector<std::size_t> characters;  // their first bytes
    for (std::size_t k = 0; k < text.size(); ++k)
        if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80) characters.push_back(k);
    if (characters.size() <= most) return text;
    const auto kept = most / 2 - 1;
    return text.substr(0, characters[kept]) + ".." + text.substr(characters[characters.size() - kept]);
}

Box Text::box() const {
    const int width = text_width(text);
    const int left = anchor == Anchor::start ? at.x : anchor == Anchor::end ? at.x - width : at.x - width / 2;
    return {left, at.y - text_ascent, left + width, at.y + text_descent};
}

Connection connection_of(const Level& level, const NetStyles& styles, const Pin& pin) {
    const auto kind = net_of(level, pin).kind;
    if (pin.net == 0) return Connection::ground;
    if (kind != NetKind::signal) return Connection::supply;
    return styles.is_label[static_cast<std::size_t>(pin.net)] ? Connection::label : Connection::wire;
}

Shape shape_of(const Level& level, const Part& part, const NetStyles& styles, Orientation orientation) {
    Shape shape = part.symbol == Symbol::block  ? block_shape(level, part)
                  : part.symbol == Symbol::port ? port_shape(part, orientation)
                                                : device_shape(part, orientation);
    finish(level, part, styles, shape);
    return shape;
}

}  // namespace corpuscle::circuit::schematic
