#include "circuit/schematic/draw_level.hpp"

#include "circuit/schematic/level/level_nets.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr std::size_t most_wired_pins = 24;  // of a net; one with more is drawn as labels

void add_port_parts(Level& level) {
    for (std::size_t k = 0; k < level.ports.size(); ++k) {
        const auto& net = level.nets[static_cast<std::size_t>(level.ports[k])];
        Part part;
        part.symbol = Symbol::port, part.name = net.name, part.path = net.path;
        part.pins.push_back({level.ports[k], level.port_roles[k] == PinRole::drive ? PinRole::sense : PinRole::drive});
        level.parts.push_back(std::move(part));
    }
}

/// Nets that are labels in every drawing: those that mainly bulks use, those with a single pin, and those with very many.
NetStyles first_styles(const Level& level) {
    struct Count {
        std::size_t ports = 0, bulks = 0, drivers = 0, others = 0;
    };
    std::vector<Count> counts(level.nets.size());
    for (const auto& part : level.parts)
        for (const auto& pin : part.pins) {
            auto& count = counts[static_cast<std::size_t>(pin.net)];
            ++(part.symbol == Symbol::port  ? count.ports
               : pin.role == PinRole::bulk  ? count.bulks
               : pin.role == PinRole::drive ? count.drivers
                                            : count.others);
        }
    NetStyles out{std::vector<bool>(level.nets.size())};
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const auto& c = counts[k];
        const auto joined = c.drivers + c.others;
        out.is_label[k] = joined + c.ports + c.bulks > most_wired_pins || joined + c.ports < 2 ||
                          (c.bulks > 0 && c.others == 0 && joined < 2) || c.bulks >= 3;
    }
    return out;
}

bool has_transistors(const Level& level) {
    return std::any_of(level.parts.begin(), level.parts.end(), [](const Part& part) { return is_transistor(part.symbol); });
}

void update_extent(Drawing& drawing) {
    drawing.extent = {};
    for (const auto& placed : drawing.parts) drawing.extent.include(placed.shape.extent.shifted(placed.at));
    if (drawing.extent.is_empty()) drawing.extent = {0, 0, 100, 20};
}

}  // namespace

Drawing draw_level(Level level) {
    Drawing drawing;
    add_port_parts(level);
    drawing.styles = first_styles(level);
    drawing.level = std::move(level);
    const int tries = drawing.level.parts.size() <= 120 ? 6 : 3;
    for (int k = 0; k <= tries; ++k) {
        if (k == tries) drawing.styles.is_label.assign(drawing.level.nets.size(), true);  // without wires, nothing can fail
        has_transistors(drawing.level) ? place_in_columns(drawing) : place_in_layers(drawing);
        update_extent(drawing);
        auto failed = route_wires(drawing);
        if (failed.empty()) failed = place_net_names(drawing);
        if (failed.empty()) break;
        for (const int net : failed) drawing.styles.is_label[static_cast<std::size_t>(net)] = true;
    }
    return drawing;
}

}  // namespace corpuscle::circuit::schematic
