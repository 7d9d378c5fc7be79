#include "circuit/device/transistor.hpp"

#include <cmath>

#include "circuit/device/constants.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/device/uicm_point.hpp"
#include "circuit/device/values.hpp"
#include "circuit/lanes/transistors_on.hpp"
#include "signal/instruction_set.hpp"

namespace corpuscle::circuit {

const lanes::TransistorLanes lanes::one_by_one = lanes::transistor_lanes<double>;

namespace {

struct Voltages {
    double v[4];
    explicit Voltages(std::span<const double> at) : v{at[0], at[1], at[2], at[3]} {}
};

/// Unknowns: drain, gate, source, bulk.
class Transistor final : public Device {
    UicmCard card_;
    UicmInstance size_;
    bool pmos_;
    UicmConstants designed_, constants_;

public:
    Transistor(const UicmCard& card, const UicmInstance& size, double temperature, bool pmos)
        : card_(card), size_(size), pmos_(pmos), designed_(uicm_constants(card, size, temperature, pmos)), constants_(designed_) {}
    const UicmConstants& constants() const { return constants_; }
    bool linear() const override { return false; }

    void eval(std::span<const double> v, const Instant& at, const Stamp& out) const override {
        const Uicm<double> model(constants_);
        double most[4];
        lanes::one_by_one.eval({reinterpret_cast<const std::byte*>(&model), 1, 1, v.data(), at.gmin, out.f.data(), out.df.data(), most,
                                at.charges ? out.q.data() : nullptr, out.dq.data(), 0});
    }

    bool draw(const Draw* chip, std::uint32_t number) override {
        constants_ = chip == nullptr
                         ? designed_
                         : shifted(designed_, chip->mismatch ? mismatch(card_, size_, chip->seed, number, chip->chip) : UicmShift{},
                                   process(card_, pmos_, chip->process));
        return true;
    }

    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto n = Uicm<double>(constants_).noise(Voltages(v).v);
        return {{"channel", Terminals::D, Terminals::S, n.thermal, n.flicker},
                {"source junction", Terminals::B, Terminals::S, n.shot_s, 0},
                {"drain junction", Terminals::B, Terminals::D, n.shot_d, 0}};
    }

    std::vector<Reading> readings(std::span<const double> v) const override {
        const auto p = uicm_point(constants_, Voltages(v).v);
        return {{"i_d", "A", p.I_D},   {"i_f", "", p.i_f},    {"i_r", "", p.i_r},     {"g_mg", "S", p.g_mg},
                {"g_ms", "S", p.g_ms}, {"g_md", "S", p.g_md}, {"g_mb", "S", p.g_mb},  {"v_t", "V", p.V_T},
                {"i_bs", "A", p.I_bs}, {"i_bd", "A", p.I_bd}, {"i_off", "A", off(v)}, {"c_gs", "F", p.C_gs},
                {"c_gd", "F", p.C_gd}, {"c_gb", "F", p.C_gb}, {"c_bs", "F", p.C_bs},  {"c_bd", "F", p.C_bd}};
    }
    std::string state(std::span<const double> v) const override {
        const auto p = uicm_point(constants_, Voltages(v).v);
        return p.inversion == "off" ? "off" : fmt::format("{}, {}", p.inversion, p.region);
    }

private:
    /// What would flow from drain to source if the gate were at the source.
    double off(std::span<const double> v) const {
        const double at[4] = {v[Terminals::D], v[Terminals::S], v[Terminals::S], v[Terminals::B]};
        return constants_.polarity * Uicm<double>(constants_).inside(at).I;
    }
};

class TransistorBank final : public Bank {
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    const lanes::TransistorLanes& lanes_;
    std::vector<Line> models_;
    std::size_t count_ = 0;

public:
    explicit TransistorBank(const lanes::TransistorLanes& lanes) : lanes_(lanes) {}

    void take(std::span<const Device* const> devices) override {
        UicmConstants some[lanes::widest];
        count_ = devices.size();
        models_.resize(((count_ + lanes_.lanes - 1) / lanes_.lanes * lanes_.model_bytes + sizeof(Line) - 1) / sizeof(Line));
        auto* at = models_.data()->bytes;
        for (std::size_t k = 0; k < count_; k += lanes_.lanes, at += lanes_.model_bytes) {
            for (std::size_t l = 0; l < lanes_.lanes; ++l)
                some[l] = static_cast<const Transistor*>(devices[std::min(k + l, count_ - 1)])->constants();
            lanes_.build(at, some);
        }
    }

    void eval(const Instant& at, const BankStamp& s) const override {
        lanes_.eval({models_.data()->bytes, count_, s.room, s.v, at.gmin, s.f, s.df, s.most, s.q, s.dq, s.rate});
    }
    void follow(std::size_t room, const double* dv, const double* dq, double* q) const override { lanes_.follow(room, dv, dq, q); }
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
    auto device = std::make_unique<Transistor>(*card, *size, setup.temperature(e) - zero_celsius, model.type == "pmos");
    for (const int node : e.nodes) device->unknowns.push_back(setup.node(node));
    return std::unique_ptr<Device>(std::move(device));
}

Result<std::unique_ptr<Bank>> make_transistor_bank() {
    const auto set = instruction_set();
    if (!set) return set.error();
    const auto& lanes = *set == InstructionSet::scalar ? lanes::one_by_one
#ifdef __x86_64__
                        : *set == InstructionSet::avx512 ? lanes::avx512::transistors
                        : *set == InstructionSet::avx2   ? lanes::avx2::transistors
#endif
                                                       : lanes::baseline::transistors;
    return std::unique_ptr<Bank>(std::make_unique<TransistorBank>(lanes));
}

}  // namespace corpuscle::circuit
