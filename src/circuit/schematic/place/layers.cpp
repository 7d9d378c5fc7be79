#include "circuit/schematic/place/layers.hpp"

#include "circuit/schematic/place/orient_parts.hpp"

namespace corpuscle::circuit::schematic {
namespace {

class LayerFinder {
    const Drawing& drawing_;
    const std::vector<std::size_t>& members_;
    std::vector<std::vector<std::size_t>> parts_of_net_;
    std::vector<int> place_;                      // of each part in the order of the signal; -1: none yet
    std::vector<int> found_by_net_;               // the net through which a part was found; -1: it is a beginning
    std::vector<std::vector<std::size_t>> next_;  // parts to which a part's signals go
    bool has_beginning_ = false;                  // a signal source or an input port

    /// True for a source that only feeds a part, such as a bias current.
    bool is_satellite(std::size_t p) const { return has_beginning_ && rank_as_beginning(p) == 2; }

    const Part& part(std::size_t k) const { return drawing_.level.parts[k]; }

    bool drives(std::size_t p, std::size_t net) const {
        bool out = false;
        for (const auto& pin : part(p).pins) out = out || (static_cast<std::size_t>(pin.net) == net && pin.role == PinRole::drive);
        return out;
    }
    bool only_senses(std::size_t p, std::size_t net) const {
        const auto& pins = part(p).pins;
        return std::none_of(pins.begin(), pins.end(),
                            [&](const Pin& pin) { return static_cast<std::size_t>(pin.net) == net && pin.role != PinRole::sense; });
    }
    bool is_passive(std::size_t p, std::size_t net) const {
        bool out = false;
        for (const auto& pin : part(p).pins)
            out = out || (static_cast<std::size_t>(pin.net) == net && (pin.role == PinRole::passive || pin.role == PinRole::source));
        return out;
    }
    bool has_driver(std::size_t net) const {
        const auto& parts = parts_of_net_[net];
        return std::any_of(parts.begin(), parts.end(), [&](std::size_t p) { return drives(p, net); });
    }
    std::vector<std::size_t> nets_of(std::size_t p) const {
        std::vector<std::size_t> out;
        for (const auto& pin : part(p).pins)
            if (connection_of(drawing_.level, drawing_.styles, pin) == Connection::wire) out.push_back(static_cast<std::size_t>(pin.net));
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }
    /// Drivers of its inputs that have no place yet.
    int missing_drivers(std::size_t p) const {
        int count = 0;
        for (const auto net : nets_of(p)) {
            if (drives(p, net)) continue;
            for (const auto other : parts_of_net_[net])
                count += other != p && place_[other] < 0 && drives(other, net) && !is_satellite(other) ? 1 : 0;
        }
        return count;
    }
    /// True for a block that takes nothing in, such as a generator of bias currents.
    bool only_drives(std::size_t p) const {
        const auto& pins = part(p).pins;
        return part(p).symbol == Symbol::block && std::all_of(pins.begin(), pins.end(), [&](const Pin& pin) {
                   return pin.role == PinRole::drive || connection_of(drawing_.level, drawing_.styles, pin) != Connection::wire;
               });
    }
    /// Small for parts at which the signal begins.
    int rank_as_beginning(std::size_t p) const {
        if (part(p).symbol == Symbol::port) return part(p).pins[0].role == PinRole::drive ? 1 : 5;
        if (part(p).is_signal_source) return 0;
        const bool is_source = part(p).symbol == Symbol::voltage_source || part(p).symbol == Symbol::current_source;
        if (is_source && (is_rail(drawing_.level, part(p).pins[0]) || is_rail(drawing_.level, part(p).pins[1]))) return 2;
        return only_drives(p) ? 2 : 3;
    }

