#include "circuit/device/transistor.hpp"

#include <cmath>

#include "circuit/device/constants.hpp"
#include "circuit/device/uicm.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

/// Unknowns: drain, gate, source, bulk.
class Transistor final : public Device {
    UicmConstants constants_;
    Uicm<double> uicm_;

    struct Voltages {
        double v[4];
        explicit Voltages(std::span<const double> at) : v{at[0], at[1], at[2], at[3]} {}
    };
    UicmAnswer<double> answer(std::span<const double> v) const {
        UicmAnswer<double> out;
        uicm_.eval(Voltages(v).v, out);
        return out;
    }

public:
    explicit Transistor(const UicmConstants& c) : constants_(c), uicm_(c) {}
    bool linear() const override { return false; }

    void eval(std::span<const double> v, const Instant& at, const Stamp& out) const override {
        const auto a = answer(v);
        for (std::size_t row = 0; row < 4; ++row) {
            out.f[row] += a.i[row], out.q[row] += a.q[row];
            for (std::size_t column = 0; column < 4; ++column) {
                out.slope(row, column) += a.di[row][column];
                out.capacitance(row, column) += a.dq[row][column];
            }
        }
        for (const std::size_t end : {Terminals::D, Terminals::S}) {
            const double i = at.gmin * (v[Terminals::B] - v[end]);
            out.f[Terminals::B] += i, out.f[end] -= i;
            out.slope(Terminals::B, Terminals::B) += at.gmin, out.slope(Terminals::B, end) -= at.gmin;
            out.slope(end, Terminals::B) -= at.gmin, out.slope(end, end) += at.gmin;
        }
    }

    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto n = uicm_.noise(Voltages(v).v);
        std::vector<NoiseSource> out = {{"channel", Terminals::D, Terminals::S, n.thermal, n.flicker},
                                        {"source junction", Terminals::B, Terminals::S, n.shot_s, 0},
                                        {"drain junction", Terminals::B, Terminals::D, n.shot_d, 0}};
        return out;
    }

    std::vector<Reading> readings(std::span<const double> v) const override {
        const auto a = answer(v);
        const auto inside = uicm_.inside(Voltages(v).v);
        const auto D = Terminals::D, G = Terminals::G, S = Terminals::S, B = Terminals::B;
        const double sign = constants_.polarity;
        const double g_d = a.di[D][D] - junction_slope(a, D), g_s = a.di[S][S] - junction_slope(a, S);
        return {{"i_d", "A", sign * inside.I},
                {"i_f", "", inside.q_S * (inside.q_S + 2)},
                {"i_r", "", inside.q_D * (inside.q_D + 2)},
                {"g_mg", "S", a.di[D][G]},
                {"g_ms", "S", g_s},
                {"g_md", "S", g_d},
                {"g_mb", "S", g_s - g_d - a.di[D][G]},
                {"v_t", "V", sign * constants_.V_T},
                {"i_bulk", "A", a.i[B]},
                {"i_off", "A", off(v)},
                {"c_gs", "F", -a.dq[G][S]},
                {"c_gd", "F", -a.dq[G][D]},
                {"c_gb", "F", -a.dq[G][B]},
                {"c_bs", "F", -a.dq[B][S]},
                {"c_bd", "F", -a.dq[B][D]}};
    }

    std::string_view state(std::span<const double> v) const override {
        const auto inside = uicm_.inside(Voltages(v).v);
        const double more = std::max(inside.q_S, inside.q_D), less = std::min(inside.q_S, inside.q_D), i = more * (more + 2);
        if (i < 1e-6) return "off";
        const bool saturated = less * (less + 2) < 0.05 * i;
        if (i < 1) return saturated ? "weak, saturation" : "weak, triode";
        if (i < 100) return saturated ? "moderate, saturation" : "moderate, triode";
        return saturated ? "strong, saturation" : "strong, triode";
    }

private:
    static double junction_slope(const UicmAnswer<double>& a, int end) { return -a.di[Terminals::B][end]; }
    /// What would flow from drain to source if the gate were at the source.
    double off(std::span<const double> v) const {
        const double at[4] = {v[Terminals::D], v[Terminals::S], v[Terminals::S], v[Terminals::B]};
        return constants_.polarity * uicm_.inside(at).I;
    }
};

/// A size from what an M line says.
Result<UicmInstance> size_of(const Element& e) {
    UicmInstance size;
    std::vector<std::string_view> known = {"temp", "dtemp", "ic", "off"};
    for (const auto& f : UicmInstance::fields) known.push_back(f.name);
    if (auto wrong = unknown_value(e.name, e.values, known, e.place)) return *wrong;
    for (const auto& f : UicmInstance::fields) {
        const auto said = e.values.find(f.name);
        if (said == e.values.end()) continue;
        const Row row{f.name, f.unit, size.*f.at, f.low, f.high, f.sentence, {}};
        if (auto wrong = outside(e.name, row, said->second)) return bad_input(wrong->sentence, e.place);
        size.*f.at = said->second;
    }
    return size;
}

}  // namespace

Result<std::unique_ptr<Device>> make_transistor(const Element& e, Setup& setup) {
    const auto& model = setup.circuit().models[static_cast<std::size_t>(e.model)];
    if (value_or(model.values, "level", 1) != UicmCard::level)
        return bad_input(fmt::format("{}: a model of level {:g}; transistors here are of level={:g}, UICM (process/tsmc180.lib has cards)",
                                     model.name, value_or(model.values, "level", 1), UicmCard::level),
                         model.place);
    const auto card = card_from<UicmCard>(UicmCard::fields, model, {"level"});
    if (!card) return card.error();
    const auto size = size_of(e);
    if (!size) return size.error();
    auto device = std::make_unique<Transistor>(uicm_constants(*card, *size, setup.temperature(e) - zero_celsius, model.type == "pmos"));
    for (const int node : e.nodes) device->unknowns.push_back(setup.node(node));
    return std::unique_ptr<Device>(std::move(device));
}

}  // namespace corpuscle::circuit
