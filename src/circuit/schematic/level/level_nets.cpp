#include "circuit/schematic/level/level_nets.hpp"

namespace corpuscle::circuit::schematic {
namespace {

bool begins_with_one_of(std::string_view name, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(), [&](std::string_view b) { return name.substr(0, b.size()) == b; });
}

/// The pins of a net that show whether it is a rail.
struct RailSigns {
    int p_sources = 0, p_bulks = 0, n_sources = 0, n_bulks = 0, supply_ports = 0, ground_ports = 0, signals = 0;
    bool has_source_to_ground = false;
};

void count_signs(const Part& part, std::vector<RailSigns>& signs) {
    const auto of = [&](const Pin& pin) -> RailSigns& { return signs[static_cast<std::size_t>(pin.net)]; };
    for (std::size_t k = 0; k < part.pins.size(); ++k) {
        const auto& pin = part.pins[k];
        auto& s = of(pin);
        const bool is_p = is_p_type(part.symbol);
        if (part.symbol == Symbol::block)
            ++(pin.role == PinRole::supply ? s.supply_ports : pin.role == PinRole::ground ? s.ground_ports : s.signals);
        else if (is_transistor(part.symbol) && k >= 2)
            ++(k == 2 ? (is_p ? s.p_sources : s.n_sources) : (is_p ? s.p_bulks : s.n_bulks));
        else if (pin.role == PinRole::sense || pin.role == PinRole::input)
            ++s.signals;
    }
    if (part.symbol == Symbol::voltage_source && part.pins[1].net == 0 && !part.is_signal_source && !part.is_ammeter)
        of(part.pins[0]).has_source_to_ground = true;
}

bool is_supply(const Net& net, const RailSigns& s) {
    if (!net.is_port && !s.has_source_to_ground) return false;
    if (begins_with_one_of(net.name, {"vdd", "vcc", "avdd", "dvdd", "avcc", "vpos", "v+"})) return true;
    return s.signals == 0 && (s.supply_ports > 0 || (s.p_sources > 0 && s.p_bulks > 0));
}

bool is_low_rail(const Net& net, const RailSigns& s) {
    if (!net.is_port && !s.has_source_to_ground) return false;
    if (begins_with_one_of(net.name, {"vss", "avss", "dvss", "gnd", "agnd", "dgnd", "vneg"})) return true;
    return s.signals == 0 && (s.ground_ports > 0 || (s.n_sources > 0 && s.n_bulks > 0));
}

}  // namespace

void find_rails(Level& level) {
    std::vector<RailSigns> signs(level.nets.size());
    for (const auto& part : level.parts) count_signs(part, signs);
    for (std::size_t k = 1; k < level.nets.size(); ++k) {
        auto& net = level.nets[k];
        if (is_low_rail(net, signs[k]))
            net.kind = NetKind::ground;
        else if (is_supply(net, signs[k]))
            net.kind = NetKind::supply;
    }
    level.nets[0].kind = NetKind::ground;
}

void find_idle_channels(Level& level) {
    std::vector<int> uses(level.nets.size());
    for (const auto& part : level.parts)
        for (const auto& pin : part.pins) uses[static_cast<std::size_t>(pin.net)] += pin.role == PinRole::bulk ? 0 : 1;
    for (auto& part : level.parts) {
        if (!is_mos(part.symbol) || is_rail(level, part.pins[2]) || net_of(level, part.pins[2]).is_port) continue;
        if (uses[static_cast<std::size_t>(part.pins[2].net)] == 1) part.pins[0].role = part.pins[2].role = PinRole::bulk;
    }
}

void hide_bulks_at_rails(Level& level) {
    int supply = -1, low = 0;
    for (std::size_t k = 0; k < level.nets.size(); ++k) {
        if (level.nets[k].kind == NetKind::supply) supply = supply < 0 ? static_cast<int>(k) : -2;
        if (k > 0 && level.nets[k].kind == NetKind::ground) low = low == 0 ? static_cast<int>(k) : -2;
    }
    for (auto& part : level.parts) {
        if (!is_mos(part.symbol) || part.pins.size() < 4) continue;
        const int bulk = part.pins[3].net;
        if (bulk != (is_p_type(part.symbol) ? supply : low)) continue;
        part.index_of_hidden_bulk_net = bulk;
        part.pins.pop_back();
    }
}

void find_port_roles(Level& level) {
    struct Seen {
        bool sense = false, drive = false, input = false, source = false, bulk = false, passive = false;
    };
    std::vector<Seen> seen(level.nets.size());
    for (const auto& part : level.parts)
        for (const auto& pin : part.pins) {
            auto& s = seen[static_cast<std::size_t>(pin.net)];
            switch (pin.role) {
                case PinRole::sense:
                    s.sense = true;
                    break;
                case PinRole::drive:
                    s.drive = true;
                    break;
                case PinRole::input:
                    s.input = true;
                    break;
                case PinRole::source:
                    s.source = true;
                    break;
                case PinRole::bulk:
                    s.bulk = true;
                    break;
                default:
                    s.passive = true;
            }
        }
    level.port_roles.clear();
    for (const int port : level.ports) {
        const auto& net = level.nets[static_cast<std::size_t>(port)];
        const auto& s = seen[static_cast<std::size_t>(port)];
        level.port_roles.push_back(net.kind == NetKind::supply   ? PinRole::supply
                                   : net.kind == NetKind::ground ? PinRole::ground
                                   : s.drive                     ? PinRole::drive
                                   : s.input                     ? PinRole::input
                                   : s.source                    ? PinRole::source
                                   : s.passive                   ? PinRole::passive
                                   : s.sense                     ? PinRole::sense
                                   : s.bulk                      ? PinRole::bulk
                                                                 : PinRole::passive);
    }
}

void estimate_potentials(Level& level) {
    struct Link {
        std::size_t a, b;
        double weight;
    };
    std::vector<Link> links;
    for (const auto& part : level.parts) {
        if (part.symbol == Symbol::block || part.pins.size() < 2) continue;
        const bool transistor = is_transistor(part.symbol);
        const auto a = static_cast<std::size_t>(part.pins[0].net), b = static_cast<std::size_t>(part.pins[transistor ? 2 : 1].net);
        links.push_back({a, b, part.symbol == Symbol::capacitor ? 0.01 : 1});
    }
    constexpr int sweeps = 60;
    std::vector<double> sum(level.nets.size()), weight(level.nets.size());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        std::fill(sum.begin(), sum.end(), 0), std::fill(weight.begin(), weight.end(), 0);
        for (const auto& link : links) {
            sum[link.a] += link.weight * level.nets[link.b].potential, weight[link.a] += link.weight;
            sum[link.b] += link.weight * level.nets[link.a].potential, weight[link.b] += link.weight;
        }
        for (std::size_t k = 0; k < level.nets.size(); ++k) {
            auto& net = level.nets[k];
            net.potential = net.kind == NetKind::ground ? 0 : net.kind == NetKind::supply ? 1 : weight[k] > 0 ? sum[k] / weight[k] : 0.5;
        }
    }
}

}  // namespace corpuscle::circuit::schematic
