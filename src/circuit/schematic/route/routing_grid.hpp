#pragma once
// The grid on which wires run, and the search for the cheapest path of a wire. Used inside circuit/schematic only.

#include <cstdint>
#include <optional>

#include "circuit/schematic/drawing.hpp"

namespace corpuscle::circuit::schematic {

class RoutingGrid {
    static constexpr int none = -1;
    Point corner_;
    int width_, height_;                                 // in grid steps
    std::vector<std::uint8_t> blocked_;                  // by a part, for each vertex
    std::vector<int> pin_net_, edge_right_, edge_down_;  // nets; none if there is none
    std::vector<int> tree_;                              // the net whose wire or first pin is at the vertex
    std::vector<std::vector<std::size_t>> trees_;        // the vertices of each net in tree_
    std::vector<int> cost_, origin_;                     // of the search, for each vertex and direction
    std::vector<std::uint32_t> stamp_;
    std::uint32_t search_ = 0;
    long steps_left_;

public:
    RoutingGrid(const Box& extent, long step_limit);

    void block(const Box&);
    void add_pin(Point, int net);
    /// Begins the wires of a net with a pin.
    void begin_tree(Point pin, int net) { add_to_tree(vertex(pin), net); }
    /// Connects a pin with the wires of its net by the cheapest path: short, with few bends and crossings. Returns its cost; nothing if
    /// there is no path that costs at most `most`.
    std::optional<int> connect(Point pin, int net, int most);
    /// Removes the wires of a net.
    void remove(int net);
    /// The wires of a net as maximal segments, and the points where three or more of them meet.
    void collect(int net, DrawnNet&);

private:
    std::size_t vertex(Point p) const {
        return static_cast<std::size_t>((p.y - corner_.y) / grid_step) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>((p.x - corner_.x) / grid_step);
    }
    Point point(std::size_t v) const {
        const auto w = static_cast<std::size_t>(width_);
        return {corner_.x + static_cast<int>(v % w) * grid_step, corner_.y + static_cast<int>(v / w) * grid_step};
    }
    void add_to_tree(std::size_t v, int net);
    bool has_neighbour(std::size_t v, int direction) const;
    std::size_t neighbour(std::size_t v, int direction) const;
    int edge(std::size_t v, int direction) const;
    void set_edge(std::size_t v, int direction, int net);
    /// The cost of arriving at a vertex; nothing if the net may not go there.
    std::optional<int> arrival_cost(std::size_t v, int direction, int net, bool& must_go_straight) const;
    bool is_crossed(std::size_t v, int net) const;
    void mark_path(std::size_t state, std::size_t start, int net);
};

}  // namespace corpuscle::circuit::schematic
