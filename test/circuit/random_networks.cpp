#include "circuit/random_networks.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {
namespace {

class NetworkWriter {
    RandomSource& dice_;
    double period_;     // s: time scale of the source
    double amplitude_;  // V
    double impedance_;  // ohm: scale of all resistances
    int nodes_ = 1, elements_ = 0;
    std::string text_;

    std::string node(int k) const { return k == 0 ? "0" : fmt::format("n{}", k); }
    std::string name(char letter) { return fmt::format("{}{}", letter, ++elements_); }
    /// A node with a smaller number, the source's included; never ground.
    std::string earlier(int k) { return node(1 + dice_.index_below(std::max(k - 1, 1))); }
    double resistance() { return impedance_ * dice_.log_uniform(0.1, 10); }
    /// A time constant from a thousandth of the source's period to ten periods.
    double time_constant() { return period_ * dice_.log_uniform(1e-3, 10); }
    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        text_ += fmt::format(format, std::forward<Arguments>(arguments)...) + '\n';
    }

    void add_source() {
        const double a = amplitude_, t = period_;
        switch (dice_.index_below(4)) {
            case 0:
                return line("v1 n1 0 sin({:.6g} {:.6g} {:.6g})", a * dice_.uniform(), a, 1 / t);
            case 1:
                return line("v1 n1 0 pulse(0 {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g})", a, 0.1 * t, t * dice_.log_uniform(1e-4, 0.1),
                            t * dice_.log_uniform(1e-4, 0.1), 0.4 * t, t);
            case 2:
                return line("v1 n1 0 exp(0 {:.6g} {:.6g} {:.6g} {:.6g} {:.6g})", a, 0.1 * t, 0.1 * t, t, 0.2 * t);
            default:
                return line("v1 n1 0 pwl(0 0 {:.6g} {:.6g} {:.6g} {:.6g})", 0.3 * t, a, 0.9 * t, -a);
        }
    }

    /// Connects a new node to the ones before it; every node has a resistor to another one, so that its voltage is defined.
    void add_stage() {
        const int k = ++nodes_;
        const auto from = earlier(k), to = node(k);
        switch (dice_.index_below(7)) {
            case 0:
                line("{} {} {} {:.6g}", name('l'), from, to, impedance_ * time_constant());
                break;
            case 1:
                line("{} {} {} d{}", name('d'), from, to, 1 + dice_.index_below(2));
                break;
            case 2:
                line("{} {} 0 v={:.6g}*tanh(2*v({})/{:.6g})", name('b'), to, amplitude_, from, amplitude_);
                return add_load(k, true);
            case 3:
                line("{} 0 {} i={:.6g}*v({})*v(n1)", name('b'), to, 1 / (impedance_ * amplitude_), from);
                break;
            case 4:
                add_inverter(from, to);
                return add_load(k, false);
            default:
                line("{} {} {} {:.6g}", name('r'), from, to, resistance());
                break;
        }
        line("{} {} 0 {:.6g}", name('r'), to, resistance());
        add_load(k, false);
    }
    void add_inverter(const std::string& in, const std::string& out) {
        line("{} {} {} vdd vdd pch w=2u l=1u", name('m'), out, in);
        line("{} {} {} 0 0 nch w=1u l=1u", name('m'), out, in);
    }
    /// A capacitor, a diode or nothing from the node to ground or to an earlier node; behind a resistor if the node's voltage is fixed.
    void add_load(int k, bool is_fixed) {
        std::string at = node(k);
        const auto behind_resistor = [&] {
            if (!is_fixed) return;
            ++nodes_;
            line("{} {} {} {:.6g}", name('r'), at, node(nodes_), resistance());
            at = node(nodes_);
        };
        switch (dice_.index_below(4)) {
            case 0:
            case 1:
                behind_resistor();
                return line("{} {} 0 {:.6g}", name('c'), at, time_constant() / impedance_);
            case 2:
                behind_resistor();
                return line("{} {} {} {:.6g}", name('c'), at, earlier(k), time_constant() / impedance_);
            default:
                break;
        }
    }

public:
    explicit NetworkWriter(RandomSource& dice)
        : dice_(dice), period_(dice.log_uniform(1e-6, 1e-1)), amplitude_(dice.log_uniform(0.2, 5)), impedance_(dice.log_uniform(1e3, 1e6)) {
    }

    std::string write() {
        line(".lib 'tsmc180.lib' tt\n.model d1 d(is=1e-14)\n.model d2 d(is=1e-12 cjo=1p tt=1n rs=10)\nvdd vdd 0 1");
        add_source();
        for (int stages = 1 + dice_.index_below(5); stages > 0; --stages) add_stage();
        line(".tran {:.6g} {:.6g}", period_ / 100, 2.3 * period_);
        for (int k = 2; k <= nodes_; ++k) {
            line(".meas tran low{0} min v(n{0})\n.meas tran high{0} max v(n{0})\n.meas tran mean{0} avg v(n{0})", k);
        }
        return text_;
    }
};

}  // namespace

std::string make_random_network(RandomSource& dice) { return NetworkWriter(dice).write(); }

}  // namespace corpuscle::circuit
