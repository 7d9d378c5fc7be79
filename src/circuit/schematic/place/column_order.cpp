#include "circuit/schematic/place/stacks.hpp"

namespace corpuscle::circuit::schematic {
namespace {

/// Moves columns so that wires become short and signals run from left to right.
class ColumnOrder {
    struct NetColumns {
        std::vector<std::size_t> all, drivers, inputs, sensing;  // columns
        bool enters = false, leaves = false;                     // as an input or output port
    };
    std::vector<NetColumns> nets_;
    std::vector<std::vector<std::size_t>> nets_of_column_;
    std::vector<std::size_t> order_;
    std::vector<int> position_;

    static void add_once(std::vector<std::size_t>& to, std::size_t value) {
        if (std::find(to.begin(), to.end(), value) == to.end()) to.push_back(value);
    }

    double cost_of(const NetColumns& net) const {
        int low = 1 << 20, high = -1;
        for (const auto c : net.all) low = std::min(low, position_[c]), high = std::max(high, position_[c]);
        double cost = high - low;
        for (const auto d : net.drivers)
            for (const auto s : net.sensing)
                if (position_[s] < position_[d]) cost += (position_[d] - position_[s]) / static_cast<double>(net.drivers.size());
        if (net.enters) cost += 0.5 * low + 0.1 * high;
        if (net.leaves) cost += 0.5 * (static_cast<double>(order_.size()) - 1 - high);
        return cost;
    }
    double cost() const {
        double sum = 0;
        for (const auto& net : nets_)
            if (!net.all.empty()) sum += cost_of(net);
        return sum;
    }
    void update_positions(std::size_t from, std::size_t to) {
        for (auto k = from; k <= to; ++k) position_[order_[k]] = static_cast<int>(k);
    }
    void move(std::size_t from, std::size_t to) {
        const auto column = order_[from];
        order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(from));
        order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(to), column);
        update_positions(std::min(from, to), std::max(from, to));
    }

public:
    ColumnOrder(const Drawing& drawing, const Stacks& stacks) : nets_(drawing.level.nets.size()), nets_of_column_(stacks.columns.size()) {
        for (std::size_t c = 0; c < stacks.columns.size(); ++c) {
            const auto& first = drawing.level.parts[stacks.columns[c].parts.front()];
            if (first.symbol == Symbol::port) {
                const auto net = static_cast<std::size_t>(first.pins[0].net);
                (first.pins[0].role == PinRole::drive ? nets_[net].enters : nets_[net].leaves) = true;
                continue;
            }
            order_.push_back(c);
            for (const auto p : stacks.columns[c].parts)
                for (const auto& pin : drawing.level.parts[p].pins) {
                    const auto net = static_cast<std::size_t>(pin.net);
                    if (connection_of(drawing.level, drawing.styles, pin) != Connection::wire) continue;
                    add_once(nets_[net].all, c);
                    add_once(nets_of_column_[c], net);
                    if (pin.role == PinRole::drive) add_once(nets_[net].drivers, c);
                    if (pin.role == PinRole::input) add_once(nets_[net].inputs, c);
                    if (pin.role == PinRole::sense) add_once(nets_[net].sensing, c);
                }
        }
        for (auto& net : nets_) {  // the diode of a mirror sets the voltage of the gates, and another device may feed the diode
            auto& to = net.drivers.empty() ? net.drivers : net.sensing;
            for (const auto c : net.inputs) add_once(to, c);
        }
        position_.resize(stacks.columns.size());
    }

    std::vector<std::size_t> run() {
        if (order_.empty()) return order_;
        update_positions(0, order_.size() - 1);
        improve();
        auto first = order_;
        const double first_cost = cost();
        begin();
        improve();
        return first_cost < cost() ? first : order_;
    }

private:
    void improve() {
        const auto count = order_.size();
        const std::size_t reach = count <= 40 ? count : count <= 150 ? 12 : 4;
        const int passes = count <= 150 ? 12 : 2;
        double best = cost();
        for (int pass = 0; pass < passes; ++pass) {
            const double before = best;
            move_columns(best, reach);
            reverse_runs(best, reach);
            if (best >= before - 1e-9) break;
        }
    }
    /// Moves each column to the best place within its reach.
    void move_columns(double& best, std::size_t reach) {
        const auto count = order_.size();
        const auto columns = order_;
        for (const auto column : columns) {
            const auto at = static_cast<std::size_t>(position_[column]);
            auto best_at = at;
            for (auto to = at > reach ? at - reach : 0; to <= std::min(at + reach, count - 1); ++to) {
                if (to == at) continue;
                move(static_cast<std::size_t>(position_[column]), to);
                if (const double now = cost(); now < best - 1e-9) best = now, best_at = to;
            }
            move(static_cast<std::size_t>(position_[column]), best_at);
        }
    }
    void reverse(std::size_t from, std::size_t to) {
        std::reverse(order_.begin() + static_cast<std::ptrdiff_t>(from), order_.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        update_positions(from, to);
    }
    /// Reverses runs of columns where that is better.
    void reverse_runs(double& best, std::size_t reach) {
        for (std::size_t from = 0; from + 1 < order_.size(); ++from)
            for (auto to = from + 1; to < std::min(order_.size(), from + reach + 1); ++to) {
                reverse(from, to);
                if (const double now = cost(); now < best - 1e-9)
                    best = now;
                else
                    reverse(from, to);
            }
    }

    /// A first order: from the columns that inputs reach, along the nets.
    void begin() {
        update_positions(0, order_.size() - 1);
        std::vector<std::size_t> queue;
        std::vector<bool> is_queued(nets_of_column_.size());
        const auto add = [&](std::size_t c) {
            if (!is_queued[c]) is_queued[c] = true, queue.push_back(c);
        };
        for (const auto& net : nets_)
            if (net.enters)
                for (const auto c : net.all) add(c);
        for (std::size_t next = 0, at = 0; queue.size() < order_.size();) {
            if (at == queue.size()) {
                while (is_queued[order_[next]]) ++next;
                add(order_[next]);
            }
            const auto column = queue[at++];
            for (const auto net : nets_of_column_[column])
                for (const auto c : nets_[net].sensing) add(c);
            for (const auto net : nets_of_column_[column])
                for (const auto c : nets_[net].all) add(c);
        }
        order_ = std::move(queue);
        update_positions(0, order_.size() - 1);
    }
};

}  // namespace

std::vector<std::size_t> order_columns(const Drawing& drawing, const Stacks& stacks) { return ColumnOrder(drawing, stacks).run(); }

}  // namespace corpuscle::circuit::schematic
