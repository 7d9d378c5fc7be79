#include "circuit/batch/chip_memory.hpp"

#include "circuit/device/device_kind.hpp"
#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {
namespace {

/// The unknowns of the transistors' terminals; ground is the index after the last unknown. All groups consist of transistors, the only kind
/// of device that has batches.
std::vector<int> transistor_terminals(const System& system) {
    std::vector<int> out;
    for (const auto& group : system.groups())
        for (const int u : group.unknowns) out.push_back(u < 0 ? system.size() : u);
    return out;
}
/// The unknowns of each other device; ground is -1.
std::vector<std::vector<int>> other_unknowns(const System& system) {
    std::vector<std::vector<int>> out;
    for (const auto k : system.scalar_devices()) out.push_back(system.devices()[k]->unknowns);
    return out;
}

}  // namespace

ChipMemory::ChipMemory(const System& system, const Elimination& elimination, std::size_t points)
    : terminals_(transistor_terminals(system)), transistors_(terminals_.size() / 4), scalar_unknowns_(other_unknowns(system)) {
    const auto& p = system.pattern();
    const auto n = static_cast<std::size_t>(system.size()), entries = p.entries();
    const auto list = elimination.list();
    std::vector<std::size_t> order(entries);  // entries of the pattern in the order of their slots
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return list.entry_slot[a] < list.entry_slot[b]; });
    std::vector<int> columns(entries);  // of each entry
    p.for_each_entry([&](std::size_t e, std::size_t, std::size_t column) { columns[e] = static_cast<int>(column); });
    entry_.resize(entries + 1, entries);
    for (const auto k : order) {
        entry_[k] = row_.size();
        row_.push_back(p.rows()[k]), column_.push_back(columns[k]), slot_.push_back(list.entry_slot[k]);
    }
    for (int u = 0; u < system.size(); ++u) is_voltage_.push_back(system.is_voltage(u)), diagonal_.push_back(entry_[p.entry_index(u, u)]);
    for (const auto& group : system.groups())
        for (const auto k : group.entries) entries_.push_back(entry_[k]);
    auto& b = block;
    b.unknowns = n, b.entries = entries, b.points = points, b.devices = transistors_, b.list = list;
    b.row = row_.data(), b.column = column_.data(), b.slot = slot_.data(), b.is_voltage = is_voltage_.data(),
    b.terminals = terminals_.data();
    std::vector<std::pair<lanes::LaneRow**, std::size_t>> arrays;  // the arrays of rows_ and their lengths
    for (auto* array : {&b.q, &b.source_currents, &b.history, &b.rate, &b.r, &b.step, &b.error, &b.inverse_pivot, &b.work, &b.scale,
                        &b.inverse_allowed, &b.relative, &b.floor})
        arrays.emplace_back(array, n);
    for (auto* array : {&b.x, &b.I, &b.Q}) arrays.emplace_back(array, n + 1);
    for (auto* array : {&b.G, &b.C}) arrays.emplace_back(array, entries + 1);
    for (auto* array : {&b.past_x, &b.past_q}) arrays.emplace_back(array, points * n);
    arrays.emplace_back(&b.slots, b.list.slots), arrays.emplace_back(&b.linearized_at, 4 * transistors_);
    std::size_t total = 0;
    for (const auto& [array, count] : arrays) total += count;
    rows_.resize(total);
    auto* next = rows_.data();
    for (const auto& [array, count] : arrays) *array = std::exchange(next, next + count);
    std::vector<char> has_entry(b.list.slots);
    for (std::size_t e = 0; e < entries; ++e) has_entry[static_cast<std::size_t>(slot_[e])] = 1;
    for (std::size_t k = 0; k < b.list.slots; ++k)
        if (!has_entry[k]) fill_.push_back(static_cast<int>(k));
    b.fill = fill_.data(), b.fill_count = fill_.size();
    linearizations_.resize(lanes::chips_per_block * transistors_), constants_.resize(linearizations_.size()), moved_.resize(transistors_);
    linear_sums_.resize(n + 2 * entries);
    moved_v_.resize(4 * transistors_), new_linearizations_.resize(lanes::chips_per_block * transistors_);
}

bool ChipMemory::is_compatible(const System& system) const {
    return static_cast<std::size_t>(system.size()) == block.unknowns && transistor_terminals(system) == terminals_ &&
           other_unknowns(system) == scalar_unknowns_;
}

