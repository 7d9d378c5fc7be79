// The bipolar transistor of SPICE, level 1 (Gummel and Poon).

#include "circuit/device/device_kind.hpp"
#include "circuit/device/gummel_poon/equations.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// Unknowns: collector, base, emitter, substrate; then the inner nodes behind rc, rb and re, where these are above 0.
class Bipolar final : public Device {
    enum : std::size_t { collector, base, emitter, substrate, terminals };

    BipolarCard c_;  // at the transistor's temperature, for its area and for all transistors in parallel
    double m_, v_t_;
    bool has_substrate_;                                        // true if there is a junction to the substrate
    double sign_;                                               // 1: NPN, -1: PNP
    std::size_t inner_collector_, inner_base_, inner_emitter_;  // indices of the unknowns

    struct Junctions {
        double be, bc, sub;  // V: forward voltages
    };
    Junctions junctions(std::span<const double> v) const {
        return {sign_ * (v[inner_base_] - v[inner_emitter_]), sign_ * (v[inner_base_] - v[inner_collector_]),
                substrate_sign() * (v[substrate] - v[substrate_side()])};
    }
    /// The other side of the substrate junction, and the sign of its forward voltage from the substrate.
    std::size_t substrate_side() const { return c_.is_lateral ? inner_base_ : inner_collector_; }
    double substrate_sign() const { return c_.is_lateral ? -sign_ : sign_; }

    BipolarCurrents currents(const Junctions& v, double gmin = 0) const { return bipolar_currents(c_, v_t_, v.be, v.bc, gmin); }

    /// Adds a current or charge x of the inner transistor, from one unknown to another, and its slopes.
    void add(std::span<double> values, std::span<double> slopes, std::size_t from, std::size_t to, const Dual& x) const {
        const auto n = values.size();
        Stamp::add_between(values, from, to, sign_ * x.value);
        for (const auto& [row, sign] : {std::pair(from, 1.0), std::pair(to, -1.0)}) {
            slopes[row * n + inner_base_] += sign * (x.by_be + x.by_bc);
            slopes[row * n + inner_emitter_] -= sign * x.by_be;
            slopes[row * n + inner_collector_] -= sign * x.by_bc;
        }
    }
    void add_resistances(std::span<const double> v, const BipolarCurrents& i, const Stamp& out) const {
        const auto add_resistance = [&](std::size_t outer, std::size_t inner, double r) {
            if (outer == inner) return;
            Stamp::add_between(out.f, outer, inner, (v[outer] - v[inner]) / r), out.add_conductance(outer, inner, 1 / r);
        };
        add_resistance(collector, inner_collector_, c_.rc), add_resistance(emitter, inner_emitter_, c_.re);
        if (inner_base_ == base) return;
        const Dual r = base_resistance(c_, i);
        add(out.f, out.df, base, inner_base_, sign_ * (v[base] - v[inner_base_]) / r);
        out.add_conductance(base, inner_base_, 1 / r.value);
    }
    void add_charges(std::span<const double> v, const Junctions& u, const BipolarCurrents& i, const Stamp& out) const {
        const auto charges = bipolar_charges(c_, i, u.be, u.bc);
        add(out.q, out.dq, inner_base_, inner_emitter_, charges.base_emitter);
        add(out.q, out.dq, inner_base_, inner_collector_, charges.base_collector);
        const double v_bx = sign_ * (v[base] - v[inner_collector_]);
        const auto outer = depletion_charge(v_bx, c_.cjc * (1 - c_.xcjc), c_.vjc, c_.mjc, c_.fc);
        Stamp::add_between(out.q, base, inner_collector_, sign_ * outer.value);
        out.add_capacitance(base, inner_collector_, outer.slope);
    }
    void add_substrate(double v, const EvalContext& context, const Stamp& out) const {
        const auto i = c_.iss > 0 ? junction_current(v, c_.iss, c_.ns * v_t_) : ValueSlope{};
        const auto q = depletion_charge(v, c_.cjs, c_.vjs, c_.mjs, 0);
        Stamp::add_between(out.f, substrate, substrate_side(), substrate_sign() * (i.value + context.gmin * v));
        out.add_conductance(substrate, substrate_side(), i.slope + context.gmin);
        Stamp::add_between(out.q, substrate, substrate_side(), substrate_sign() * q.value);
        out.add_capacitance(substrate, substrate_side(), q.slope);
    }

public:
    Bipolar(const BipolarCard& card, double m, double kelvin, bool has_substrate)
        : c_(card), m_(m), v_t_(thermal_voltage(kelvin)), has_substrate_(has_substrate), sign_(card.is_pnp ? -1 : 1) {
        std::size_t next = terminals;
        inner_collector_ = c_.rc > 0 ? next++ : std::size_t{collector};
        inner_base_ = c_.rb > 0 ? next++ : std::size_t{base};
        inner_emitter_ = c_.re > 0 ? next++ : std::size_t{emitter};
    }
    bool is_linear() const override { return false; }
    std::size_t limiting_state_size() const override { return 4; }
    bool bounds_steps() const override { return true; }

