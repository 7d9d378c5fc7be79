#include "circuit/schematic/place/fold.hpp"
#include "circuit/schematic/place/layers.hpp"
#include "circuit/schematic/place/orient_parts.hpp"
#include "circuit/schematic/place/stacks.hpp"

#include <cmath>

namespace corpuscle::circuit::schematic {
namespace {

constexpr int group_distance = 50;

/// Places each group of parts that wires join, the largest first, then the groups beside and below each other.
class LayerPlacer {
    Drawing& drawing_;
    std::vector<std::vector<std::size_t>> groups_;
    std::vector<std::vector<std::vector<std::size_t>>> layers_;  // of each group

    void find_groups() {
        const auto parts_of_net = parts_of_nets(drawing_);
        std::vector<int> group(drawing_.level.parts.size(), -1);
        for (std::size_t first = 0; first < group.size(); ++first) {
            if (group[first] >= 0) continue;
            const int number = static_cast<int>(groups_.size());
            std::vector<std::size_t> members = {first};
            group[first] = number;
            for (std::size_t k = 0; k < members.size(); ++k)
                for (const auto& pin : drawing_.level.parts[members[k]].pins)
                    for (const auto other : parts_of_net[static_cast<std::size_t>(pin.net)])
                        if (group[other] < 0 && connection_of(drawing_.level, drawing_.styles, pin) == Connection::wire)
                            group[other] = number, members.push_back(other);
            std::sort(members.begin(), members.end());
            groups_.push_back(std::move(members));
        }
        std::sort(groups_.begin(), groups_.end(),
                  [](const auto& a, const auto& b) { return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front(); });
    }

    void orient() {
        std::vector<int> position(drawing_.level.parts.size(), 0);
        for (const auto& group : groups_) {
            const auto layer = find_layers(drawing_, group);
            layers_.emplace_back();
            for (const auto p : group) {
                position[p] = layer[p];
                layers_.back().resize(std::max(layers_.back().size(), static_cast<std::size_t>(layer[p]) + 1));
                layers_.back()[static_cast<std::size_t>(layer[p])].push_back(p);
            }
        }
        auto orientations = find_stacks(drawing_.level).orientations;
        orient_parts(drawing_, position, orientations);
        make_shapes(drawing_, orientations);
    }

    /// The number of wires between a layer and the next one.
    int tracks_after(const std::vector<std::vector<std::size_t>>& layers, std::size_t k) const {
        std::vector<int> nets;
        for (const auto side : {k, k + 1}) {
            if (side >= layers.size()) continue;
            for (const auto p : layers[side])
                for (const auto& pin : drawing_.parts[p].shape.pins)
                    if (pin.connection == Connection::wire && (pin.out != (side == k ? Direction::left : Direction::right)) &&
                        std::find(nets.begin(), nets.end(), pin.net) == nets.end())
                        nets.push_back(pin.net);
        }
        return std::min(static_cast<int>(nets.size()), 10);
    }

    void place(const std::vector<std::vector<std::size_t>>& layers) {
        set_heights(drawing_, layers);
        int x = 0;
        for (std::size_t k = 0; k < layers.size(); ++k) {
            Box box;
            for (const auto p : layers[k]) box.include(drawing_.parts[p].shape.extent);
            const int centre = grid_ceil(x - box.left);
            for (const auto p : layers[k]) drawing_.parts[p].at.x = centre;
            x = grid_ceil(centre + box.right) + 10 + 10 * tracks_after(layers, k);
        }
    }
    void shift(const std::vector<std::size_t>& group, Point by) {
        for (const auto p : group) drawing_.parts[p].at = drawing_.parts[p].at + by;
    }

public:
    explicit LayerPlacer(Drawing& drawing) : drawing_(drawing) {}
    void run() {
        find_groups();
        orient();
        std::vector<Box> boxes;
        for (std::size_t k = 0; k < groups_.size(); ++k) place(layers_[k]), boxes.push_back(fold(drawing_, groups_[k]));
        const int width = width_of_shelves(boxes);
        int x = 0, y = 0, shelf = 0;
        for (std::size_t k = 0; k < groups_.size(); ++k) {
            const auto& box = boxes[k];
            const bool is_second = k == 1;  // the largest group has a shelf of its own
            if (is_second || (k > 0 && x + (box.right - box.left) > width)) x = 0, y += shelf + group_distance, shelf = 0;
            shift(groups_[k], {grid_ceil(x - box.left), grid_ceil(y - box.top)});
            shelf = std::max(shelf, box.bottom - box.top);
            x += box.right - box.left + group_distance;
        }
    }

private:
    /// At least the width of the largest group. With many groups, the picture becomes about twice as wide as high.
    static int width_of_shelves(const std::vector<Box>& boxes) {
        constexpr int least = 600;
        double area = 0;
        for (const auto& box : boxes)
            area += static_cast<double>(box.right - box.left + group_distance) * (box.bottom - box.top + group_distance);
        const int largest = boxes.empty() ? 0 : boxes.front().right - boxes.front().left;
        return std::max({least, largest, static_cast<int>(std::sqrt(2 * area))});
    }
};

}  // namespace

void place_in_layers(Drawing& drawing) { LayerPlacer(drawing).run(); }

}  // namespace corpuscle::circuit::schematic
