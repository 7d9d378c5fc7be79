#pragma once
// A MOS transistor with four terminals: its channel, which each model computes, and what surrounds the channel in every model.

#include "circuit/device/device.hpp"
#include "circuit/device/mos/bulk_junction.hpp"
#include "core/number/gradient.hpp"

namespace corpuscle::circuit {

/// A number with its derivatives with respect to the voltages of drain, gate, source and bulk.
using MosNumber = num::Gradient<4>;

/// Voltages above the bulk, for the polarity of an NMOS.
struct MosVoltages {
    MosNumber d, g, s;
};

/// Currents (A) and charges (C) of the channel, for the polarity of an NMOS. The gate has the charge -(q_d + q_s + q_b).
struct MosChannelValues {
    MosNumber i;              ///< from drain to source
    MosNumber i_db, i_sb;     ///< from drain and source to bulk, by impact ionisation
    MosNumber q_d, q_s, q_b;  ///< of drain, source and bulk
};

/// Everything but the channel. Values are those of all transistors in parallel.
struct MosSurroundings {
    bool pmos = false;
    double kelvin = 300.15;
    double g_drain = 0, g_source = 0;     ///< S: of the series resistances; 0: none
    double C_gd = 0, C_gs = 0, C_gb = 0;  ///< F: overlaps
    BulkJunction drain, source;
};

/// Unknowns: drain, gate, source, bulk, and for each series resistance an inner drain or source.
///
/// Above the critical voltage of a junction the bulk's voltage is limited in Newton steps. The channel has no exponential of a voltage that
/// could overflow, and the solver limits the steps of all voltages.
class MosDevice : public Device {
protected:
    MosSurroundings s_;
    double sign_;                              // 1 for NMOS, -1 for PMOS
    std::size_t drain_ = 0, source_ = 2;       // of the channel, among the unknowns
    double critical_drain_, critical_source_;  // V

    enum { D, G, S, B };

    virtual MosChannelValues channel(const MosVoltages&, bool with_charges) const = 0;

    MosVoltages voltages(std::span<const double> v) const;
    MosChannelValues channel_at(std::span<const double> v) const { return channel(voltages(v), true); }
    /// Thermal noise of the series resistances.
    void add_resistor_noise(std::vector<NoiseSource>&) const;
    /// Currents, slopes and capacitances that all models have.
    std::vector<OperatingValue> common_info(std::span<const double> v, double v_th, double v_dsat) const;

public:
    explicit MosDevice(const MosSurroundings&);
    bool is_linear() const override { return false; }
    std::size_t limiting_state_size() const override { return 3; }
    bool limit(std::span<double> v, std::span<double> state) const override;
    void eval(std::span<const double> v, const EvalContext&, const Stamp&) const override;
};

/// The unknowns of the transistor: those of its nodes, and inner nodes where there is a resistance.
std::vector<int> mos_unknowns(const Element&, DeviceSetup&, const MosSurroundings&);

}  // namespace corpuscle::circuit
