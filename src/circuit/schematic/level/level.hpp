#pragma once
// One level of a netlist as it is drawn: its devices, its blocks (instances of subcircuits) and its nets.

#include <map>

#include "circuit/netlist/netlist.hpp"
#include "circuit/schematic/shape/geometry.hpp"

namespace corpuscle::circuit::schematic {

enum class Symbol {
    nmos,
    pmos,
    npn,
    pnp,
    resistor,
    capacitor,
    inductor,
    diode,
    voltage_source,
    current_source,
    controlled_voltage,
    controlled_current,
    switch_contact,
    note,  ///< a device without pins, such as a coupling
    block,
    port,
};

/// The effect of a pin on its net.
enum class PinRole {
    sense,    ///< draws no current: a gate, a controlling node
    drive,    ///< a drain, the output of a source or of a block
    input,    ///< takes a current in: a diode-connected transistor, an input of a block
    source,   ///< the source of a transistor
    passive,  ///< an end of a resistor, a capacitor ...
    bulk,     ///< a bulk, or a port that leads to bulks only
    supply,
    ground
};

struct Pin {
    int net = 0;
    PinRole role = PinRole::passive;
    std::string name = {};             ///< of the port, for blocks
    Direction side = Direction::left;  ///< of the block
};

/// A device, a block or a port of the level.
struct Part {
    Symbol symbol = Symbol::note;
    std::string name;                   ///< in the level: "mn3b"
    std::string path;                   ///< in the circuit: "xsummer.mn3b"
    std::string type;                   ///< subcircuit of a block, model of a device; "" if it has none
    std::vector<std::string> texts;     ///< size and value
    std::vector<Pin> pins;              ///< transistors: drain (collector), gate, source and, if it is drawn, bulk
    bool is_device_box = false;         ///< a device without a symbol of its own, drawn as a block whose pins are numbered
    bool is_high_threshold = false;     ///< a transistor drawn with two gate lines
    bool is_signal_source = false;      ///< a source that varies with time or receives the force
    bool is_ammeter = false;            ///< a source of 0 V
    bool has_controlling_pair = false;  ///< its third and fourth pin are the positive and the negative controlling node
    int index_of_hidden_bulk_net = -1;  ///< the net of a bulk that is not drawn because it is at its rail; -1: none
};

enum class NetKind { signal, ground, supply };

struct Net {
    std::string name;  ///< in the level: "cmp"
    std::string path;  ///< in the flat circuit: "xrectb.cmp"; of a port, the node outside
    NetKind kind = NetKind::signal;
    bool is_port = false;
    double potential = 0.5;  ///< estimate between ground (0) and supply (1), for up and down
};

struct Level {
    std::string path;        ///< of the instance: "xrectb"; "" for the top level
    std::string subcircuit;  ///< "" for the top level
    std::string title;       ///< of the netlist
    std::vector<Part> parts;
    std::vector<Net> nets;
    std::vector<int> ports;           ///< nets in the order of the .subckt line
    std::vector<PinRole> port_roles;  ///< of the ports, as a block that shows this level has them
};

/// Prepares the levels of a circuit.
class LevelReader {
    struct Contents {
        std::vector<const Element*> elements;
        std::vector<const SubcircuitInstance*> instances;
        const SubcircuitInstance* self = nullptr;
    };
    const HierarchicalCircuit& circuit_;
    std::map<std::string, Contents, std::less<>> contents_;   // by path
    std::vector<int> outside_;                                // of each node: the node outside that its port is connected to; else itself
    std::map<std::string, std::vector<PinRole>> port_roles_;  // by subcircuit, see ports_key()

    const Contents& contents_of(std::string_view path) const;
    std::vector<PinRole> roles_of(const SubcircuitInstance&);

public:
    explicit LevelReader(const HierarchicalCircuit&);

    /// The paths of all blocks, in the order of the netlist; an outer one comes before its parts.
    std::vector<std::string_view> block_paths() const;
    /// Number of parts and ports of a level.
    std::size_t size_of(std::string_view path) const;
    /// The level of an instance, or the top level ("").
    Level read(std::string_view path);
};

}  // namespace corpuscle::circuit::schematic
