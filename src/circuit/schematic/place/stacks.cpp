#include "circuit/schematic/place/stacks.hpp"

namespace corpuscle::circuit::schematic {
namespace {

bool has_two_ends(const Part& part) {
    return part.symbol != Symbol::note && part.symbol != Symbol::block && part.symbol != Symbol::port && !is_transistor(part.symbol);
}

/// True if the part is upright, between an upper and a lower net.
bool is_upright(const Level& level, const Part& part) {
    if (is_transistor(part.symbol)) return true;
    if (!has_two_ends(part) || part.pins.size() < 2) return false;
    if (is_rail(level, part.pins[0]) || is_rail(level, part.pins[1])) return true;
    if (part.symbol == Symbol::capacitor || part.is_ammeter || part.symbol == Symbol::switch_contact) return false;
    if (part.symbol == Symbol::resistor || part.symbol == Symbol::diode || part.symbol == Symbol::inductor)
        return std::abs(net_of(level, part.pins[0]).potential - net_of(level, part.pins[1]).potential) > 0.15;
    return true;
}

Orientation upright_orientation(const Level& level, const Part& part) {
    const Orientation natural;
    const auto& above = net_of(level, part.pins[upper_pin(part, natural)]);
    const auto& below = net_of(level, part.pins[lower_pin(part, natural)]);
    const auto height = [](const Net& n) { return n.kind == NetKind::supply ? 2.0 : n.kind == NetKind::ground ? -1.0 : n.potential; };
    return {.is_flipped = height(above) < height(below) - 1e-3};
}

class StackBuilder {
    const Level& level_;
    Stacks out_;
    std::vector<bool> is_upright_, from_supply_, to_ground_;  // of parts
    std::vector<int> below_, above_;                          // the part that is joined at the end; -1: none

    const Part& part(std::size_t k) const { return level_.parts[k]; }
    int upper_net(std::size_t k) const { return part(k).pins[upper_pin(part(k), out_.orientations[k])].net; }
    int lower_net(std::size_t k) const { return part(k).pins[lower_pin(part(k), out_.orientations[k])].net; }
    NetKind kind(int net) const { return level_.nets[static_cast<std::size_t>(net)].kind; }

    /// Marks the parts that are reached from a kind of rail, going down (or up) through upright parts.
    std::vector<bool> reached(NetKind rail, bool down) const {
        std::vector<bool> net_reached(level_.nets.size()), out(level_.parts.size());
        for (std::size_t k = 0; k < level_.nets.size(); ++k) net_reached[k] = level_.nets[k].kind == rail;
        for (bool changes = true; changes;) {
            changes = false;
            for (std::size_t k = 0; k < out.size(); ++k) {
                if (!is_upright_[k] || out[k]) continue;
                const auto from = static_cast<std::size_t>(down ? upper_net(k) : lower_net(k)),
                           to = static_cast<std::size_t>(down ? lower_net(k) : upper_net(k));
                if (!net_reached[from]) continue;
                out[k] = changes = true;
                if (level_.nets[to].kind == NetKind::signal) net_reached[to] = true;
            }
        }
        return out;
    }

    /// How well part b fits under part a.
    int merit(std::size_t a, std::size_t b) const {
        const auto &upper = part(a), &lower = part(b);
        if (!is_transistor(upper.symbol) || !is_transistor(lower.symbol)) return 20;
        if (is_p_type(upper.symbol) != is_p_type(lower.symbol)) return is_p_type(upper.symbol) ? 25 : 15;
        const bool has_rail_above = !is_p_type(upper.symbol) && kind(upper_net(a)) != NetKind::signal;
        const bool has_rail_below = is_p_type(upper.symbol) && kind(lower_net(b)) != NetKind::signal;
        const int at_rail = has_rail_above || has_rail_below ? 1 : 0;  // its other end is better joined by a wire
        if (upper.pins[1].net == lower.pins[1].net) return 40 - at_rail;
        if (!is_p_type(upper.symbol)) return from_supply_[a] ? 30 - at_rail : 5;
        return to_ground_[b] ? 30 - at_rail : 22;
    }

    void join_parts() {
        struct Pair {
            int merit;
            std::size_t a, b;
        };
        std::vector<std::vector<std::size_t>> ends_at(level_.nets.size()), begins_at(level_.nets.size());
        for (std::size_t k = 0; k < level_.parts.size(); ++k)
            if (is_upright_[k])
                ends_at[static_cast<std::size_t>(lower_net(k))].push_back(k),
                    begins_at[static_cast<std::size_t>(upper_net(k))].push_back(k);
        constexpr std::size_t most = 40;  // at one net; with more, stacks are not meaningful
        std::vector<Pair> pairs;
        for (std::size_t net = 0; net < level_.nets.size(); ++net)
            if (level_.nets[net].kind == NetKind::signal && ends_at[net].size() <= most && begins_at[net].size() <= most)
                for (const auto a : ends_at[net])
                    for (const auto b : begins_at[net])
                        if (a != b) pairs.push_back({merit(a, b), a, b});
        std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
            return x.merit != y.merit ? x.merit > y.merit : x.a != y.a ? x.a < y.a : x.b < y.b;
        });
        for (const auto& pair : pairs)
            if (below_[pair.a] < 0 && above_[pair.b] < 0 && !is_above(pair.b, pair.a))
                below_[pair.a] = static_cast<int>(pair.b), above_[pair.b] = static_cast<int>(pair.a);
    }
    bool is_above(std::size_t a, std::size_t b) const {
        for (int k = static_cast<int>(a); k >= 0; k = below_[static_cast<std::size_t>(k)])
            if (k == static_cast<int>(b)) return true;
        return false;
    }

