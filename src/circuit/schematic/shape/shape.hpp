#pragma once
// The shape of a part: its outline, pins, texts and marks, in coordinates relative to its centre.

#include "circuit/schematic/level/level_nets.hpp"
#include "circuit/schematic/shape/geometry.hpp"

namespace corpuscle::circuit::schematic {

/// How a pin is connected.
enum class Connection {
    wire,    ///< by the router
    ground,  ///< by a ground symbol at the pin
    supply,  ///< by a bar with the name of the supply
    label    ///< by the name of the net at the pin
};

struct ShapePin {
    Point at;
    Direction out = Direction::left;
    int net = 0;
    Connection connection = Connection::wire;
};

struct Text {
    enum class Anchor { start, middle, end } anchor = Anchor::start;
    enum class Kind { name, type, value, pin, net } kind = Kind::value;
    Point at;  ///< left, middle or right end of the base line
    std::string text;
    int net = -1;  ///< of a label
    Box box() const;
};

/// How a part lies.
struct Orientation {
    bool is_mirrored = false;    ///< the gate, or the text of a device with two ends, is at the other side
    bool is_flipped = false;     ///< the first end, or the usual upper end of a transistor, is below
    bool is_horizontal = false;  ///< a device with two ends lies
};

/// The linear map from an upright part to one that lies as `Orientation` says: x' = xx x + xy y, y' = yx x + yy y.
struct PlaneMap {
    int xx = 1, xy = 0, yx = 0, yy = 1;
    Point operator()(Point p) const { return {xx * p.x + xy * p.y, yx * p.x + yy * p.y}; }
};
/// The controlling pins of a lying device are below it, because its texts are above.
PlaneMap map_of(Orientation);

struct Shape {
    std::vector<ShapePin> pins;  ///< as in the part
    std::vector<Text> texts;
    std::vector<Box> obstacles;  ///< no wire may cross these: the symbol, its texts, the marks at its pins
    Box outline;                 ///< of the symbol without texts
    Box extent;                  ///< of all
};

/// The connection of each net of a level, as decided so far; an entry per net.
struct NetStyles {
    std::vector<bool> is_label;
};

Connection connection_of(const Level&, const NetStyles&, const Pin&);
Shape shape_of(const Level&, const Part&, const NetStyles&, Orientation);

inline constexpr int text_size = 10, text_ascent = 8, text_descent = 3, line_height = 12;
/// The width of a text: 0.6 of its size for each letter of a monospaced font, twice that for a character outside ASCII.
int text_width(std::string_view);
/// The text without its middle if it is longer than a name beside a symbol can be.
std::string shortened(const std::string& text, std::size_t most = 24);

inline constexpr int block_pin_distance = 20;

}  // namespace corpuscle::circuit::schematic
