#include "circuit/solve/system.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/devices.hpp"
#include "circuit/refusals.hpp"

namespace corpuscle::circuit {

class System::Builder final : public DeviceSetup {
    System& system_;
    std::vector<int> branches_;  // by element: unknown of its branch current; -1: none

public:
    explicit Builder(System& system) : system_(system), branches_(system.circuit_->elements.size(), -1) {
        const auto& c = *system_.circuit_;
        for (std::size_t k = 1; k < c.nodes.size(); ++k) system_.names_.push_back("v(" + c.nodes[k] + ")");
        system_.nodes_ = static_cast<int>(system_.names_.size());
        for (std::size_t k = 0; k < c.elements.size(); ++k) {
            if (!has_branch_current(c.elements[k])) continue;
            branches_[k] = static_cast<int>(system_.names_.size());
            system_.names_.push_back("i(" + c.elements[k].name + ")");
        }
    }
    int node_unknown(int number) const override { return number - 1; }
    int branch_unknown(int element) const override { return element < 0 ? -1 : branches_[static_cast<std::size_t>(element)]; }
    int branch_unknown(const Element& e) const override {
        return has_branch_current(e) ? branch_unknown(circuit().find_element(e.name)) : -1;
    }
    int add_unknown(std::string_view name) override {
        system_.names_.push_back(fmt::format("v({})", name));
        return static_cast<int>(system_.names_.size()) - 1;
    }
    double temperature(const Element& e) const override { return celsius_of(circuit(), e) + zero_celsius; }
    const Circuit& circuit() const override { return *system_.circuit_; }
};

namespace {

Result<std::unique_ptr<Device>> make_checked_device(const Element& e, DeviceSetup& setup) {
    if (const double celsius = celsius_of(setup.circuit(), e); !is_possible_temperature(celsius))
        return error_at(e.location, "{}: its temperature of {:g} C is outside (-273.15, {:g}]", e.name, celsius, max_celsius);
    return kind_of(e).make(e, setup);
}

}  // namespace

Result<System> System::make(std::shared_ptr<const Circuit> circuit) {
    TRY(check_solvable(*circuit));
    if (!is_possible_temperature(circuit->temperature))
        return error_at({circuit->file}, "the circuit's temperature of {:g} C is outside (-273.15, {:g}]", circuit->temperature,
                        max_celsius);
    System system;
    system.circuit_ = std::move(circuit);
    Builder builder(system);
    Refusals refusals;
    for (const auto& e : system.circuit_->elements) {
        auto made = make_checked_device(e, builder);
        if (!made) refusals.add(made.error());
        if (!refusals.empty()) continue;
        auto device = *std::move(made);
        device->name = e.name, device->location = e.location;
        system.limiting_state_offset_.push_back(system.limiting_state_size_);
        system.limiting_state_size_ += device->limiting_state_size();
        system.devices_.push_back(std::move(device));
    }
    if (!refusals.empty()) return refusals.combined();
    for (const auto& d : system.devices_) d->connect(system.devices_);
    for (std::size_t k = 0; k < system.devices_.size(); ++k) {
        if (system.devices_[k]->next_change()) system.devices_with_states_.push_back(k);
        if (system.devices_[k]->can_have_breakpoints()) system.devices_with_breakpoints_.push_back(k);
    }
    system.reset_states();
    for (const auto& name : system.names_) system.is_voltage_.push_back(name[0] == 'v');
    std::vector<std::pair<int, int>> entries;
    system.numbers_.reserve(system.names_.size());
    for (int k = 0; k < system.size(); ++k)
        entries.emplace_back(k, k), system.numbers_.try_emplace(system.names_[static_cast<std::size_t>(k)], k);
    for (const auto& d : system.devices_)
        for (const int row : d->unknowns)
            for (const int column : d->unknowns)
                if (row >= 0 && column >= 0) entries.emplace_back(row, column);
    system.pattern_ = std::make_unique<SparsityPattern>(system.size(), std::move(entries));
    for (const auto& d : system.devices_) {
        system.first_entry_.push_back(system.entries_.size());
        for (const int row : d->unknowns)
            for (const int column : d->unknowns)
                system.entries_.push_back(row >= 0 && column >= 0 ? system.pattern_->entry_index(row, column) : system.pattern_->entries());
    }
    TRY(system.make_groups());
    system.is_linear_ = std::all_of(system.devices_.begin(), system.devices_.end(), [](const auto& d) { return d->is_linear(); });
    return system;
}

Result<void> System::make_groups() {
    std::map<const DeviceKind*, std::vector<std::size_t>> members_of;
    for (std::size_t k = 0; k < devices_.size(); ++k) members_of[circuit_->elements[k].kind].push_back(k);
    for (const auto* kind : device_kinds) {
        const auto& members = members_of[kind];
        if (members.empty()) continue;
        if (kind->make_batch == nullptr) {
            scalar_devices_.insert(scalar_devices_.end(), members.begin(), members.end());
            continue;
        }
        auto batch = TRY(kind->make_batch());
        // All devices of a kind with batches have the same number of unknowns.
        DeviceGroup group{std::move(batch), {}, devices_[members[0]]->unknowns.size(), (members.size() + 7) / 8 * 8, {}, {}};
        for (const auto k : members) {
            group.members.push_back(devices_[k].get());
            group.unknowns.insert(group.unknowns.end(), devices_[k]->unknowns.begin(), devices_[k]->unknowns.end());
            const auto device_entries = entries(k);
            group.entries.insert(group.entries.end(), device_entries.begin(), device_entries.end());
        }
        group.batch->bind(group.members);
        groups_.push_back(std::move(group));
    }
    return {};
}

std::vector<char> System::states() const {
    std::vector<char> out;
    for (const auto k : devices_with_states_) out.push_back(devices_[k]->state());
    return out;
}

void System::set_states(std::span<const char> states) const {
    for (std::size_t k = 0; k < states.size(); ++k) devices_[devices_with_states_[k]]->set_state(states[k] != 0);
}

void System::reset_states() const {
    for (const auto k : devices_with_states_) devices_[k]->set_state(devices_[k]->initial_state());
}

double System::excess(std::size_t device, std::span<const double> x) const {
    const Device& d = *devices_[device];
    const auto change = *d.next_change();
    return change.excess(value_of(x, d.unknowns[change.plus]), change.minus ? value_of(x, d.unknowns[*change.minus]) : 0);
}

const Device* System::change_states(std::span<const double> x, bool first_only) const {
    const Device* changed = nullptr;
    for (const auto k : devices_with_states_) {
        if (!(excess(k, x) > 0)) continue;
        devices_[k]->set_state(!devices_[k]->state());
        changed = devices_[k].get();
        if (first_only) break;
    }
    return changed;
}

void System::start_transient(double step, double stop) {
    for (const auto& d : devices_) d->start_transient(step, stop);
}

double System::max_step() const {
    double step = std::numeric_limits<double>::infinity();
    for (const auto& d : devices_) step = std::min(step, d->max_step());
    return step;
}

double System::next_breakpoint(double t) const {
    double time = std::numeric_limits<double>::infinity();
    for (const auto k : devices_with_breakpoints_) time = std::min(time, devices_[k]->next_breakpoint(t));
    return time;
}

bool System::set_force_input(const ForceWaveform* force) {
    bool any = false;
    for (const auto& d : devices_) any |= d->set_force_input(force);
    return any;
}

void System::apply_variation(const ChipSample* chip) {
    std::uint32_t index = 0;
    for (const auto& d : devices_) index += d->apply_variation(chip, index);  // counts the devices with variation
    for (const auto& group : groups_) group.batch->bind(group.members);
}

int System::unknown(std::string_view name) const {
    const auto at = numbers_.find(name);
    return at == numbers_.end() ? -1 : at->second;
}

Device* System::device(std::string_view name) const {
    const auto at = std::find_if(devices_.begin(), devices_.end(), [&](const auto& d) { return d->name == name; });
    return at == devices_.end() ? nullptr : at->get();
}

std::vector<double> System::terminal_values(const Device& d, std::span<const double> x) const {
    std::vector<double> v;
    for (const int u : d.unknowns) v.push_back(value_of(x, u));
    return v;
}

void System::eval(std::span<const double> x, const EvalContext& context, std::vector<double>& limiting_state,
                  SystemEvaluation& sums) const {
    const auto count = static_cast<std::size_t>(size());
    sums.f.assign(count, 0), sums.q.assign(count, 0), sums.scale.assign(count, 0), sums.roundoff.assign(count, 0);
    sums.G.assign(pattern_->entries() + 1, 0), sums.C.assign(pattern_->entries() + 1, 0);  // the last element: ground
    sums.is_limited = false;
    for (const auto k : scalar_devices_) add_device(k, x, context, limiting_state, sums);
    for (const auto& group : groups_) add_group(group, x, context, sums);
}

void System::add_device(std::size_t k, std::span<const double> x, const EvalContext& context, std::vector<double>& limiting_state,
                        SystemEvaluation& sums) const {
    const Device& d = *devices_[k];
    const auto n = d.unknowns.size();
    auto &v = sums.v_, &limited_v = sums.limited_v_;
    v.resize(n);
    for (std::size_t j = 0; j < n; ++j) v[j] = value_of(x, d.unknowns[j]);
    limited_v = v;
    const bool limited = d.limits() && d.limit(limited_v, limiting_state_of(k, limiting_state));
    sums.is_limited |= limited;
    const Stamp stamp = sums.stamp_.eval(d, limited_v, context);
    const auto device_entries = entries(k);
    for (std::size_t row = 0; row < n; ++row) {
        double f = stamp.f[row], q = stamp.q[row], roundoff = 0;
        for (std::size_t column = 0; column < n; ++column) {
            if (limited) {
                f += stamp.slope(row, column) * (v[column] - limited_v[column]);
                q += stamp.capacitance(row, column) * (v[column] - limited_v[column]);
            }
            roundoff = std::max(roundoff, std::abs(stamp.slope(row, column) * v[column]));
            sums.G[device_entries[row * n + column]] += stamp.slope(row, column);
            sums.C[device_entries[row * n + column]] += stamp.capacitance(row, column);
        }
        if (d.unknowns[row] < 0) continue;
        const auto u = static_cast<std::size_t>(d.unknowns[row]);
        sums.f[u] += f, sums.q[u] += q;
        sums.scale[u] = std::max(sums.scale[u], std::abs(f));
        sums.roundoff[u] = std::max(sums.roundoff[u], 1e-15 * roundoff);
    }
}

void System::add_group(const DeviceGroup& group, std::span<const double> x, const EvalContext& context, SystemEvaluation& sums) const {
    const auto n = group.terminals, stride = group.stride, count = group.members.size();
    const auto line_count = (4 * n + 2 * n * n) * stride / 8;
    if (sums.batch_buffer_.size() < line_count) sums.batch_buffer_.resize(line_count);
    double* const v = sums.batch_buffer_.data()->values;
    double *const f = v + n * stride, *const max_term = f + n * stride, *const df = max_term + n * stride;
    double *const q = df + n * n * stride, *const dq = q + n * stride;
    for (std::size_t k = 0; k < stride; ++k) {
        const auto* unknowns = group.unknowns.data() + std::min(k, count - 1) * n;
        for (std::size_t j = 0; j < n; ++j) v[j * stride + k] = value_of(x, unknowns[j]);
    }
    group.batch->eval(context, {stride, v, f, df, max_term, context.with_charges ? q : nullptr, dq});
    for (std::size_t k = 0; k < count; ++k) {
        const auto* unknowns = group.unknowns.data() + k * n;
        const auto* device_entries = group.entries.data() + k * n * n;
        for (std::size_t entry = 0; entry < n * n; ++entry) sums.G[device_entries[entry]] += df[entry * stride + k];
        for (std::size_t row = 0; row < n; ++row) {
            if (unknowns[row] < 0) continue;
            const auto u = static_cast<std::size_t>(unknowns[row]);
            const double i = f[row * stride + k];
            sums.f[u] += i;
            sums.scale[u] = std::max(sums.scale[u], std::abs(i));
            sums.roundoff[u] = std::max(sums.roundoff[u], 1e-15 * max_term[row * stride + k]);
        }
        if (!context.with_charges) continue;
        for (std::size_t entry = 0; entry < n * n; ++entry) sums.C[device_entries[entry]] += dq[entry * stride + k];
        for (std::size_t row = 0; row < n; ++row)
            if (unknowns[row] >= 0) sums.q[static_cast<std::size_t>(unknowns[row])] += q[row * stride + k];
    }
}

/// Devices are evaluated at v = 0, where the currents are those at x = 0; the derivatives do not depend on v.
LinearSums sum_linear_devices(const System& system, const EvalContext& context) {
    const auto count = static_cast<std::size_t>(system.size()), entries = system.pattern().entries();
    LinearSums out{std::vector<double>(count + 1), std::vector<double>(entries + 1), std::vector<double>(entries + 1)};
    StampBuffer buffer;
    for (const auto k : system.scalar_devices()) {
        const Device& d = *system.devices()[k];
        if (!d.is_linear()) continue;
        const std::vector<double> zeros(d.unknowns.size());
        const auto stamp = buffer.eval(d, zeros, context);
        for (std::size_t e = 0; e < stamp.df.size(); ++e) {
            const auto entry = system.entries(k)[e];
            out.G[entry] += stamp.df[e], out.C[entry] += stamp.dq[e];
        }
        for (std::size_t row = 0; row < zeros.size() && !d.is_time_dependent(); ++row)
            out.currents[d.unknowns[row] < 0 ? count : static_cast<std::size_t>(d.unknowns[row])] += stamp.f[row];
    }
    return out;
}

}  // namespace corpuscle::circuit
