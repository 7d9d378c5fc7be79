#include "circuit/schematic/route/routing_grid.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr int margin = 60;  // around the parts, for wires that go around all of them
/// The cost of a connection beyond which it is drawn as labels, and the steps of all searches of a drawing. In a large drawing, which is
/// not seen at a glance, labels serve as well as long wires.
struct Effort {
    int cost_limit = 700;
    long step_limit = 2'000'000;
};
Effort effort_for(const Drawing& drawing) {
    constexpr std::size_t large = 120;  // parts
    return drawing.parts.size() <= large ? Effort() : Effort{150, 400'000};
}

class Router {
    Drawing& drawing_;
    std::vector<std::vector<WiredPin>> pins_;
    Effort effort_;
    RoutingGrid grid_;

    static Box area_of(const Drawing& drawing) {
        auto area = drawing.extent;
        area.left -= margin, area.top -= margin, area.right += margin, area.bottom += margin;
        return area;
    }
    Point at(const WiredPin& p) const { return drawing_.parts[p.placed].pin(p.pin); }

    int half_perimeter(std::size_t net) const {
        Box box;
        for (const auto& p : pins_[net]) box.include(at(p));
        return box.right - box.left + box.bottom - box.top;
    }

    static int distance(Point a, Point b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

    bool route(std::size_t net) {
        auto left = pins_[net];
        if (left.size() < 2) return true;
        std::vector<WiredPin> done = {left.front()};
        const int number = static_cast<int>(net);
        grid_.begin_tree(at(left.front()), number);
        left.erase(left.begin());
        while (!left.empty()) {
            std::size_t best = 0;
            int least = -1;
            for (std::size_t k = 0; k < left.size(); ++k)
                for (const auto& d : done)
                    if (const int far = distance(at(left[k]), at(d)); least < 0 || far < least) least = far, best = k;
            if (!grid_.connect(at(left[best]), number, effort_.cost_limit)) return false;
            done.push_back(left[best]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
        }
        return true;
    }

    void block_parts() {
        for (const auto& placed : drawing_.parts)
            for (const auto& box : placed.shape.obstacles) grid_.block(box.shifted(placed.at));
        for (std::size_t net = 0; net < pins_.size(); ++net)
            for (const auto& p : pins_[net]) grid_.add_pin(at(p), static_cast<int>(net));
        // A pin that no wire joins must not be touched either.
        for (const auto& placed : drawing_.parts)
            for (std::size_t k = 0; k < placed.shape.pins.size(); ++k)
                if (placed.shape.pins[k].connection != Connection::wire)
                    grid_.block({placed.pin(k).x, placed.pin(k).y, placed.pin(k).x, placed.pin(k).y});
    }

public:
    explicit Router(Drawing& drawing)
        : drawing_(drawing), pins_(wired_pins(drawing)), effort_(effort_for(drawing)), grid_(area_of(drawing), effort_.step_limit) {}

    std::vector<int> run() {
        block_parts();
        std::vector<std::size_t> order(pins_.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        std::vector<int> lengths(order.size());
        for (const auto k : order) lengths[k] = half_perimeter(k);
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return lengths[a] != lengths[b] ? lengths[a] < lengths[b] : a < b; });
        std::vector<int> failed;
        for (const auto net : order)
            if (!route(net)) failed.push_back(static_cast<int>(net));
        if (!failed.empty()) return failed;
        for (const auto net : order) {  // once more: wires that came later may have taken a better place
            grid_.remove(static_cast<int>(net));
            if (!route(net)) return {static_cast<int>(net)};
        }
        for (std::size_t net = 0; net < pins_.size(); ++net)
            if (pins_[net].size() > 1) grid_.collect(static_cast<int>(net), drawing_.nets[net]);
        return {};
    }
};

}  // namespace

std::vector<std::vector<WiredPin>> wired_pins(const Drawing& drawing) {
    std::vector<std::vector<WiredPin>> out(drawing.level.nets.size());
    for (std::size_t p = 0; p < drawing.parts.size(); ++p) {
        const auto& pins = drawing.parts[p].shape.pins;
        for (std::size_t k = 0; k < pins.size(); ++k)
            if (pins[k].connection == Connection::wire) out[static_cast<std::size_t>(pins[k].net)].push_back({p, k});
    }
    return out;
}

std::vector<int> route_wires(Drawing& drawing) {
    drawing.nets.assign(drawing.level.nets.size(), {});
    return Router(drawing).run();
}

}  // namespace corpuscle::circuit::schematic
