#include "circuit/device/device_kind.hpp"
#include "circuit/device/mos/mos_line.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/export/uicm_subcircuit.hpp"
#include "circuit/lanes/chip_kernels_impl.hpp"

namespace corpuscle::circuit {

const lanes::TransistorKernels lanes::scalar_transistor_kernels = lanes::transistor_kernels_for<double>;
const lanes::ChipKernels lanes::scalar_chip_kernels = lanes::chip_kernels_for<double>;

namespace {

constexpr std::string_view uicm_other_names[] = {"level"};

/// An array of the voltages that a span holds.
struct Voltages {
    double v[4];
    explicit Voltages(std::span<const double> x) : v{x[0], x[1], x[2], x[3]} {}
};

/// Unknowns: drain, gate, source, bulk.
class Transistor final : public Device {
    UicmCard card_;
    UicmInstance instance_;
    bool pmos_;
    UicmConstants nominal_, constants_;

public:
    Transistor(const UicmCard& card, const UicmInstance& instance, double temperature, bool pmos)
        : card_(card), instance_(instance), pmos_(pmos), nominal_(uicm_constants(card, instance, temperature, pmos)), constants_(nominal_) {
    }
    const UicmConstants& constants() const { return constants_; }
    bool is_linear() const override { return false; }

    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        const Uicm<double> model(constants_);
        double max_term[4];  // not used
        // With one transistor and a stride of 1, the arrays are those of the stamp.
        lanes::scalar_transistor_kernels.eval(
            {{1, v.data(), out.f.data(), out.df.data(), max_term, context.with_charges ? out.q.data() : nullptr, out.dq.data()},
             reinterpret_cast<const std::byte*>(&model),
             1,
             context.gmin});
    }

    bool apply_variation(const ChipSample* chip, std::uint32_t index) override {
        constants_ =
            chip == nullptr
                ? nominal_
                : with_shifts(nominal_, chip->has_mismatch ? sample_mismatch(card_, instance_, chip->seed, index, chip->chip) : UicmShift{},
                              process_shift(card_, pmos_, chip->process));
        return true;
    }

    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        const auto n = Uicm<double>(constants_).noise(Voltages(v).v);
        return {{"channel", Terminals::D, Terminals::S, n.thermal, n.flicker, constants_.flicker > 0},
                {"source junction", Terminals::B, Terminals::S, n.shot_s, 0},
                {"drain junction", Terminals::B, Terminals::D, n.shot_d, 0}};
    }

    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const auto p = uicm_operating_point(constants_, Voltages(v).v);
        return {{"i_d", "A", p.I_D},
                {"i_f", "", p.i_f},
                {"i_r", "", p.i_r},
                {"g_mg", "S", p.g_mg},
                {"g_ms", "S", p.g_ms},
                {"g_md", "S", p.g_md},
                {"g_mb", "S", p.g_mb},
                {"v_t", "V", p.V_T},
                {"i_bs", "A", p.I_bs},
                {"i_bd", "A", p.I_bd},
                {"i_off", "A", off_current(v)},
                {"c_gs", "F", p.C_gs},
                {"c_gd", "F", p.C_gd},
                {"c_gb", "F", p.C_gb},
                {"c_bs", "F", p.C_bs},
                {"c_bd", "F", p.C_bd}};
    }
    std::string operating_region(std::span<const double> v) const override {
        const auto p = uicm_operating_point(constants_, Voltages(v).v);
        return p.inversion_level == "off" ? "off" : fmt::format("{}, {}", p.inversion_level, p.region);
    }

private:
    /// Current from drain to source with the gate at the source's voltage, A.
    double off_current(std::span<const double> v) const {
        const double off[4] = {v[Terminals::D], v[Terminals::S], v[Terminals::S], v[Terminals::B]};
        return constants_.polarity * Uicm<double>(constants_).internals(off).I;
    }
};

/// Transistors on SIMD lanes.
class TransistorBatch final : public DeviceBatch {
    struct alignas(64) CacheLine {
        std::byte bytes[64];
    };
    const lanes::TransistorKernels& kernels_;
    std::vector<CacheLine> models_;  // storage of the models that kernels_.build() constructs, each for one transistor per lane
    std::size_t count_ = 0;          // of transistors

public:
    explicit TransistorBatch(const lanes::TransistorKernels& kernels) : kernels_(kernels) {}

    void bind(std::span<const Device* const> devices) override {
        UicmConstants constants[lanes::max_lanes];
        count_ = devices.size();
        models_.resize(((count_ + kernels_.lanes - 1) / kernels_.lanes * kernels_.model_bytes + sizeof(CacheLine) - 1) / sizeof(CacheLine));
        auto* at = models_.data()->bytes;
        for (std::size_t k = 0; k < count_; k += kernels_.lanes, at += kernels_.model_bytes) {
            for (std::size_t l = 0; l < kernels_.lanes; ++l)  // all devices are transistors; the last fills the remaining lanes
                constants[l] = static_cast<const Transistor*>(devices[std::min(k + l, count_ - 1)])->constants();
            kernels_.build(at, constants);
        }
    }

