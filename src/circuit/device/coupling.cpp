// Coupled inductors: `k1 l1 l2 [l3 ...] k`. All pairs of the line have the coupling coefficient k.

#include <cmath>

#include "circuit/device/device_kind.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// The mutual flux of each pair a, b of inductors:   q_a = M i_b,   q_b = M i_a,   M = k sqrt(L_a L_b)
/// Unknowns: the currents of the inductors, whose equations have the flux with a negative sign (passive.cpp). L is read from the inductors
/// at each evaluation, because .dc may sweep it.
class Coupling final : public Device {
    double k_;
    std::vector<int> elements_;               // of the inductors, by index in the circuit
    std::vector<const Device*> inductors_{};  // after connect()

public:
    Coupling(double k, std::vector<int> elements) : k_(k), elements_(std::move(elements)) {}
    void connect(std::span<const std::unique_ptr<Device>> all) override {
        for (const int e : elements_) inductors_.push_back(all[static_cast<std::size_t>(e)].get());
    }
    void eval(std::span<const double> i, const EvalContext&, const Stamp& out) const override {
        for (std::size_t a = 0; a < inductors_.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                const double M = k_ * std::sqrt(inductance(a) * inductance(b));
                out.q[a] -= M * i[b], out.q[b] -= M * i[a];
                out.capacitance(a, b) -= M, out.capacitance(b, a) -= M;
            }
    }

private:
    double inductance(std::size_t n) const { return std::max(inductors_[n]->principal_value().value_or(0), 0.0); }
};

// ---- checks of all couplings together ----

/// The coefficients between the inductors that the couplings of a circuit connect, directly or through others, to those of one coupling.
class CouplingGroup {
    std::vector<std::string> names_;
    const Element* last_ = nullptr;
    std::vector<double> matrix_;  // row by row: 1 on the diagonal, else the coefficient of a pair

    bool contains(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }
    std::size_t index(const std::string& name) const { return static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin()); }
    double& at(std::size_t a, std::size_t b) { return matrix_[a * names_.size() + b]; }

public:
    /// The group of `one` among all couplings.
    CouplingGroup(const Element& one, std::span<const Element* const> couplings) : names_(one.inductors) {
        for (bool grows = true; std::exchange(grows, false);)
            for (const auto* e : couplings) {
                if (!has(*e)) continue;
                last_ = e;
                for (const auto& name : e->inductors)
                    if (!contains(name)) names_.push_back(name), grows = true;
            }
        matrix_.assign(names_.size() * names_.size(), 0);
        for (std::size_t a = 0; a < names_.size(); ++a) at(a, a) = 1;
        for (const auto* e : couplings)
            for (const auto& a : e->inductors)
                for (const auto& b : e->inductors)
                    if (a != b && contains(a)) at(index(a), index(b)) = e->value;
    }
    bool has(const Element& e) const {
        return std::ranges::any_of(e.inductors, [&](const auto& name) { return contains(name); });
    }
    const std::vector<std::string>& names() const { return names_; }
    const Element* last() const { return last_; }  ///< the last coupling of the group in the netlist

    /// False if some currents would give the inductors a negative energy: Cholesky's decomposition of the matrix fails. Coefficients of 1
    /// leave it singular, so a little is added to the diagonal.
    bool stores_energy() {
        constexpr double rounding = 1e-9;
        const auto n = names_.size();
        for (std::size_t c = 0; c < n; ++c) {
            double pivot = at(c, c) + rounding;
            for (std::size_t j = 0; j < c; ++j) pivot -= at(c, j) * at(c, j);
            if (!(pivot > 0)) return false;
            at(c, c) = std::sqrt(pivot);
            for (std::size_t r = c + 1; r < n; ++r) {
                for (std::size_t j = 0; j < c; ++j) at(r, c) -= at(r, j) * at(c, j);
                at(r, c) /= at(c, c);
            }
        }
        return true;
    }
};

/// All couplings of a circuit.
std::vector<const Element*> couplings_of(const Circuit& circuit, const DeviceKind* kind) {
    std::vector<const Element*> out;
    for (const auto& e : circuit.elements)
        if (e.kind == kind) out.push_back(&e);
    return out;
}

