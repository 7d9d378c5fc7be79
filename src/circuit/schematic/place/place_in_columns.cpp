#include "circuit/schematic/place/fold.hpp"
#include "circuit/schematic/place/orient_parts.hpp"
#include "circuit/schematic/place/stacks.hpp"

#include <numeric>

namespace corpuscle::circuit::schematic {
namespace {

constexpr int row_pitch = 110, port_distance = 30;

class ColumnPlacer {
    Drawing& drawing_;
    Stacks stacks_;
    std::vector<std::size_t> order_;  // of the columns, ports excluded
    std::vector<int> position_;       // of the column of each part; -1 for an input port, the number of columns for an output
    std::vector<std::vector<std::size_t>> parts_of_net_;  // those whose pins are joined by wires

    const Part& part(std::size_t k) const { return drawing_.level.parts[k]; }
    bool is_wired(const Pin& pin) const { return connection_of(drawing_.level, drawing_.styles, pin) == Connection::wire; }

    void find_positions() {
        position_.assign(drawing_.level.parts.size(), 0);
        for (std::size_t k = 0; k < order_.size(); ++k)
            for (const auto p : stacks_.columns[order_[k]].parts) position_[p] = static_cast<int>(k);
        parts_of_net_ = parts_of_nets(drawing_);
        for (std::size_t p = 0; p < drawing_.level.parts.size(); ++p)
            if (part(p).symbol == Symbol::port)
                position_[p] = part(p).pins[0].role == PinRole::drive ? -1 : static_cast<int>(order_.size());
    }

    /// The number of wires that may run vertically between a column and the next one.
    int tracks_after(std::size_t k) const {
        std::vector<int> nets;
        const auto count = [&](std::size_t column, bool mirrored) {
            for (const auto p : stacks_.columns[column].parts)
                for (std::size_t i = 0; i < part(p).pins.size(); ++i) {
                    const auto& pin = drawing_.parts[p].shape.pins[i];
                    if (pin.connection != Connection::wire) continue;
                    const bool faces = pin.out == (mirrored ? Direction::right : Direction::left) || pin.out == Direction::up ||
                                       pin.out == Direction::down;
                    if (faces && std::find(nets.begin(), nets.end(), pin.net) == nets.end()) nets.push_back(pin.net);
                }
        };
        if (k < order_.size()) count(order_[k], true);
        if (k + 1 < order_.size()) count(order_[k + 1], false);
        return std::min(static_cast<int>(nets.size()), 8);
    }

    void set_x() {
        int x = 0;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            Box box;
            for (const auto p : stacks_.columns[order_[k]].parts) box.include(drawing_.parts[p].shape.extent);
            const int centre = grid_ceil(x - box.left);
            for (const auto p : stacks_.columns[order_[k]].parts) drawing_.parts[p].at.x = centre;
            x = grid_ceil(centre + box.right) + 10 + 10 * tracks_after(k);
        }
        for (auto& placed : drawing_.parts)
            if (part(placed.part).symbol == Symbol::port) placed.at.x = placed.orientation.is_mirrored ? grid_ceil(x) + 20 : -40;
    }

    void set_y_of_rows() {
        for (const auto& column : stacks_.columns)
            for (std::size_t k = 0; k < column.rows.size(); ++k) drawing_.parts[column.parts[k]].at.y = column.rows[k] * row_pitch;
    }

    /// The coordinate at which a pin of the part is level with the pin that it is joined with in the nearest column.
    int level_with_neighbours(std::size_t p, const std::vector<bool>& has_y) const {
        std::vector<int> candidates;
        for (std::size_t k = 0; k < part(p).pins.size(); ++k) {
            const auto& own = drawing_.parts[p].shape.pins[k];
            if (own.connection != Connection::wire || own.out == Direction::up || own.out == Direction::down) continue;
            int best = -1, y = 0;
            for (const auto other : parts_of_net_[static_cast<std::size_t>(own.net)]) {
                if (other == p || !has_y[other]) continue;
                const int apart = position_[other] - position_[p];
                for (std::size_t i = 0; i < part(other).pins.size(); ++i) {
                    const auto& pin = drawing_.parts[other].shape.pins[i];
                    if (pin.net != own.net || pin.connection != Connection::wire) continue;
                    const bool is_upright = pin.out == Direction::up || pin.out == Direction::down;
                    const int turn = is_upright ? 1 : (pin.out == Direction::left) == (apart > 0) ? 0 : 2;
                    const int merit = 3 * std::abs(apart) + turn;
                    if (best < 0 || merit < best) best = merit, y = drawing_.parts[other].pin(i).y - own.at.y;
                }
            }
            if (best >= 0) candidates.push_back(y);
        }
        if (candidates.empty()) return grid_round((stacks_.row_count - 1) * row_pitch / 2);
        std::sort(candidates.begin(), candidates.end());
        return candidates[candidates.size() / 2];
    }

    void set_free_y() {
        std::vector<bool> has_y(drawing_.level.parts.size());
        for (const auto& column : stacks_.columns)
            for (const auto p : column.parts) has_y[p] = !column.has_free_height();
        for (const auto c : order_) {
            const auto p = stacks_.columns[c].parts.front();
            if (!stacks_.columns[c].has_free_height()) continue;
            drawing_.parts[p].at.y = level_with_neighbours(p, has_y);
            has_y[p] = true;
        }
        for (const bool is_output : {false, true}) place_ports(is_output, has_y);
    }

    /// Ports with wires are level with their nearest pins where they have room; the others are above.
    void place_ports(bool is_output, const std::vector<bool>& has_y) {
        struct PortAt {
            int y;
            std::size_t p;
        };
        std::vector<PortAt> ports, others;
        for (std::size_t p = 0; p < drawing_.level.parts.size(); ++p) {
            if (part(p).symbol != Symbol::port || (part(p).pins[0].role != PinRole::drive) != is_output) continue;
            const bool is_joined = is_wired(part(p).pins[0]) && parts_of_net_[static_cast<std::size_t>(part(p).pins[0].net)].size() > 1;
            (is_joined ? ports : others).push_back({is_joined ? level_with_neighbours(p, has_y) : 0, p});
        }
        std::sort(ports.begin(), ports.end(), [](const PortAt& a, const PortAt& b) { return a.y != b.y ? a.y < b.y : a.p < b.p; });
        int free_from = -row_pitch;
        for (auto& port : ports) {
            drawing_.parts[port.p].at.y = std::max(port.y, free_from);
            free_from = drawing_.parts[port.p].at.y + port_distance;
        }
        int y = std::min(-60, ports.empty() ? 0 : drawing_.parts[ports.front().p].at.y - port_distance);
        for (auto at = others.rbegin(); at != others.rend(); ++at, y -= port_distance) drawing_.parts[at->p].at.y = y;
    }

public:
    explicit ColumnPlacer(Drawing& drawing) : drawing_(drawing), stacks_(find_stacks(drawing.level)) {}
    void run() {
        order_ = order_columns(drawing_, stacks_);
        find_positions();
        orient_parts(drawing_, position_, stacks_.orientations);
        make_shapes(drawing_, stacks_.orientations);
        set_x();
        set_y_of_rows();
        set_free_y();
        std::vector<std::size_t> all(drawing_.parts.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        fold(drawing_, all);
    }
};

}  // namespace

void place_in_columns(Drawing& drawing) { ColumnPlacer(drawing).run(); }

}  // namespace corpuscle::circuit::schematic
