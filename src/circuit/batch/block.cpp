#include "circuit/batch/block.hpp"

#include <algorithm>
#include <numeric>

#include "circuit/device/transistor.hpp"
#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {
namespace {

/// Allocates several arrays of rows from one block of memory.
class RowAllocator {
    std::vector<std::pair<lanes::Row**, std::size_t>> requests_;

public:
    void request(lanes::Row*& array, std::size_t count) { requests_.emplace_back(&array, count); }
    void allocate(std::vector<lanes::Row>& memory) {
        std::size_t total = 0;
        for (const auto& [array, count] : requests_) total += count;
        memory.assign(total, {});
        total = 0;
        for (const auto& [array, count] : requests_) *array = memory.data() + total, total += count;
    }
};

/// The unknowns of the transistors' terminals; ground is the index after the last unknown.
std::vector<int> transistor_terminals(const System& system) {
    std::vector<int> out;
    for (const auto& group : system.groups())
        for (const int u : group.unknowns) out.push_back(u < 0 ? system.size() : u);
    return out;
}
/// The unknowns of the other devices.
std::vector<std::vector<int>> other_unknowns(const System& system) {
    std::vector<std::vector<int>> out;
    for (const auto k : system.alone()) out.push_back(system.devices()[k]->unknowns);
    return out;
}

}  // namespace

ChipMemory::ChipMemory(const System& system, const Elimination& elimination, std::size_t points)
    : terminals_(transistor_terminals(system)), transistors_(terminals_.size() / 4), alone_(other_unknowns(system)) {
    const auto& p = system.pattern();
    const auto n = static_cast<std::size_t>(system.size()), entries = p.entries();
    const auto list = elimination.list();
    std::vector<std::size_t> order(entries);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return list.entry_slot[a] < list.entry_slot[b]; });
    std::vector<int> columns(entries);
    for (int column = 0; column < p.size(); ++column)
        for (int e = p.begin()[static_cast<std::size_t>(column)]; e < p.begin()[static_cast<std::size_t>(column) + 1]; ++e)
            columns[static_cast<std::size_t>(e)] = column;
    entry_.resize(entries + 1, entries);
    for (const auto place : order) {
        entry_[place] = row_.size();
        row_.push_back(p.rows()[place]), column_.push_back(columns[place]), slot_.push_back(list.entry_slot[place]);
    }
    for (int u = 0; u < system.size(); ++u) voltage_.push_back(system.is_voltage(u));
    for (const auto& group : system.groups())
        for (const auto place : group.places) places_.push_back(entry_[place]);
    auto& b = block;
    b.unknowns = n, b.entries = entries, b.points = points, b.devices = transistors_, b.list = list;
    b.row = row_.data(), b.column = column_.data(), b.slot = slot_.data(), b.voltage = voltage_.data(), b.terminals = terminals_.data();
    RowAllocator rows;
    for (auto* array : {&b.q, &b.base, &b.history, &b.rate, &b.r, &b.step, &b.error, &b.per_pivot, &b.work, &b.scale, &b.per_allowed,
                        &b.relative, &b.floor})
        rows.request(*array, n);
    for (auto* array : {&b.x, &b.I, &b.Q}) rows.request(*array, n + 1);
    for (auto* array : {&b.G, &b.C}) rows.request(*array, entries + 1);
    rows.request(b.slots, b.list.slots);
    for (auto* array : {&b.past_x, &b.past_q}) rows.request(*array, points * n);
    rows.request(b.looked, 4 * transistors_);
    rows.allocate(rows_);
    std::vector<char> has_entry(b.list.slots);
    for (std::size_t e = 0; e < entries; ++e) has_entry[static_cast<std::size_t>(slot_[e])] = 1;
    for (std::size_t k = 0; k < b.list.slots; ++k)
        if (!has_entry[k]) fill_.push_back(static_cast<int>(k));
    b.fill = fill_.data(), b.fills = fill_.size();
    lines_.resize(lanes::chips * transistors_), of_.resize(lines_.size()), moved_.resize(transistors_);
    still_.resize(n + 2 * entries);
    at_.resize(4 * transistors_), fresh_.resize(lanes::chips * transistors_);
}

bool ChipMemory::fits(const System& system) const {
    return static_cast<std::size_t>(system.size()) == block.unknowns && transistor_terminals(system) == terminals_ &&
           other_unknowns(system) == alone_;
}

