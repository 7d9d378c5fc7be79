#include "circuit/solve/system.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/device/constants.hpp"
#include "circuit/device/values.hpp"
#include "circuit/devices.hpp"
#include "circuit/solve/topology.hpp"

namespace corpuscle::circuit {

class System::Maker final : public Setup {
    System& system_;
    std::vector<int> branches_;

public:
    explicit Maker(System& system) : system_(system), branches_(system.circuit_->elements.size(), -1) {
        const auto& c = *system_.circuit_;
        for (std::size_t k = 1; k < c.nodes.size(); ++k) system_.names_.push_back("v(" + c.nodes[k] + ")");
        system_.nodes_ = static_cast<int>(system_.names_.size());
        for (std::size_t k = 0; k < c.elements.size(); ++k) {
            if (!has_branch_current(c.elements[k])) continue;
            branches_[k] = static_cast<int>(system_.names_.size());
            system_.names_.push_back("i(" + c.elements[k].name + ")");
        }
    }
    int node(int number) const override { return number - 1; }
    int branch(int element) const override { return element < 0 ? -1 : branches_[static_cast<std::size_t>(element)]; }
    int own(std::string_view name) override {
        system_.names_.push_back(fmt::format("v({})", name));
        return static_cast<int>(system_.names_.size()) - 1;
    }
    double temperature(const Element& e) const override {
        return value_or(e.values, "temp", circuit().temperature + value_or(e.values, "dtemp", 0)) + zero_celsius;
    }
    const Circuit& circuit() const override { return *system_.circuit_; }
};

Result<System> System::make(std::shared_ptr<const Circuit> circuit) {
    if (auto wrong = unanswerable(*circuit)) return *wrong;
    System system;
    system.circuit_ = std::move(circuit);
    Maker maker(system);
    for (const auto& e : system.circuit_->elements) {
        const auto* kind = find_device_kind(e.letter);
        if (kind == nullptr) return bad_input(fmt::format("{}: no device has the letter '{}'", e.name, e.letter), e.location);
        auto device = kind->make(e, maker);
        if (!device) return device.error();
        (*device)->name = e.name, (*device)->place = e.location;
        system.memory_at_.push_back(system.memory_);
        system.memory_ += (*device)->memory();
        system.devices_.push_back(std::move(*device));
    }
    std::vector<std::pair<int, int>> entries;
    for (int k = 0; k < system.size(); ++k) entries.emplace_back(k, k);
    for (const auto& d : system.devices_)
        for (const int row : d->unknowns)
            for (const int column : d->unknowns)
                if (row >= 0 && column >= 0) entries.emplace_back(row, column);
    system.pattern_ = std::make_unique<Pattern>(system.size(), std::move(entries));
    for (const auto& d : system.devices_) {
        auto& places = system.places_.emplace_back();
        for (const int row : d->unknowns)
            for (const int column : d->unknowns)
                places.push_back(row >= 0 && column >= 0 ? system.pattern_->place(row, column) : system.pattern_->entries());
    }
    if (auto ok = system.make_groups(); !ok) return ok.error();
    system.linear_ = std::all_of(system.devices_.begin(), system.devices_.end(), [](const auto& d) { return d->linear(); });
    return system;
}

Result<void> System::make_groups() {
    for (const auto& kind : circuit::devices) {
        std::vector<std::size_t> members;
        for (std::size_t k = 0; k < devices_.size(); ++k)
            if (circuit_->elements[k].letter == kind.letter) members.push_back(k);
        if (members.empty()) continue;
        if (kind.make_batch == nullptr) {
            alone_.insert(alone_.end(), members.begin(), members.end());
            continue;
        }
        auto bank = kind.make_batch();
        if (!bank) return bank.error();
        Group group{std::move(*bank), {}, devices_[members[0]]->unknowns.size(), (members.size() + 7) / 8 * 8, {}, {}};
        for (const auto k : members) {
            group.members.push_back(devices_[k].get());
            group.unknowns.insert(group.unknowns.end(), devices_[k]->unknowns.begin(), devices_[k]->unknowns.end());
            group.places.insert(group.places.end(), places_[k].begin(), places_[k].end());
        }
        group.bank->take(group.members);
        groups_.push_back(std::move(group));
    }
    return {};
}

void System::go(double step, double stop) {
    for (const auto& d : devices_) d->go(step, stop);
}

double System::pace() const {
    double step = std::numeric_limits<double>::infinity();
    for (const auto& d : devices_) step = std::min(step, d->pace());
    return step;
}

double System::next_corner(double t) const {
    double time = std::numeric_limits<double>::infinity();
    for (const auto& d : devices_) time = std::min(time, d->next_corner(t));
    return time;
}

bool System::hear(const ForceWaveform* force) {
    bool any = false;
    for (const auto& d : devices_) any |= d->hear(force);
    return any;
}

void System::draw(const Draw* chip) {
    std::uint32_t index = 0;
    for (const auto& d : devices_) index += d->draw(chip, index);
    for (const auto& group : groups_) group.bank->take(group.members);
}

int System::unknown(std::string_view name) const {
    const auto at = std::find(names_.begin(), names_.end(), name);
    return at == names_.end() ? -1 : static_cast<int>(at - names_.begin());
}

Device* System::device(std::string_view name) const {
    const auto at = std::find_if(devices_.begin(), devices_.end(), [&](const auto& d) { return d->name == name; });
    return at == devices_.end() ? nullptr : at->get();
}

std::vector<double> System::terminals(const Device& d, std::span<const double> x) const {
    std::vector<double> v;
    for (const int u : d.unknowns) v.push_back(u < 0 ? 0 : x[static_cast<std::size_t>(u)]);
    return v;
}

void System::eval(std::span<const double> x, const Instant& context, std::vector<double>& limiting_state, Sums& sums) const {
    const auto count = static_cast<std::size_t>(size());
    sums.f.assign(count, 0), sums.q.assign(count, 0), sums.size.assign(count, 0), sums.grain.assign(count, 0);
    sums.G.assign(pattern_->entries() + 1, 0), sums.C.assign(pattern_->entries() + 1, 0);  // the last: ground
    sums.limited = false;
    for (const auto k : alone_) add_device(k, x, context, limiting_state, sums);
    for (const auto& group : groups_) add_group(group, x, context, sums);
}

void System::add_device(std::size_t k, std::span<const double> x, const Instant& context, std::vector<double>& limiting_state,
                        Sums& sums) const {
    const Device& d = *devices_[k];
    const auto n = d.unknowns.size();
    if (sums.v_.size() < n) sums.v_.resize(n), sums.looked_.resize(n), sums.own_.resize(2 * n + 2 * n * n);
    const auto v = std::span(sums.v_).first(n), limited_v = std::span(sums.looked_).first(n),
               stamp_buffer = std::span(sums.own_).first(2 * n + 2 * n * n);
    for (std::size_t j = 0; j < n; ++j) v[j] = d.unknowns[j] < 0 ? 0 : x[static_cast<std::size_t>(d.unknowns[j])];
    std::copy(v.begin(), v.end(), limited_v.begin());
    const bool limited = d.memory() > 0 && d.limit(limited_v, memory_of(k, limiting_state));
    sums.limited |= limited;
    std::fill(stamp_buffer.begin(), stamp_buffer.end(), 0.0);
    const Stamp stamp{stamp_buffer.first(n), stamp_buffer.subspan(n, n), stamp_buffer.subspan(2 * n, n * n),
                      stamp_buffer.subspan(2 * n + n * n)};
    d.eval(limited_v, context, stamp);
    const auto& places = places_[k];
    for (std::size_t row = 0; row < n; ++row) {
        double f = stamp.f[row], q = stamp.q[row], roundoff = 0;
        for (std::size_t column = 0; column < n; ++column) {
            if (limited) {
                f += stamp.slope(row, column) * (v[column] - limited_v[column]);
                q += stamp.capacitance(row, column) * (v[column] - limited_v[column]);
            }
            roundoff = std::max(roundoff, std::abs(stamp.slope(row, column) * v[column]));
            sums.G[places[row * n + column]] += stamp.slope(row, column);
            sums.C[places[row * n + column]] += stamp.capacitance(row, column);
        }
        if (d.unknowns[row] < 0) continue;
        const auto u = static_cast<std::size_t>(d.unknowns[row]);
        sums.f[u] += f, sums.q[u] += q;
        sums.size[u] = std::max(sums.size[u], std::abs(f));
        sums.grain[u] = std::max(sums.grain[u], 1e-15 * roundoff);
    }
}

void System::add_group(const Group& group, std::span<const double> x, const Instant& context, Sums& sums) const {
    const auto n = group.terminals, stride = group.room, count = group.members.size();
    const auto line_count = (4 * n + 2 * n * n) * stride / 8;
    if (sums.side_by_side_.size() < line_count) sums.side_by_side_.resize(line_count);
    double* const v = sums.side_by_side_.data()->of;
    double *const f = v + n * stride, *const max_term = f + n * stride, *const df = max_term + n * stride;
    double *const q = df + n * n * stride, *const dq = q + n * stride;
    for (std::size_t k = 0; k < stride; ++k) {
        const auto* unknowns = group.unknowns.data() + std::min(k, count - 1) * n;
        for (std::size_t j = 0; j < n; ++j) v[j * stride + k] = unknowns[j] < 0 ? 0 : x[static_cast<std::size_t>(unknowns[j])];
    }
    group.bank->eval(context, {stride, v, f, df, max_term, context.charges ? q : nullptr, dq});
    for (std::size_t k = 0; k < count; ++k) {
        const auto* unknowns = group.unknowns.data() + k * n;
        const auto* places = group.places.data() + k * n * n;
        for (std::size_t entry = 0; entry < n * n; ++entry) sums.G[places[entry]] += df[entry * stride + k];
        for (std::size_t row = 0; row < n; ++row) {
            if (unknowns[row] < 0) continue;
            const auto u = static_cast<std::size_t>(unknowns[row]);
            const double i = f[row * stride + k];
            sums.f[u] += i;
            sums.size[u] = std::max(sums.size[u], std::abs(i));
            sums.grain[u] = std::max(sums.grain[u], 1e-15 * max_term[row * stride + k]);
        }
        if (!context.charges) continue;
        for (std::size_t entry = 0; entry < n * n; ++entry) sums.C[places[entry]] += dq[entry * stride + k];
        for (std::size_t row = 0; row < n; ++row)
            if (unknowns[row] >= 0) sums.q[static_cast<std::size_t>(unknowns[row])] += q[row * stride + k];
    }
}

}  // namespace corpuscle::circuit