    /// The state has the three junction voltages, then 1 after the first evaluation. As in SPICE, a search from 0 V begins with a
    /// conducting base-emitter junction: otherwise the first iterations would see a circuit of gmin only.
    bool limit(std::span<double> v, std::span<double> state) const override {
        const auto u = junctions(v);
        const double v_crit = critical_voltage(c_.ibe, c_.nf * v_t_);
        const bool is_first = state[3] == 0;
        bool limited = false;
        if (is_first) state[0] = std::min(u.be, v_crit), state[1] = std::min(u.bc, critical_voltage(c_.ibc, c_.nr * v_t_)), state[3] = 1;
        // Moves one side of a junction, where `sign` is that of its forward voltage u from this side.
        const auto limit_one = [&](double x, std::size_t k, std::size_t moved, double sign, double is, double n_vt) {
            const double before = x;
            if (limit_junction(x, state[k], n_vt, critical_voltage(is, n_vt))) v[moved] += sign * (x - before), limited = true;
            state[k] = x;
        };
        if (is_first && u.be == 0)
            v[inner_emitter_] -= sign_ * v_crit, state[0] = v_crit, limited = true;
        else
            limit_one(u.be, 0, inner_emitter_, -sign_, c_.ibe, c_.nf * v_t_);
        limit_one(u.bc, 1, inner_collector_, -sign_, c_.ibc, c_.nr * v_t_);
        if (c_.iss > 0) limit_one(junctions(v).sub, 2, substrate, substrate_sign(), c_.iss, c_.ns * v_t_);
        return limited;
    }

    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        const auto u = junctions(v);
        const auto i = currents(u, context.gmin);
        add(out.f, out.df, inner_collector_, inner_emitter_, i.collector_emitter);
        add(out.f, out.df, inner_base_, inner_emitter_, i.base_emitter);
        add(out.f, out.df, inner_base_, inner_collector_, i.base_collector);
        add_resistances(v, i, out);
        if (context.with_charges) add_charges(v, u, i, out);
        if (has_substrate_) add_substrate(u.sub, context, out);
    }

    /// Thermal noise of the resistances; shot noise of the currents of collector and base; flicker noise of the base current, which is
    /// m kf (i_b / m)^af / f for m transistors.
    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto i = currents(junctions(v));
        const double i_c = std::abs((i.collector_emitter - i.base_collector).value),
                     i_b = std::abs((i.base_emitter + i.base_collector).value);
        std::vector<NoiseSource> out = {{"shot ic", inner_collector_, inner_emitter_, 2 * electron_charge * i_c, 0},
                                        {"shot ib", inner_base_, inner_emitter_, 2 * electron_charge * i_b, 0}};
        if (c_.kf > 0) out.push_back({"flicker", inner_base_, inner_emitter_, 0, m_ * c_.kf * std::pow(i_b / m_, c_.af), true});
        const double four_kt = 4 * electron_charge * v_t_;
        if (c_.rc > 0) out.push_back({"thermal rc", collector, inner_collector_, four_kt / c_.rc, 0});
        if (c_.rb > 0) out.push_back({"thermal rb", base, inner_base_, four_kt / base_resistance(c_, i).value, 0});
        if (c_.re > 0) out.push_back({"thermal re", emitter, inner_emitter_, four_kt / c_.re, 0});
        return out;
    }

    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const auto u = junctions(v);
        const auto i = currents(u);
        const auto q = bipolar_charges(c_, i, u.be, u.bc);
        const double i_c = sign_ * (i.collector_emitter - i.base_collector).value, i_b = sign_ * (i.base_emitter + i.base_collector).value;
        return {{"ic", "A", i_c},
                {"ib", "A", i_b},
                {"ie", "A", -i_c - i_b},
                {"vbe", "V", sign_ * u.be},
                {"vbc", "V", sign_ * u.bc},
                {"gm", "S", i.collector_emitter.by_be + i.collector_emitter.by_bc},
                {"gpi", "S", i.base_emitter.by_be},
                {"gmu", "S", i.base_collector.by_bc},
                {"go", "S", -i.collector_emitter.by_bc},
                {"cpi", "F", q.base_emitter.by_be},
                {"cmu", "F", q.base_collector.by_bc}};
    }

    /// A junction conducts from 3 kT/q on, where its current is twenty times the saturation current.
    std::string operating_region(std::span<const double> v) const override {
        const auto u = junctions(v);
        const bool forward = u.be > 3 * c_.nf * v_t_, reverse = u.bc > 3 * c_.nr * v_t_;
        if (forward) return reverse ? "saturation" : "active";
        return reverse ? "reverse" : "off";
    }
};