void ChipMemory::set_linear(const System& system, std::size_t chip, const Instant& context) {
    lanes::Row *const I = still_.data(), *const G = I + block.unknowns, *const C = G + block.entries;
    for (auto& row : still_) row.of[chip] = 0;
    others_[chip].clear();
    for (const auto k : system.alone()) {
        const Device& d = *system.devices()[k];
        const auto n = d.unknowns.size();
        OtherDevice other{k, d.unknowns, {}, std::vector<double>(n), {}, std::vector<double>(2 * n + 2 * n * n), {}};
        for (const auto place : system.places(k)) other.places.push_back(entry_[place]);
        if (!d.linear()) {
            other.before = other.line;
            others_[chip].push_back(std::move(other));
            continue;
        }
        const std::span<double> all(other.line);
        d.eval(other.v, context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
        for (std::size_t row = 0; row < n; ++row) {
            if (!d.varies() && d.unknowns[row] >= 0) I[d.unknowns[row]].of[chip] += all[row];
            for (std::size_t column = 0; column < n; ++column) {
                const auto place = other.places[row * n + column];
                if (place >= block.entries) continue;
                G[place].of[chip] += all[2 * n + row * n + column];
                C[place].of[chip] += all[2 * n + n * n + row * n + column];
            }
        }
    }
}

void ChipMemory::seat(std::size_t chip, const System& system, const Instant& context) {
    set_linear(system, chip, context);
    auto* constants = of_.data() + chip * transistors_;
    for (const auto& group : system.groups())
        for (const auto* device : group.members) *constants++ = &transistor_constants(*device);
    std::fill_n(lines_.begin() + static_cast<std::ptrdiff_t>(chip * transistors_), transistors_, StraightLine{});
    for (std::size_t k = 0; k < 4 * transistors_; ++k) block.looked[k].of[chip] = 1e30;
    for (std::size_t n = 0; n < block.unknowns; ++n) block.base[n].of[chip] = 0;
    freshen(chip);
}

void ChipMemory::freshen(std::size_t chip) {
    const lanes::Row *const I = still_.data(), *const G = I + block.unknowns, *const C = G + block.entries;
    for (std::size_t n = 0; n < block.unknowns; ++n) block.I[n].of[chip] = I[n].of[chip], block.Q[n].of[chip] = 0;
    for (std::size_t e = 0; e < block.entries; ++e) block.G[e].of[chip] = G[e].of[chip], block.C[e].of[chip] = C[e].of[chip];
    const auto n = static_cast<int>(block.unknowns);
    for (std::size_t d = 0; d < transistors_; ++d) {
        const StraightLine& line = lines_[chip * transistors_ + d];
        for (std::size_t j = 0; j < 4; ++j)
            if (const int u = terminals_[4 * d + j]; u < n) block.I[u].of[chip] += line.i[j], block.Q[u].of[chip] += line.q[j];
        for (std::size_t e = 0; e < 16; ++e)
            if (const auto place = places_[16 * d + e]; place < block.entries)
                block.G[place].of[chip] += line.g[e], block.C[place].of[chip] += line.c[e];
    }
    for (auto& other : others_[chip]) std::fill(other.before.begin(), other.before.end(), 0.0);
}

void ChipMemory::renew(const Picked& p, const StraightLine& now) {
    constexpr std::size_t row = lanes::chips;  // distance between rows
    StraightLine &old = lines_[p.chip * transistors_ + p.device], change;
    for (std::size_t k = 0; k < 4; ++k) change.i[k] = now.i[k] - old.i[k], change.q[k] = now.q[k] - old.q[k];
    for (std::size_t e = 0; e < 16; ++e) change.g[e] = now.g[e] - old.g[e], change.c[e] = now.c[e] - old.c[e];
    old = now;
    double *const I = block.I->of + p.chip, *const Q = block.Q->of + p.chip, *const G = block.G->of + p.chip,
                  *const C = block.C->of + p.chip;
    const std::size_t* const place = places_.data() + 16 * p.device;
    for (std::size_t e = 0; e < 16; ++e) C[place[e] * row] += change.c[e];
    for (std::size_t e = 0; e < 16; ++e)
        if (e / 4 != Terminals::G) G[place[e] * row] += change.g[e];  // the gate current is 0
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t u = static_cast<std::size_t>(terminals_[4 * p.device + k]);
        I[u * row] += change.i[k], Q[u * row] += change.q[k];
        block.looked[4 * p.device + k].of[p.chip] = block.x[u].of[p.chip];
    }
}

/// Prefetches the data of the next replace_linearization(), which is mostly in a slower cache.
void ChipMemory::fetch(const Picked& p) const {
    const std::size_t* const place = places_.data() + 16 * p.device;
    for (std::size_t e = 0; e < 16; ++e) {
        __builtin_prefetch(block.G[place[e]].of, 1);
        __builtin_prefetch(block.C[place[e]].of, 1);
    }
    const auto* const line = reinterpret_cast<const char*>(&lines_[p.chip * transistors_ + p.device]);
    for (std::size_t at = 0; at < sizeof(StraightLine); at += 64) __builtin_prefetch(line + at, 1);
}

