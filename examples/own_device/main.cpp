// Checks what the solver requires of your own device: its currents and charges add up to zero, and the slopes that it returns are their
// derivatives.

#include <cmath>
#include <cstdio>

#include "circuit/device/device_kind.hpp"

namespace corpuscle::circuit {
extern const DeviceKind varistor_kind;  // the line of circuit/devices.cpp
}
using namespace corpuscle::circuit;

/// Gives one device its unknowns, as the solver does for all devices of a circuit.
class OneDevice final : public DeviceSetup {
    Circuit circuit_;
    int count_ = 2;  // number of unknowns: the voltages of nodes 1 and 2, and those that the device adds

public:
    explicit OneDevice(const Values& card) {
        auto& model = circuit_.models.emplace_back();
        model.name = "surge", model.type = "varistor", model.values = card;
    }
    int node_unknown(int number) const override { return number - 1; }
    int branch_unknown(int) const override { return -1; }
    int add_unknown(std::string_view) override { return count_++; }
    double temperature(const Element&) const override { return 300.15; }
    const Circuit& circuit() const override { return circuit_; }
};

/// Currents f, charges q and their slopes df, dq of a device with two unknowns, at node voltages v0 and v1.
struct Evaluation {
    double f[2] = {}, q[2] = {}, df[4] = {}, dq[4] = {};
    Evaluation(const Device& device, double v0, double v1) {
        const double v[] = {v0, v1};
        device.eval(v, {}, {f, q, df, dq});
    }
};

bool is_close(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)) + 1e-15; }

/// Compares the device's slopes at node voltages a and b with central differences.
bool slopes_are_right(const Device& device, double a, double b) {
    const double h = 1e-5;
    const Evaluation here(device, a, b), up(device, a + h, b), down(device, a - h, b);
    const double di = (up.f[0] - down.f[0]) / (2 * h), dq = (up.q[0] - down.q[0]) / (2 * h);
    return here.f[0] + here.f[1] == 0 && here.q[0] + here.q[1] == 0 && is_close(here.df[0], di) && is_close(here.df[1], -di) &&
           is_close(here.dq[0], dq) && is_close(here.dq[1], -dq);
}

int main() {
    Element element;
    element.name = "y1", element.letter = 'y', element.nodes = {1, 2}, element.model = 0;
    OneDevice setup({{"v0", 5}, {"alpha", 3}, {"c", 1e-12}});
    const auto device = varistor_kind.make(element, setup);
    if (!device) return std::puts(device.error().text().c_str()), 1;
    for (const double v : {-7.0, -0.3, 0.2, 4.0, 12.0})
        if (!slopes_are_right(**device, v, 0.5)) return std::printf("wrong slopes at %g V\n", v), 1;
    std::printf("i(v0) = %g A\n", Evaluation(**device, 5, 0).f[0]);

    OneDevice wrong({{"alpa", 3}});
    const auto refused = varistor_kind.make(element, wrong);
    std::puts(refused ? "not refused" : refused.error().text().c_str());
    return refused ? 1 : 0;
}
