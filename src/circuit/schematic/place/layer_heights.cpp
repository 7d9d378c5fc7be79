#include "circuit/schematic/place/layers.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr int part_distance = 30, wire_distance = 20;

/// A part, or a wire that passes a layer.
struct Node {
    int placed = -1;  // index in Drawing::parts; -1: a wire
    int y = 0;
    std::vector<std::pair<int, int>> pins;  // net, y relative to the node
    Box extent;
};

class HeightFinder {
    Drawing& drawing_;
    std::vector<std::vector<Node>> layers_;

    void add_parts(const std::vector<std::vector<std::size_t>>& layers) {
        for (const auto& layer : layers) {
            layers_.emplace_back();
            for (const auto p : layer) {
                const auto& shape = drawing_.parts[p].shape;
                Node node{static_cast<int>(p), 0, {}, shape.extent};
                for (const auto& pin : shape.pins)
                    if (pin.connection == Connection::wire) node.pins.emplace_back(pin.net, pin.at.y);
                node.y = static_cast<int>(layers_.back().size()) * 100;
                layers_.back().push_back(std::move(node));
            }
        }
    }
    static bool has_net(const std::vector<Node>& layer, int net) {
        for (const auto& node : layer)
            for (const auto& pin : node.pins)
                if (pin.first == net) return true;
        return false;
    }
    /// A net that passes layers gets a place in each of them.
    void add_passing_wires() {
        std::vector<std::pair<int, int>> spans(drawing_.level.nets.size(), {1 << 20, -1});
        for (std::size_t k = 0; k < layers_.size(); ++k)
            for (const auto& node : layers_[k])
                for (const auto& pin : node.pins) {
                    auto& span = spans[static_cast<std::size_t>(pin.first)];
                    span = {std::min(span.first, static_cast<int>(k)), std::max(span.second, static_cast<int>(k))};
                }
        for (std::size_t net = 0; net < spans.size(); ++net)
            for (int k = spans[net].first + 1; k < spans[net].second; ++k) {
                auto& layer = layers_[static_cast<std::size_t>(k)];
                if (has_net(layer, static_cast<int>(net))) continue;
                layer.push_back({-1, static_cast<int>(layer.size()) * 100, {{static_cast<int>(net), 0}}, {0, -1, 0, 1}});
            }
    }

    /// The y at which the wires to neighbouring layers would be straight; `fallback` if there are none.
    static int wanted_height(const Node& node, const std::vector<const std::vector<Node>*>& neighbours, int fallback) {
        std::vector<int> wanted;
        for (const auto* layer : neighbours)
            for (const auto& other : *layer)
                for (const auto& theirs : other.pins)
                    for (const auto& own : node.pins)
                        if (&other != &node && own.first == theirs.first) wanted.push_back(other.y + theirs.second - own.second);
        if (wanted.empty()) return fallback;
        std::sort(wanted.begin(), wanted.end());
        return wanted[(wanted.size() - 1) / 2];
    }

    static int distance(const Node& upper, const Node& lower) {
        const int free = upper.placed < 0 || lower.placed < 0 ? wire_distance : part_distance;
        return grid_ceil(upper.extent.bottom - lower.extent.top + free);
    }

    /// Gives the nodes of a layer, in their order, heights near the wanted ones: isotonic regression of the medians.
    static void set_layer(std::vector<Node>& layer, const std::vector<int>& wanted) {
        struct Block {
            std::vector<int> values;
            std::size_t count;
            int median() const { return values[(values.size() - 1) / 2]; }
        };
        std::vector<int> offset(layer.size());
        for (std::size_t k = 1; k < layer.size(); ++k) offset[k] = offset[k - 1] + distance(layer[k - 1], layer[k]);
        std::vector<Block> blocks;
        for (std::size_t k = 0; k < layer.size(); ++k) {
            blocks.push_back({{wanted[k] - offset[k]}, 1});
            while (blocks.size() > 1 && blocks[blocks.size() - 2].median() > blocks.back().median()) {
                auto last = std::move(blocks.back());
                blocks.pop_back();
                auto& merged = blocks.back();
                merged.values.insert(merged.values.end(), last.values.begin(), last.values.end());
                std::sort(merged.values.begin(), merged.values.end());
                merged.count += last.count;
            }
        }
        std::size_t k = 0;
        for (const auto& block : blocks)
            for (std::size_t i = 0; i < block.count; ++i, ++k) layer[k].y = grid_round(block.median()) + offset[k];
    }

    void adjust(std::size_t k, bool from_left, bool from_right, bool can_reorder) {
        std::vector<const std::vector<Node>*> neighbours;
        if (from_left && k > 0) neighbours.push_back(&layers_[k - 1]);
        if (from_right && k + 1 < layers_.size()) neighbours.push_back(&layers_[k + 1]);
        auto& layer = layers_[k];
        std::vector<std::pair<int, std::size_t>> order;
        for (std::size_t i = 0; i < layer.size(); ++i) {
            const int beside = neighbours.empty() || !from_left || !from_right ? layer[i].y : wanted_height(layer[i], {&layer}, layer[i].y);
            order.emplace_back(wanted_height(layer[i], neighbours, beside), i);
        }
        if (can_reorder) std::sort(order.begin(), order.end());
        std::vector<Node> sorted;
        std::vector<int> wanted;
        for (const auto& [y, i] : order) sorted.push_back(std::move(layer[i])), wanted.push_back(y);
        layer = std::move(sorted);
        set_layer(layer, wanted);
    }

public:
    HeightFinder(Drawing& drawing, const std::vector<std::vector<std::size_t>>& layers) : drawing_(drawing) {
        add_parts(layers);
        add_passing_wires();
    }
    void run() {
        constexpr int sweeps = 8;
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            const bool can_reorder = sweep < sweeps - 2;
            for (std::size_t k = 0; k < layers_.size(); ++k) adjust(k, true, false, can_reorder);
            for (std::size_t k = layers_.size(); k-- > 0;) adjust(k, false, true, can_reorder);
        }
        for (std::size_t k = 0; k < layers_.size(); ++k) adjust(k, true, true, false);
        for (const auto& layer : layers_)
            for (const auto& node : layer)
                if (node.placed >= 0) drawing_.parts[static_cast<std::size_t>(node.placed)].at.y = node.y;
    }
};

}  // namespace

void set_heights(Drawing& drawing, const std::vector<std::vector<std::size_t>>& layers) { HeightFinder(drawing, layers).run(); }

}  // namespace corpuscle::circuit::schematic
