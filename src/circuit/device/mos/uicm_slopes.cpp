#include "circuit/device/mos/uicm_slopes.hpp"

#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {
namespace {

/// Currents into drain and bulk. A junction's current flows from the bulk to its other end.
template <class T>
std::pair<T, T> drain_and_bulk(const Uicm<T>& device, const T& polarity, const TerminalVoltages& v) {
    const auto inside = device.internals({T(v[0]), T(v[1]), T(v[2]), T(v[3])});
    return {polarity * (inside.I - inside.I_d), polarity * (inside.I_s + inside.I_d)};
}

}  // namespace

void uicm_currents(const UicmConstants& c, std::span<const TerminalVoltages> voltages, std::span<DrainBulkCurrents> out) {
    const Uicm<double> device(c);
    for (std::size_t k = 0; k < voltages.size(); ++k) {
        const auto [I_D, I_B] = drain_and_bulk(device, c.polarity, voltages[k]);
        out[k] = {I_D, I_B};
    }
}

void uicm_slopes(const UicmConstants& below, const UicmConstants& at, const UicmConstants& above, double distance,
                 std::span<const TerminalVoltages> voltages, std::span<DrainBulkCurrents> out) {
    using num::Dual;
    const Uicm<Dual> device([&](double UicmConstants::* x) { return Dual(at.*x, (above.*x - below.*x) / distance); });
    for (std::size_t k = 0; k < voltages.size(); ++k) {
        const auto [I_D, I_B] = drain_and_bulk(device, Dual(at.polarity), voltages[k]);
        out[k] = {I_D.d, I_B.d};
    }
}

}  // namespace corpuscle::circuit
