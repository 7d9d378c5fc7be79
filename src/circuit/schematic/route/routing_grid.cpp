#include "circuit/schematic/route/routing_grid.hpp"

#include <queue>

namespace corpuscle::circuit::schematic {
namespace {

constexpr int step_cost = 2, bend_cost = 5, crossing_cost = 9;
constexpr int right = 0, down = 1, left = 2, up = 3;  // directions; the opposite one is 2 further

int opposite(int direction) { return direction ^ 2; }

}  // namespace

RoutingGrid::RoutingGrid(const Box& extent, long step_limit)
    : corner_{grid_floor(extent.left), grid_floor(extent.top)}, width_((grid_ceil(extent.right) - corner_.x) / grid_step + 1),
      height_((grid_ceil(extent.bottom) - corner_.y) / grid_step + 1), steps_left_(step_limit) {
    const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    blocked_.resize(count), pin_net_.resize(count, none), edge_right_.resize(count, none), edge_down_.resize(count, none);
    tree_.resize(count, none), cost_.resize(4 * count), origin_.resize(4 * count), stamp_.resize(4 * count);
}

void RoutingGrid::block(const Box& box) {
    if (box.is_empty()) return;
    constexpr int beside = 5, above = 2;  // free space around a box; a text has some above and below its letters
    const int x0 = std::max(grid_ceil(box.left - beside), corner_.x), y0 = std::max(grid_ceil(box.top - above), corner_.y);
    for (int y = y0; y <= std::min(box.bottom + above, corner_.y + (height_ - 1) * grid_step); y += grid_step)
        for (int x = x0; x <= std::min(box.right + beside, corner_.x + (width_ - 1) * grid_step); x += grid_step)
            blocked_[vertex({x, y})] = 1;
}

void RoutingGrid::add_to_tree(std::size_t v, int net) {
    if (tree_[v] == net) return;
    if (trees_.size() <= static_cast<std::size_t>(net)) trees_.resize(static_cast<std::size_t>(net) + 1);
    tree_[v] = net, trees_[static_cast<std::size_t>(net)].push_back(v);
}

void RoutingGrid::add_pin(Point p, int net) { pin_net_[vertex(p)] = net; }

bool RoutingGrid::has_neighbour(std::size_t v, int direction) const {
    const auto w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(height_);
    return direction == right ? v % w + 1 < w : direction == left ? v % w > 0 : direction == down ? v / w + 1 < h : v / w > 0;
}

std::size_t RoutingGrid::neighbour(std::size_t v, int direction) const {
    const auto w = static_cast<std::size_t>(width_);
    return direction == right ? v + 1 : direction == left ? v - 1 : direction == down ? v + w : v - w;
}

int RoutingGrid::edge(std::size_t v, int direction) const {
    if (!has_neighbour(v, direction)) return none;
    return direction == right  ? edge_right_[v]
           : direction == left ? edge_right_[v - 1]
           : direction == down ? edge_down_[v]
                               : edge_down_[v - static_cast<std::size_t>(width_)];
}

void RoutingGrid::set_edge(std::size_t v, int direction, int net) {
    if (direction == left || direction == up) v = neighbour(v, direction), direction = opposite(direction);
    (direction == right ? edge_right_ : edge_down_)[v] = net;
}

bool RoutingGrid::is_crossed(std::size_t v, int net) const {
    for (int d = 0; d < 4; ++d)
        if (const int owner = edge(v, d); owner != none && owner != net) return true;
    return false;
}

std::optional<int> RoutingGrid::arrival_cost(std::size_t v, int direction, int net, bool& must_go_straight) const {
    must_go_straight = false;
    if ((pin_net_[v] != none && pin_net_[v] != net) || (blocked_[v] != 0 && pin_net_[v] != net)) return {};
    const int side = direction == right || direction == left ? down : right;
    const int a = edge(v, side), b = edge(v, opposite(side)), ahead = edge(v, direction);
    if (ahead != none && ahead != net) return {};
    const bool is_other = (a != none && a != net) || (b != none && b != net);
    if (!is_other) return 0;
    if (a != b || pin_net_[v] == net || tree_[v] == net) return {};
    must_go_straight = true;
    return crossing_cost;
}

std::optional<int> RoutingGrid::connect(Point pin, int net, int most) {
    const auto start = vertex(pin);
    if (tree_[start] == net) return 0;
    ++search_;
    Box goal;
    for (const auto v : trees_[static_cast<std::size_t>(net)]) goal.include(point(v));
    const auto distance = [&](std::size_t v) {
        const auto p = point(v);
        return (std::max({goal.left - p.x, p.x - goal.right, 0}) + std::max({goal.top - p.y, p.y - goal.bottom, 0})) / grid_step *
               step_cost;
    };
    using Entry = std::pair<int, std::size_t>;  // estimate of the complete cost, state
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto visit = [&](std::size_t v, int direction, int cost, int origin) {
        const auto state = 4 * v + static_cast<std::size_t>(direction);
        if (stamp_[state] == search_ && cost_[state] <= cost) return;
        stamp_[state] = search_, cost_[state] = cost, origin_[state] = origin;
        if (cost + distance(v) <= most) open.emplace(cost + distance(v), state);
    };
    const auto expand = [&](std::size_t v, int direction, int cost, int origin) {
        bool must_go_straight = false;
        if (!has_neighbour(v, direction)) return;
        const auto next = neighbour(v, direction);
        if (edge(v, direction) != none) return;
        if (const auto extra = arrival_cost(next, direction, net, must_go_straight))
            visit(next, direction, cost + step_cost + *extra, origin);
    };
    for (int d = 0; d < 4; ++d) expand(start, d, 0, -1);
    while (!open.empty() && steps_left_ > 0) {
        const auto [estimate, state] = open.top();
        open.pop(), --steps_left_;
        const auto v = state / 4;
        const int came = static_cast<int>(state % 4), cost = cost_[state];
        if (estimate > cost + distance(v)) continue;  // a cheaper path was found later
        if (tree_[v] == net) return mark_path(state, start, net), cost;
        const bool is_straight = is_crossed(v, net);
        for (int d = 0; d < 4; ++d)
            if (d != opposite(came) && (!is_straight || d == came))
                expand(v, d, cost + (d == came ? 0 : bend_cost), static_cast<int>(state));
    }
    return {};
}

void RoutingGrid::mark_path(std::size_t state, std::size_t start, int net) {
    while (true) {
        const auto v = state / 4;
        const int came = static_cast<int>(state % 4), origin = origin_[state];
        add_to_tree(v, net);
        set_edge(v, opposite(came), net);
        if (origin < 0) break;
        state = static_cast<std::size_t>(origin);
    }
    add_to_tree(start, net);
}

void RoutingGrid::remove(int net) {
    if (trees_.size() <= static_cast<std::size_t>(net)) return;
    for (const auto v : trees_[static_cast<std::size_t>(net)]) {
        tree_[v] = none;
        for (int d = 0; d < 4; ++d)
            if (edge(v, d) == net) set_edge(v, d, none);
    }
    trees_[static_cast<std::size_t>(net)].clear();
}

void RoutingGrid::collect(int net, DrawnNet& out) {
    auto& vertices = trees_[static_cast<std::size_t>(net)];
    std::sort(vertices.begin(), vertices.end());
    for (const auto v : vertices) {
        for (const int d : {right, down}) {
            if (edge(v, d) != net || edge(v, opposite(d)) == net) continue;
            auto end = v;
            while (edge(end, d) == net) end = neighbour(end, d);
            out.wires.push_back({point(v), point(end)});
        }
        int meeting = pin_net_[v] == net ? 1 : 0;
        for (int d = 0; d < 4; ++d) meeting += edge(v, d) == net ? 1 : 0;
        if (meeting >= 3) out.junctions.push_back(point(v));
    }
}

}  // namespace corpuscle::circuit::schematic