/// Rejects an inductor that the line has twice, and a pair that an earlier line couples, too.
Result<void> check_pairs(const Element& e, std::span<const Element* const> couplings) {
    for (std::size_t a = 0; a < e.inductors.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (e.inductors[a] == e.inductors[b]) return error_at(e.location, "{}: {} is named twice", e.name, e.inductors[a]);
            for (const auto* other : couplings) {
                if (other->name == e.name) break;
                const auto has = [&](std::size_t k) {
                    return std::ranges::find(other->inductors, e.inductors[k]) != other->inductors.end();
                };
                if (has(a) && has(b))
                    return error_at(e.location, "{}: {} and {} are coupled already, by {}; remove one of the two lines", e.name,
                                    e.inductors[b], e.inductors[a], other->name);
            }
        }
    return {};
}

Result<std::unique_ptr<Device>> make_coupling(const Element& e, DeviceSetup& setup) {
    const auto& circuit = setup.circuit();
    if (!(std::abs(e.value) <= 1)) return error_at(e.location, "{}: k = {:g} is outside [-1, 1]", e.name, e.value);
    const auto couplings = couplings_of(circuit, e.kind);
    TRY(check_pairs(e, couplings));
    CouplingGroup group(e, couplings);
    if (group.last() == &e && !group.stores_energy())
        return error_at(e.location,
                        "{}: k = {:g} between {} and {} does not fit the other couplings of {}: for some currents their energy would be "
                        "negative, because the matrix of the coefficients is not positive definite. Use a smaller magnitude of k",
                        e.name, e.value, e.inductors[0], e.inductors[1], fmt::join(group.names(), ", "));
    std::vector<int> unknowns, elements;
    for (const auto& name : e.inductors) {
        elements.push_back(circuit.find_element(name));
        unknowns.push_back(setup.branch_unknown(elements.back()));
        if (const double L = circuit.elements[static_cast<std::size_t>(elements.back())].value; L < 0)
            return error_at(e.location, "{}: {} has a negative inductance of {:g} H, which cannot be coupled", e.name, name, L);
    }
    return make_device<Coupling>(std::move(unknowns), e.value, std::move(elements));
}

// ---- netlist ----

/// True if the word can only be the name of an element: it is neither a number nor an expression nor the name of a parameter.
bool is_name(const ElementReader& line, std::size_t word) {
    return line.is_plain(word) && !parse_number(line.text(word)) && !line.is_parameter(word);
}

Result<void> read_coupling(ElementReader& line) {
    std::size_t word = 1;
    for (; word < line.word_count() && is_name(line, word); ++word) line.inductor(word);
    if (line.element.inductors.size() < 2)
        return line.error_at(word, "{} inductor{}, but expected at least 2: k1 l1 l2 [l3 ...] COEFFICIENT", word - 1, word == 2 ? "" : "s");
    const auto* pair = line.find("k");
    if (pair != nullptr) {
        if (word < line.word_count()) return line.error_at(pair->name, "its coefficient is given twice");
        line.take(*pair);
        TRY(line.value(pair->value));
    } else if (word >= line.word_count()) {
        return line.error_at(word, "its coupling coefficient is missing");
    } else {
        TRY(line.value(word));
        if (word + 1 < line.word_count()) return line.too_many(word + 1);
    }
    if (const double k = line.element.value; !(std::abs(k) <= 1))
        return pair ? line.error_at(pair->value, "k = {:g} is outside [-1, 1]", k) : line.error_at(word, "k = {:g} is outside [-1, 1]", k);
    return {};
}

// ---- export ----

/// ngspice couples two inductors in a line.
Result<std::string> write_coupling(const ElementExport& e) {
    std::string out;
    const auto& names = e.element.inductors;
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = a + 1; b < names.size(); ++b) {
            const auto first = e.names.element(names[a]), second = e.names.element(names[b]);
            const auto suffix = names.size() == 2 ? "" : fmt::format("_{}_{}", first, second);
            out += fmt::format("{}{} {} {} {}\n", e.head, suffix, first, second, e.element.value);
        }
    return out;
}

constexpr ElementParameter coupling_parameters[] = {{.name = "k", .unit = "", .low = -1, .high = 1, .is_value = true}};

}  // namespace

extern constexpr DeviceKind coupling_kind = {.letter = 'k',
                                             .description = "coupling of inductors",
                                             .read = read_coupling,
                                             .make = make_coupling,
                                             .parameters = coupling_parameters,
                                             .conducting_nodes = no_nodes,
                                             .multiply = keep_value,
                                             .area = no_area,
                                             .write_spice = write_coupling};

}  // namespace corpuscle::circuit