Result<std::unique_ptr<Device>> make_bipolar(const Element& e, DeviceSetup& setup) {
    const auto card = TRY(read_bipolar_card(*setup.circuit().model_of(e)));
    const double area = value_or(e.values, "area", 1), m = value_or(e.values, "m", 1), kelvin = setup.temperature(e);
    if (!(area > 0)) return error_at(e.location, "{}: area = {:g} must be positive", e.name, area);
    std::vector<int> unknowns;
    for (const int node : e.nodes) unknowns.push_back(setup.node_unknown(node));
    const bool has_substrate = e.nodes.size() > 3 || card.cjs > 0 || card.iss > 0;
    if (e.nodes.size() == 3) unknowns.push_back(-1);
    for (const auto& [resistance, name] : {std::pair(card.rc, "collector"), std::pair(card.rb, "base"), std::pair(card.re, "emitter")})
        if (resistance > 0) unknowns.push_back(setup.add_unknown(fmt::format("{}#{}", e.name, name)));
    return make_device<Bipolar>(std::move(unknowns), adjust_bipolar_card(card, area * m, kelvin), m, kelvin, has_substrate);
}

// ---- netlist ----

/// Number of nodes before the model.
Result<std::size_t> count_nodes(const ElementReader& line) {
    if (line.word_count() > 6 && line.is_model(6) && !line.is_model(5) && !line.is_model(4))
        return line.error_at(5, "a fifth node (the temperature) is not supported; remove it");
    if (line.is_model(4) && !(line.word_count() > 5 && line.is_model(5))) return 3;
    const auto after = line.text(5);
    const bool is_option = after.empty() || after == "off" || !line.is_plain(5) || (after[0] < 'a' && !line.is_model(5));
    return is_option ? 3 : 4;
}

Result<void> read_bipolar(ElementReader& line) {
    constexpr std::string_view expected = "collector, base, emitter, perhaps substrate, then the model";
    TRY(line.nodes(3, expected));
    if (line.word_count() < 5) return line.error_at(4, "its model is missing");
    const auto nodes = TRY(count_nodes(line));
    if (nodes == 4) line.element.nodes.clear(), TRY(line.nodes(4, expected));
    TRY(line.model(nodes + 1, {"npn", "pnp"}));
    line.drop_unknown_model_values(bipolar_parameter_names(), absent_bipolar_parameters());
    for (std::size_t k = nodes + 2; k < line.word_count(); ++k) {
        if (line.text(k) == "off") {
            line.element.values["off"] = 1;
        } else if (line.continues_initial_voltages(k, 1)) {
            TRY(line.number(k));
        } else if (k == nodes + 2 && !line.find("area")) {
            line.element.values["area"] = TRY(line.number(k));
        } else {
            return line.too_many(k);
        }
    }
    if (line.model_value("ptf").value_or(0) != 0)
        line.warn_about_model("ptf has no effect: the model has no excess phase; tf delays the current");
    return {};
}

/// ngspice 39 multiplies the saturation current of the base-collector junction by the area twice, so the area is exported as a part of m.
/// Only the flicker noise depends on the two in different ways, if af is not 1.
Result<std::string> write_bipolar(const ElementExport& e) {
    const double area = e.value("area", 1), m = e.value("m", 1);
    const auto card = TRY(read_bipolar_card(*e.model()));
    const bool is_part_of_m = card.kf == 0 || card.af == 1;
    return fmt::format("{} {}{} m={}{}\n", e.head, e.names.model(e.element.model), is_part_of_m ? "" : fmt::format(" area={}", area),
                       is_part_of_m ? area * m : m, e.temperature());
}

std::vector<int> all_nodes(const Element& e) { return e.nodes; }

constexpr ElementParameter bipolar_parameters[] = {{"area", "", above_zero, unlimited, 1}, parameter_m, parameter_temp, parameter_dtemp};
constexpr std::string_view bipolar_names[] = {"ic", "off"};

}  // namespace

extern constexpr DeviceKind bipolar_kind = {.letter = 'q',
                                            .description = "bipolar transistor",
                                            .gmin = 1e-12,
                                            .read = read_bipolar,
                                            .make = make_bipolar,
                                            .parameters = bipolar_parameters,
                                            .other_names = bipolar_names,
                                            .conducting_nodes = all_nodes,
                                            .saves_terminal_current = true,
                                            .write_spice = write_bipolar};

}  // namespace corpuscle::circuit