void ChipMemory::look(const lanes::ChipLanes& kernels, std::uint8_t chips, double gmin) {
    kernels.moved(block, far, moved_.data());
    picked_.clear(), picked_of_.clear();
    for (std::size_t d = 0; d < transistors_; ++d)
        for (unsigned bits = moved_[d] & chips; bits != 0; bits &= bits - 1) {
            const auto chip = static_cast<std::size_t>(__builtin_ctz(bits));
            picked_.push_back({d, chip}), picked_of_.push_back(of_[chip * transistors_ + d]);
        }
    if (picked_.empty()) return;
    const std::size_t stride = (picked_.size() + lanes::chips - 1) / lanes::chips * lanes::chips;
    picked_of_.resize(stride, picked_of_.back());
    double* const v = at_[0].of;
    for (std::size_t k = 0; k < stride; ++k) {
        const auto& p = picked_[std::min(k, picked_.size() - 1)];
        for (std::size_t j = 0; j < 4; ++j) v[j * stride + k] = block.x[terminals_[4 * p.device + j]].of[p.chip];
    }
    kernels.picked({picked_of_.data(), picked_.size(), stride, v, gmin, fresh_.data()});
    for (std::size_t k = 0; k < picked_.size(); ++k) {
        if (k + 1 < picked_.size()) fetch(picked_[k + 1]);
        renew(picked_[k], fresh_[k]);
    }
}

bool ChipMemory::look_at_others(std::size_t chip, const System& system, const Instant& context, std::vector<double>& limiting_state) {
    bool limited = false;
    for (auto& o : others_[chip]) {
        const Device& d = *system.devices()[o.number];
        const auto n = o.unknowns.size();
        for (std::size_t j = 0; j < n; ++j) o.v[j] = o.unknowns[j] < 0 ? 0 : block.x[o.unknowns[j]].of[chip];
        o.looked = o.v;
        limited |= d.memory() > 0 && d.limit(o.looked, system.memory_of(o.number, limiting_state));
        std::fill(o.line.begin(), o.line.end(), 0.0);
        const std::span<double> all(o.line);
        const auto i = all.first(n), q = all.subspan(n, n), g = all.subspan(2 * n, n * n), c = all.subspan(2 * n + n * n);
        d.eval(o.looked, context, {i, q, g, c});
        for (std::size_t row = 0; row < n; ++row) {
            for (std::size_t column = 0; column < n; ++column) {
                const auto e = row * n + column;
                i[row] -= g[e] * o.looked[column], q[row] -= c[e] * o.looked[column];
                if (o.places[e] >= block.entries) continue;
                block.G[o.places[e]].of[chip] += g[e] - o.before[2 * n + e];
                block.C[o.places[e]].of[chip] += c[e] - o.before[2 * n + n * n + e];
            }
            if (o.unknowns[row] < 0) continue;
            block.I[o.unknowns[row]].of[chip] += i[row] - o.before[row];
            block.Q[o.unknowns[row]].of[chip] += q[row] - o.before[n + row];
        }
        std::swap(o.before, o.line);
    }
    return limited;
}

bool ChipMemory::formulas_hold(std::size_t chip, const System& system, const Instant& context, const FormulaTolerance& tolerance) {
    for (auto& o : others_[chip]) {
        const Device& d = *system.devices()[o.number];
        if (!d.jumps()) continue;
        const auto n = o.unknowns.size();
        for (std::size_t j = 0; j < n; ++j) o.v[j] = o.unknowns[j] < 0 ? 0 : block.x[o.unknowns[j]].of[chip];
        std::fill(o.line.begin(), o.line.end(), 0.0);
        const std::span<double> all(o.line);
        const auto f = all.first(n);
        d.eval(o.v, context, {f, all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
        for (std::size_t row = 0; row < n; ++row) {
            double linear = o.before[row];
            for (std::size_t column = 0; column < n; ++column) linear += o.before[2 * n + row * n + column] * o.v[column];
            const bool is_voltage = o.unknowns[row] >= 0 && !system.is_voltage(o.unknowns[row]);
            const double scale = is_voltage ? std::abs(o.v[0] - o.v[1]) : std::max(std::abs(f[row]), std::abs(linear));
            if (!tolerance.holds(is_voltage, f[row] - linear, scale)) return false;
        }
    }
    return true;
}

}  // namespace corpuscle::circuit
