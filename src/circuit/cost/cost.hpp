#pragma once
// What a circuit costs: power, area, leakage.

#include "circuit/analysis/bench.hpp"
#include "circuit/cost/area.hpp"
#include "circuit/cost/leakage.hpp"
#include "circuit/cost/power.hpp"

namespace corpuscle::circuit {

struct BlockCost {
    std::string name;
    std::size_t transistors = 0, units = 0;  ///< arrays, and what they are made of
    Area area;
    Leak worst;              ///< of its transistors, the one that leaks most
    std::string worst_name;  ///< "" if it has none
};

struct Cost {
    double supply = 0;                                  ///< V: of the source that delivers most at the operating point
    std::vector<std::string> sources;                   ///< what delivers
    std::vector<BlockCost> blocks;                      ///< in the netlist's order
    std::vector<std::pair<std::string, Powers>> power;  ///< "op", then of a transient "mean", "peak" and its force's phases
    bool has_sensor = false;                            ///< else nothing of its power is the sensor's
    bool is_receptor = false;                           ///< it takes force and says what a spike is
    std::size_t unsized = 0;   ///< elements whose area is not known: resistors, inductors, diodes, capacitors by formula
    double smallest_bias = 0;  ///< A; 0: no ideal source gives one
    std::vector<Leak> leaks;   ///< of devices that are off, those above a tenth of it: first what leaks onto a capacitor, the worst first
    std::vector<std::string> leaking;  ///< their names

    Area area() const;
    const Powers* powers(std::string_view of) const;  ///< null: not known
    double per_mm2() const { return 1e-6 / area().total(); }
};

/// Of a bench's circuit as it is now. Its transient, if it is to be counted, has gone through `over`.
Result<Cost> cost_of(TestBench&, const PowerOverTime* over = nullptr);

}  // namespace corpuscle::circuit