    /// True if the rows of the part are counted from the top.
    bool is_upper(std::size_t k) const {
        if (is_transistor(part(k).symbol)) return is_p_type(part(k).symbol);
        return kind(upper_net(k)) == NetKind::supply && kind(lower_net(k)) != NetKind::ground;
    }

    /// The row of each part, from the top for upper parts and from the bottom for the others. A part whose neighbour is in another column
    /// is beyond the parts that stand between it and the rail.
    std::vector<int> find_rows(bool upper) const {
        std::vector<int> rows(level_.parts.size(), 0);
        const auto deepest = [&](int net) {
            int row = -1;
            for (std::size_t k = 0; k < rows.size(); ++k)
                if (is_upright_[k] && is_upper(k) == upper && (upper ? lower_net(k) : upper_net(k)) == net) row = std::max(row, rows[k]);
            return row;
        };
        for (int pass = 0; pass < 6; ++pass)  // deeper stacks than this are columns of their own
            for (std::size_t k = 0; k < rows.size(); ++k) {
                if (!is_upright_[k] || is_upper(k) != upper) continue;
                const int joined = upper ? above_[k] : below_[k], net = upper ? upper_net(k) : lower_net(k);
                if (joined >= 0 && is_upper(static_cast<std::size_t>(joined)) == upper)
                    rows[k] = rows[static_cast<std::size_t>(joined)] + 1;
                else
                    rows[k] = kind(net) == NetKind::signal ? std::min(deepest(net) + 1, 6) : 0;
            }
        return rows;
    }

    void add_columns() {
        const auto upper_rows = find_rows(true), lower_rows = find_rows(false);
        std::vector<Column> columns;
        std::vector<int> from_bottom;  // of each part of the last column; -1: counted from the top
        int rows = 1;
        struct Span {
            int top, bottom;  // rows counted from the top and from the bottom
        };
        for (std::size_t first = 0; first < level_.parts.size(); ++first) {
            if (is_upright_[first] ? above_[first] >= 0 : false) continue;
            Column column;
            for (int k = static_cast<int>(first); k >= 0;
                 k = is_upright_[static_cast<std::size_t>(k)] ? below_[static_cast<std::size_t>(k)] : -1)
                column.parts.push_back(static_cast<std::size_t>(k));
            if (is_upright_[first]) rows = std::max(rows, set_rows(column, upper_rows, lower_rows));
            columns.push_back(std::move(column));
        }
        for (auto& column : columns)
            for (auto& row : column.rows)
                if (row < 0) row += rows;
        out_.columns = std::move(columns), out_.row_count = rows;
    }

    /// Sets the rows of a column: from the top if they are not negative, else from the bottom (-1 is the last row). Returns the number of
    /// rows that it needs.
    int set_rows(Column& column, const std::vector<int>& upper_rows, const std::vector<int>& lower_rows) const {
        bool is_ordered = true;  // all upper parts are above all lower ones
        for (std::size_t k = 1; k < column.parts.size(); ++k)
            is_ordered = is_ordered && (is_upper(column.parts[k - 1]) || !is_upper(column.parts[k]));
        const int count = static_cast<int>(column.parts.size());
        if (!is_ordered) {
            for (int k = 0; k < count; ++k) column.rows.push_back(k);
            return count;
        }
        column.rows.resize(column.parts.size());
        int top = 0, bottom = 0;  // the rows that are taken
        for (std::size_t k = 0; k < column.parts.size(); ++k)
            if (is_upper(column.parts[k])) column.rows[k] = std::max(upper_rows[column.parts[k]], top), top = column.rows[k] + 1;
        for (std::size_t k = column.parts.size(); k-- > 0;)
            if (!is_upper(column.parts[k])) column.rows[k] = -1 - std::max(lower_rows[column.parts[k]], bottom), bottom = -column.rows[k];
        return top + bottom;
    }

public:
    explicit StackBuilder(const Level& level) : level_(level) {}

    Stacks run() {
        const auto count = level_.parts.size();
        is_upright_.resize(count), below_.assign(count, -1), above_.assign(count, -1), out_.orientations.resize(count);
        for (std::size_t k = 0; k < count; ++k) {
            is_upright_[k] = is_upright(level_, part(k));
            if (is_upright_[k])
                out_.orientations[k] = upright_orientation(level_, part(k));
            else
                out_.orientations[k].is_horizontal = has_two_ends(part(k));
        }
        from_supply_ = reached(NetKind::supply, true), to_ground_ = reached(NetKind::ground, false);
        join_parts();
        add_columns();
        return std::move(out_);
    }
};

}  // namespace

std::size_t upper_pin(const Part& part, Orientation o) {
    const std::size_t natural = is_transistor(part.symbol) && is_p_type(part.symbol) ? 2 : 0;
    const std::size_t other = is_transistor(part.symbol) ? 2 - natural : 1;
    return o.is_flipped ? other : natural;
}
std::size_t lower_pin(const Part& part, Orientation o) {
    o.is_flipped = !o.is_flipped;
    return upper_pin(part, o);
}

Stacks find_stacks(const Level& level) { return StackBuilder(level).run(); }

}  // namespace corpuscle::circuit::schematic
