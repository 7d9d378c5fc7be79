#include "circuit/device/transistor.hpp"

#include <cmath>

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/device/uicm_operating_point.hpp"
#include "circuit/lanes/chip_kernels_impl.hpp"
#include "core/number/instruction_set.hpp"

namespace corpuscle::circuit {

const lanes::TransistorKernels lanes::scalar_transistor_kernels = lanes::transistor_kernels_for<double>;
const lanes::ChipKernels lanes::scalar_chip_kernels = lanes::chip_kernels_for<double>;

namespace {

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
        lanes::scalar_transistor_kernels.eval({reinterpret_cast<const std::byte*>(&model), 1, 1, v.data(), context.gmin, out.f.data(),
                                               out.df.data(), max_term, context.with_charges ? out.q.data() : nullptr, out.dq.data(), 0});
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
        return {{"channel", Terminals::D, Terminals::S, n.thermal, n.flicker},
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
        kernels_.eval({models_.data()->bytes, count_, s.stride, s.v, context.gmin, s.f, s.df, s.max_term, s.q, s.dq, s.rate});
    }
    void extrapolate(std::size_t stride, const double* dv, const double* dq, double* q) const override {
        kernels_.extrapolate(stride, dv, dq, q);
    }
};

/// The instance parameters of an M line. temp and dtemp are read by DeviceSetup; ic and off are accepted without effect here.
Result<UicmInstance> read_instance(const Element& e) {
    UicmInstance instance;
    std::vector<std::string_view> known = {"temp", "dtemp", "ic", "off"};
    for (const auto& f : UicmInstance::fields) known.push_back(f.name);
    TRY(check_value_names(e.name, e.values, known, e.location));
    for (const auto& f : UicmInstance::fields) {
        const auto given = e.values.find(f.name);
        if (given == e.values.end()) continue;
        const ParameterInfo info{f.name, f.unit, instance.*f.member, f.low, f.high, f.description, {}};
        if (auto ok = check_range(e.name, info, given->second); !ok) return bad_input(ok.error().message, e.location);
        instance.*f.member = given->second;
    }
    return instance;
}

}  // namespace

Result<std::unique_ptr<Device>> make_transistor(const Element& e, DeviceSetup& setup) {
    const auto& model = setup.circuit().models[static_cast<std::size_t>(e.model)];
    if (value_or(model.values, "level", 1) != UicmCard::level)
        return bad_input(fmt::format("{}: MOS model level {:g} is not supported; use level={:g}, UICM, as in process/tsmc180.lib",
                                     model.name, value_or(model.values, "level", 1), UicmCard::level),
                         model.location);
    const auto card = TRY(read_model_card<UicmCard>(UicmCard::fields, model, {"level"}));
    const auto instance = TRY(read_instance(e));
    auto device = std::make_unique<Transistor>(card, instance, setup.temperature(e) - zero_celsius, model.type == "pmos");
    for (const int node : e.nodes) device->unknowns.push_back(setup.node_unknown(node));
    return std::unique_ptr<Device>(std::move(device));
}

const UicmConstants& transistor_constants(const Device& device) { return static_cast<const Transistor&>(device).constants(); }

namespace {

/// Selects the table of kernels for the instruction set that instruction_set() returns.
template <class Table>
Result<const Table*> select_table(const Table& scalar, [[maybe_unused]] const Table& avx2, [[maybe_unused]] const Table& avx512,
                                  const Table& baseline) {
    const auto set = TRY(instruction_set());
    switch (set) {
        case InstructionSet::scalar:
            return &scalar;
        case InstructionSet::avx2:
            return &avx2;
        case InstructionSet::avx512:
            return &avx512;
        default:
            return &baseline;
    }
}

}  // namespace

#ifdef __x86_64__
#define CORPUSCLE_SELECT_TABLE(scalar, table) select_table(scalar, lanes::avx2::table, lanes::avx512::table, lanes::baseline::table)
#else
#define CORPUSCLE_SELECT_TABLE(scalar, table) select_table(scalar, lanes::baseline::table, lanes::baseline::table, lanes::baseline::table)
#endif

Result<std::unique_ptr<DeviceBatch>> make_transistor_batch() {
    const auto kernels = TRY(CORPUSCLE_SELECT_TABLE(lanes::scalar_transistor_kernels, transistor_kernel_table));
    return std::unique_ptr<DeviceBatch>(std::make_unique<TransistorBatch>(*kernels));
}

Result<const lanes::ChipKernels*> chip_kernels() { return CORPUSCLE_SELECT_TABLE(lanes::scalar_chip_kernels, chip_kernel_table); }

}  // namespace corpuscle::circuit