    void find_places() {
        int next_place = 0;
        auto beginnings = members_;
        std::vector<int> ranks(place_.size());
        for (const auto p : members_) ranks[p] = rank_as_beginning(p), has_beginning_ = has_beginning_ || ranks[p] < 2;
        for (const auto p : members_)
            if (is_satellite(p)) ranks[p] = 9;
        std::sort(beginnings.begin(), beginnings.end(),
                  [&](std::size_t a, std::size_t b) { return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : a < b; });
        std::vector<std::size_t> waiting;  // found, but drivers are missing
        for (std::size_t first = 0; static_cast<std::size_t>(next_place) < members_.size();) {
            auto at = std::find_if(waiting.begin(), waiting.end(), [&](std::size_t p) { return missing_drivers(p) == 0; });
            std::size_t chosen = 0;
            while (first < beginnings.size() && place_[beginnings[first]] >= 0) ++first;
            const bool can_begin = first < beginnings.size() && ranks[beginnings[first]] <= 2;
            if (at == waiting.end() && can_begin) {
                chosen = beginnings[first];
            } else if (at == waiting.end() && !waiting.empty()) {
                at = std::min_element(waiting.begin(), waiting.end(),
                                      [&](std::size_t a, std::size_t b) { return missing_drivers(a) < missing_drivers(b); });
                chosen = *at;
            } else {
                chosen = at != waiting.end() ? *at : beginnings[first];
            }
            waiting.erase(std::remove(waiting.begin(), waiting.end(), chosen), waiting.end());
            place_[chosen] = next_place++;
            for (const auto net : nets_of(chosen)) {
                if (only_senses(chosen, net)) continue;
                for (const auto other : parts_of_net_[net])
                    if (place_[other] < 0 && !is_satellite(other) && std::find(waiting.begin(), waiting.end(), other) == waiting.end())
                        waiting.push_back(other), found_by_net_[other] = static_cast<int>(net);
            }
        }
    }

    void find_edges() {
        next_.assign(place_.size(), {});
        for (std::size_t net = 0; net < parts_of_net_.size(); ++net) {
            const bool driven = has_driver(net);
            for (const auto a : parts_of_net_[net])
                for (const auto b : parts_of_net_[net]) {
                    if (place_[a] < 0 || place_[b] < 0 || place_[a] >= place_[b]) continue;
                    const bool was_found_here = found_by_net_[b] == static_cast<int>(net);
                    const bool from = (driven && drives(a, net)) || (found_by_net_[a] != static_cast<int>(net) && is_passive(a, net));
                    const bool to = was_found_here || (driven && !drives(b, net));
                    if (from && to) next_[a].push_back(b);
                    if (is_satellite(b) && !is_satellite(a)) next_[b].push_back(a);
                }
        }
    }

public:
    LayerFinder(const Drawing& drawing, const std::vector<std::size_t>& members)
        : drawing_(drawing), members_(members), parts_of_net_(parts_of_nets(drawing)), place_(drawing.level.parts.size(), -1),
          found_by_net_(place_.size(), -1) {}

    std::vector<int> run() {
        find_places();
        find_edges();
        auto order = members_;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place_[a] < place_[b]; });
        std::vector<int> layer(place_.size(), -1);
        std::vector<bool> has_earlier(place_.size());
        for (const auto p : order) {
            if (is_satellite(p) && !next_[p].empty()) continue;
            layer[p] = std::max(layer[p], 0);
            for (const auto n : next_[p]) layer[n] = std::max(layer[n], layer[p] + 1), has_earlier[n] = true;
        }
        // Sources, and ammeters, stand beside the first part that they feed.
        int last = 0;
        for (auto at = order.rbegin(); at != order.rend(); ++at) {
            int first_next = 1 << 20;
            for (const auto n : next_[*at]) first_next = std::min(first_next, layer[n]);
            if ((!has_earlier[*at] || part(*at).is_ammeter) && !next_[*at].empty()) layer[*at] = first_next - 1;
            last = std::max(last, layer[*at]);
        }
        int first_layer = 0;
        for (const auto p : members_) first_layer = std::min(first_layer, layer[p]);
        for (const auto p : members_) layer[p] -= first_layer;
        last -= first_layer;
        for (const auto p : members_)
            if (part(p).symbol == Symbol::port && part(p).pins[0].role != PinRole::drive) layer[p] = last;
        return layer;
    }
};

}  // namespace

std::vector<int> find_layers(const Drawing& drawing, const std::vector<std::size_t>& members) {
    return LayerFinder(drawing, members).run();
}

}  // namespace corpuscle::circuit::schematic