/// Sums the linear devices of a chip, and lists its nonlinear devices that are not transistors.
void ChipMemory::sum_linear_devices(const System& system, std::size_t chip, const EvalContext& context) {
    lanes::LaneRow *const I = linear_sums_.data(), *const G = I + block.unknowns, *const C = G + block.entries;
    nonlinear_devices_[chip].clear();
    for (const auto k : system.scalar_devices()) {
        const Device& d = *system.devices()[k];
        if (d.is_linear()) continue;
        NonlinearDevice other{k, d.unknowns, {}, std::vector<double>(d.unknowns.size()), {}, {}, {}, {}};
        for (const auto pattern_entry : system.entries(k)) other.entries.push_back(entry_[pattern_entry]);
        nonlinear_devices_[chip].push_back(std::move(other));
    }
    const auto sums = circuit::sum_linear_devices(system, context);
    for (std::size_t n = 0; n < block.unknowns; ++n) I[n].value[chip] = sums.currents[n];
    for (std::size_t e = 0; e < block.entries; ++e) G[entry_[e]].value[chip] = sums.G[e], C[entry_[e]].value[chip] = sums.C[e];
}

void ChipMemory::load_chip(std::size_t chip, const System& system, const EvalContext& context) {
    sum_linear_devices(system, chip, context);
    auto* constants = constants_.data() + chip * transistors_;
    for (const auto& group : system.groups())
        for (const auto* device : group.members) *constants++ = &transistor_constants(*device);
    std::fill_n(linearizations_.begin() + static_cast<std::ptrdiff_t>(chip * transistors_), transistors_, Linearization{});
    for (std::size_t k = 0; k < 4 * transistors_; ++k) block.linearized_at[k].value[chip] = 1e30;  // counts as moved
    for (std::size_t n = 0; n < block.unknowns; ++n) block.source_currents[n].value[chip] = 0;
    sum_again(chip);
}

void ChipMemory::sum_again(std::size_t chip) {
    const lanes::LaneRow *const I = linear_sums_.data(), *const G = I + block.unknowns, *const C = G + block.entries;
    for (std::size_t n = 0; n < block.unknowns; ++n) block.I[n].value[chip] = I[n].value[chip], block.Q[n].value[chip] = 0;
    for (std::size_t e = 0; e < block.entries; ++e) block.G[e].value[chip] = G[e].value[chip], block.C[e].value[chip] = C[e].value[chip];
    const auto n = static_cast<int>(block.unknowns);
    for (std::size_t d = 0; d < transistors_; ++d) {
        const Linearization& line = linearizations_[chip * transistors_ + d];
        for (std::size_t j = 0; j < 4; ++j)
            if (const int u = terminals_[4 * d + j]; u < n) block.I[u].value[chip] += line.i[j], block.Q[u].value[chip] += line.q[j];
        for (std::size_t e = 0; e < 16; ++e)
            if (const auto entry = entries_[16 * d + e]; entry < block.entries)
                block.G[entry].value[chip] += line.g[e], block.C[entry].value[chip] += line.c[e];
    }
    for (auto& other : nonlinear_devices_[chip]) other.last = other.last_buffer.zeros(other.unknowns.size());
}

/// Adds the change of a linearization to the sums of the block.
void ChipMemory::replace_linearization(const DeviceOnChip& p, const Linearization& updated) {
    constexpr std::size_t row = lanes::chips_per_block;  // distance between rows
    Linearization &old = linearizations_[p.chip * transistors_ + p.device], change;
    for (std::size_t k = 0; k < 4; ++k) change.i[k] = updated.i[k] - old.i[k], change.q[k] = updated.q[k] - old.q[k];
    for (std::size_t e = 0; e < 16; ++e) change.g[e] = updated.g[e] - old.g[e], change.c[e] = updated.c[e] - old.c[e];
    old = updated;
    double *const I = block.I->value + p.chip, *const Q = block.Q->value + p.chip, *const G = block.G->value + p.chip,
                  *const C = block.C->value + p.chip;
    const std::size_t* const entry = entries_.data() + 16 * p.device;
    for (std::size_t e = 0; e < 16; ++e) C[entry[e] * row] += change.c[e];
    for (std::size_t e = 0; e < 16; ++e)
        if (e / 4 != Terminals::G) G[entry[e] * row] += change.g[e];  // the gate current is 0
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t u = static_cast<std::size_t>(terminals_[4 * p.device + k]);
        I[u * row] += change.i[k], Q[u * row] += change.q[k];
        block.linearized_at[4 * p.device + k].value[p.chip] = block.x[u].value[p.chip];
    }
}

