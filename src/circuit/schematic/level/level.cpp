#include "circuit/schematic/level/level.hpp"

#include "circuit/schematic/level/part_of_element.hpp"

namespace corpuscle::circuit::schematic {
namespace {

/// The nets of a level, added when a node of the circuit is first used.
class NetTable {
    const Circuit& circuit_;
    const std::vector<int>& outside_;
    Level& level_;
    std::map<int, int> numbers_;

    std::string local_name(const std::string& node) const {
        const auto prefix = level_.path.size() + 1;
        const bool is_own = !level_.path.empty() && node.size() > prefix && node.compare(0, prefix, level_.path + ".") == 0;
        return is_own ? node.substr(prefix) : node;
    }

public:
    NetTable(const Circuit& circuit, const std::vector<int>& outside, Level& level) : circuit_(circuit), outside_(outside), level_(level) {
        number(0);
    }
    int number(int node) {
        const auto [at, is_new] = numbers_.try_emplace(node, static_cast<int>(level_.nets.size()));
        if (is_new) {
            const auto& name = circuit_.nodes[static_cast<std::size_t>(node)];
            level_.nets.push_back({local_name(name), circuit_.nodes[static_cast<std::size_t>(outside_[static_cast<std::size_t>(node)])]});
        }
        return at->second;
    }
};

/// The part of a path before its last dot that names an instance; "" for the top level.
template <class IsInstance>
std::string_view parent_path(std::string_view path, const IsInstance& is_instance) {
    for (auto dot = path.rfind('.'); dot != std::string_view::npos && dot > 0; dot = path.rfind('.', dot - 1))
        if (is_instance(path.substr(0, dot))) return path.substr(0, dot);
    return {};
}

std::string name_in(std::string_view parent, const std::string& path) { return parent.empty() ? path : path.substr(parent.size() + 1); }

std::string ports_key(const SubcircuitInstance& instance) {
    auto key = instance.subcircuit;
    for (const auto& port : instance.ports) key += ' ' + port;
    return key;
}

Part part_of_block(const SubcircuitInstance& instance, std::string name, const std::vector<PinRole>& roles, NetTable& nets) {
    Part part;
    part.symbol = Symbol::block, part.name = std::move(name), part.path = instance.path, part.type = instance.subcircuit;
    for (std::size_t k = 0; k < instance.ports.size(); ++k)
        part.pins.push_back({nets.number(instance.outside[k]), roles[k], instance.ports[k]});
    return part;
}

}  // namespace

LevelReader::LevelReader(const HierarchicalCircuit& circuit) : circuit_(circuit) {
    const auto is_instance = [this](std::string_view path) { return contents_.find(path) != contents_.end(); };
    contents_[""];
    outside_.resize(circuit.circuit.nodes.size());
    for (std::size_t k = 0; k < outside_.size(); ++k) outside_[k] = static_cast<int>(k);
    for (const auto& instance : circuit.instances) {
        contents_[std::string(parent_path(instance.path, is_instance))].instances.push_back(&instance);
        contents_[instance.path].self = &instance;
        for (std::size_t k = 0; k < instance.ports.size(); ++k)
            if (instance.inside[k] != 0)
                outside_[static_cast<std::size_t>(instance.inside[k])] = outside_[static_cast<std::size_t>(instance.outside[k])];
    }
    for (const auto& e : circuit.circuit.elements) contents_.find(parent_path(e.name, is_instance))->second.elements.push_back(&e);
}

std::vector<std::string_view> LevelReader::block_paths() const {
    std::vector<std::string_view> out;
    for (const auto& instance : circuit_.instances) out.push_back(instance.path);
    return out;
}

const LevelReader::Contents& LevelReader::contents_of(std::string_view path) const { return contents_.find(path)->second; }

std::size_t LevelReader::size_of(std::string_view path) const {
    const auto& contents = contents_of(path);
    return contents.elements.size() + contents.instances.size() + (contents.self == nullptr ? 0 : contents.self->ports.size());
}

std::vector<PinRole> LevelReader::roles_of(const SubcircuitInstance& instance) {
    const auto key = ports_key(instance);
    if (const auto known = port_roles_.find(key); known != port_roles_.end()) return known->second;
    // A subcircuit does not contain itself, so this ends.
    return port_roles_.emplace(key, read(instance.path).port_roles).first->second;
}

Level LevelReader::read(std::string_view path) {
    const auto& contents = contents_of(path);
    Level level;
    level.path = std::string(path), level.title = circuit_.circuit.title;
    NetTable nets(circuit_.circuit, outside_, level);
    if (contents.self != nullptr) {
        level.subcircuit = contents.self->subcircuit;
        for (const int node : contents.self->inside) level.ports.push_back(nets.number(node));
        for (const int port : level.ports) level.nets[static_cast<std::size_t>(port)].is_port = port != 0;
    }
    for (const auto* instance : contents.instances)
        level.parts.push_back(part_of_block(*instance, name_in(path, instance->path), roles_of(*instance), nets));
    for (const auto* e : contents.elements)
        level.parts.push_back(part_of_element(circuit_.circuit, *e, name_in(path, e->name), [&](int node) { return nets.number(node); }));
    find_rails(level);
    find_idle_channels(level);
    hide_bulks_at_rails(level);
    find_port_roles(level);
    estimate_potentials(level);
    return level;
}

}  // namespace corpuscle::circuit::schematic