    void eval(const EvalContext& context, const BatchStamp& s) const override {
        kernels_.eval({s, models_.data()->bytes, count_, context.gmin});
    }
    void extrapolate(std::size_t stride, const double* dv, const double* dq, double* q) const override {
        kernels_.extrapolate(stride, dv, dq, q);
    }
};

/// The size in an M line.
Result<UicmInstance> read_instance(const Element& e) {
    UicmInstance instance;
    for (const auto& f : UicmInstance::fields)
        if (const auto given = e.values.find(f.name); given != e.values.end())
            TRY(read_field(f, instance, e.name, given->second, e.location));
    return instance;
}

/// The card of a .model line. With n >= 1 + gamma / (2 sqrt(phi)), no part of the slope factor is negative.
Result<UicmCard> read_card(const Model& model) {
    const auto card = TRY(read_model_card<UicmCard>(UicmCard::fields, model, uicm_other_names));
    const double least_n = 1 + card.gamma / (2 * std::sqrt(card.phi));
    if (card.gamma > 0 && card.n < least_n * (1 - 1e-12))
        return error_at(
            model.location,
            "{}: gamma = {} V^0.5 with phi = {} V requires n of at least {:.4f}, but n = {}; reduce gamma to {:.4f} or increase n",
            model.name, card.gamma, card.phi, std::ceil(least_n * 1e4) / 1e4, card.n,
            std::floor(2e4 * (card.n - 1) * std::sqrt(card.phi)) / 1e4);
    return card;
}

Result<std::unique_ptr<Device>> make_transistor(const Element& e, DeviceSetup& setup) {
    const auto& model = *setup.circuit().model_of(e);
    const auto card = TRY(read_card(model));
    const auto instance = TRY(read_instance(e));
    std::vector<int> unknowns;
    for (const int node : e.nodes) unknowns.push_back(setup.node_unknown(node));
    return make_device<Transistor>(std::move(unknowns), card, instance, setup.temperature(e) - zero_celsius, model.type == "pmos");
}

/// The kernels for the instruction set that instruction_set() returns.
template <class Table>
Result<const Table*> select_table(const Table& scalar, const Table& (*of_set)(InstructionSet)) {
    const auto set = TRY(instruction_set());
    return set == InstructionSet::scalar ? &scalar : &of_set(set);
}

Result<std::unique_ptr<DeviceBatch>> make_transistor_batch() {
    const auto kernels = TRY(select_table(lanes::scalar_transistor_kernels, lanes::transistor_kernel_table));
    return std::unique_ptr<DeviceBatch>(std::make_unique<TransistorBatch>(*kernels));
}

/// An instance of the subcircuit of the export.
Result<std::string> write_transistor(const ElementExport& e) {
    const auto card = TRY(read_card(*e.model()));
    UicmInstance size;
    for (const auto& f : UicmInstance::fields) size.*f.member = e.value(f.name, size.*f.member);
    const bool pmos = e.model()->type == "pmos";
    return fmt::format("{} {} {}", e.head, uicm_subcircuit_name(pmos, card.gamma > 0),
                       uicm_parameters(card, size, celsius_of(e.circuit, e.element), pmos));
}

std::optional<Area> transistor_area(const Element& e) {
    const UicmInstance defaults;
    const double W = value_or(e.values, "w", defaults.W), L = value_or(e.values, "l", defaults.L);
    const double units = value_or(e.values, "m", 1) * value_or(e.values, "stack", 1);
    Area out;
    out.gates = units * W * L, out.arrays = array_area(W, L, units), out.islands = units * rectangle_area(W, L, 1, 1);
    return out;
}

/// The fields of UicmInstance, then the temperatures.
constexpr auto transistor_parameters = [] {
    std::array<ElementParameter, std::size(UicmInstance::fields) + 2> out{};
    for (std::size_t k = 0; k + 2 < out.size(); ++k) {
        const auto& f = UicmInstance::fields[k];
        out[k] = {f.name, f.unit, f.low, f.high, UicmInstance{}.*f.member};
    }
    out[out.size() - 2] = parameter_temp, out[out.size() - 1] = parameter_dtemp;
    return out;
}();
constexpr std::string_view transistor_names[] = {"off"};

}  // namespace

const UicmConstants& transistor_constants(const Device& device) { return static_cast<const Transistor&>(device).constants(); }

Result<const lanes::ChipKernels*> chip_kernels() { return select_table(lanes::scalar_chip_kernels, lanes::chip_kernel_table); }

extern constexpr DeviceKind transistor_kind = {.letter = 'm',
                                               .level = UicmCard::level,
                                               .description = "MOS transistor, UICM",
                                               .gmin = 1e-15,
                                               .role = Role::transistor,
                                               .read = read_mos_line,
                                               .make = make_transistor,
                                               .parameters = transistor_parameters,
                                               .other_names = transistor_names,
                                               .conducting_nodes = mos_conducting_nodes,
                                               .saves_terminal_current = true,
                                               .area = transistor_area,
                                               .write_spice = write_transistor,
                                               .export_prefix = "x",
                                               .make_batch = make_transistor_batch};

}  // namespace corpuscle::circuit