/// Prefetches the data of the next replace_linearization(), which is mostly in a slower cache.
void ChipMemory::prefetch(const DeviceOnChip& p) const {
    const std::size_t* const entry = entries_.data() + 16 * p.device;
    for (std::size_t e = 0; e < 16; ++e) {
        __builtin_prefetch(block.G[entry[e]].value, 1);
        __builtin_prefetch(block.C[entry[e]].value, 1);
    }
    const auto* const line = reinterpret_cast<const char*>(&linearizations_[p.chip * transistors_ + p.device]);
    for (std::size_t at = 0; at < sizeof(Linearization); at += 64) __builtin_prefetch(line + at, 1);
}

void ChipMemory::relinearize(const lanes::ChipKernels& kernels, std::uint8_t chips, double gmin) {
    kernels.find_moved(block, linearization_radius, moved_.data());
    moved_devices_.clear(), moved_constants_.clear();
    for (std::size_t d = 0; d < transistors_; ++d)
        for (unsigned bits = moved_[d] & chips; bits != 0; bits &= bits - 1) {
            const auto chip = static_cast<std::size_t>(__builtin_ctz(bits));
            moved_devices_.push_back({d, chip}), moved_constants_.push_back(constants_[chip * transistors_ + d]);
        }
    if (moved_devices_.empty()) return;
    const std::size_t stride = (moved_devices_.size() + lanes::chips_per_block - 1) / lanes::chips_per_block * lanes::chips_per_block;
    moved_constants_.resize(stride, moved_constants_.back());
    double* const v = moved_v_[0].value;
    for (std::size_t k = 0; k < stride; ++k) {
        const auto& p = moved_devices_[std::min(k, moved_devices_.size() - 1)];
        for (std::size_t j = 0; j < 4; ++j) v[j * stride + k] = block.x[terminals_[4 * p.device + j]].value[p.chip];
    }
    kernels.linearize({moved_constants_.data(), moved_devices_.size(), stride, v, gmin, new_linearizations_.data()});
    for (std::size_t k = 0; k < moved_devices_.size(); ++k) {
        if (k + 1 < moved_devices_.size()) prefetch(moved_devices_[k + 1]);
        replace_linearization(moved_devices_[k], new_linearizations_[k]);
    }
}

bool ChipMemory::relinearize_nonlinear_devices(std::size_t chip, const System& system, const EvalContext& context,
                                               std::vector<double>& limiting_state) {
    bool limited = false;
    for (auto& o : nonlinear_devices_[chip]) {
        const Device& d = *system.devices()[o.index];
        const auto n = o.unknowns.size();
        for (std::size_t j = 0; j < n; ++j) o.v[j] = o.unknowns[j] < 0 ? 0 : block.x[o.unknowns[j]].value[chip];
        o.limited_v = o.v;
        limited |= d.limiting_state_size() > 0 && d.limit(o.limited_v, system.limiting_state_of(o.index, limiting_state));
        const auto stamp = o.buffer.eval(d, o.limited_v, context);
        const auto& [i, q, g, c] = stamp;
        for (std::size_t row = 0; row < n; ++row) {
            for (std::size_t column = 0; column < n; ++column) {
                const auto e = row * n + column;
                i[row] -= g[e] * o.limited_v[column], q[row] -= c[e] * o.limited_v[column];
                if (o.entries[e] >= block.entries) continue;
                block.G[o.entries[e]].value[chip] += g[e] - o.last.df[e];
                block.C[o.entries[e]].value[chip] += c[e] - o.last.dq[e];
            }
            if (o.unknowns[row] < 0) continue;
            block.I[o.unknowns[row]].value[chip] += i[row] - o.last.f[row];
            block.Q[o.unknowns[row]].value[chip] += q[row] - o.last.q[row];
        }
        std::swap(o.last_buffer, o.buffer), o.last = stamp;
    }
    return limited;
}

bool ChipMemory::expressions_match(std::size_t chip, const System& system, const EvalContext& context,
                                   const ExpressionTolerance& tolerance) {
    for (auto& o : nonlinear_devices_[chip]) {
        const Device& d = *system.devices()[o.index];
        if (!d.has_jumps()) continue;
        const auto n = o.unknowns.size();
        for (std::size_t j = 0; j < n; ++j) o.v[j] = o.unknowns[j] < 0 ? 0 : block.x[o.unknowns[j]].value[chip];
        const auto f = o.buffer.eval(d, o.v, context).f;
        for (std::size_t row = 0; row < n; ++row) {
            double linear = o.last.f[row];
            for (std::size_t column = 0; column < n; ++column) linear += o.last.slope(row, column) * o.v[column];
            const bool is_voltage = o.unknowns[row] >= 0 && !system.is_voltage(o.unknowns[row]);
            if (!tolerance.accepts(is_voltage, f[row], linear, o.v)) return false;
        }
    }
    return true;
}

}  // namespace corpuscle::circuit
