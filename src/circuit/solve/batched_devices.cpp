#include "circuit/solve/step_equations.hpp"

#include <type_traits>

namespace corpuscle::circuit {

BatchedDevices::ScatterAdd BatchedDevices::make_scatter(std::vector<std::pair<int, int>> to_from) {
    std::map<int, std::vector<int>> sources;
    for (const auto& [to, from] : to_from) sources[to].push_back(from);
    std::vector<std::pair<std::size_t, int>> order;  // (terms, target): sums of equal length together, for branch prediction
    for (const auto& [to, from] : sources) order.emplace_back(from.size(), to);
    std::sort(order.begin(), order.end());
    ScatterAdd out;
    for (const auto& [terms, to] : order) {
        if (out.runs.empty() || out.runs.back().terms != static_cast<int>(terms)) out.runs.push_back({static_cast<int>(terms), 0});
        ++out.runs.back().count;
        out.to.push_back(to);
        out.from.insert(out.from.end(), sources[to].begin(), sources[to].end());
    }
    return out;
}

void BatchedDevices::ScatterAdd::add(const double* numbers, double* out) const {
    const int *source = from.data(), *target = to.data();
    const auto run = [&](auto terms, int count) {
        for (int k = 0; k < count; ++k) {
            double sum = out[*target];
            for (int j = 0; j < terms; ++j) sum += numbers[*source++];
            out[*target++] = sum;
        }
    };
    for (const auto& [terms, count] : runs) switch (terms) {  // short sums are unrolled
            case 1:
                run(std::integral_constant<int, 1>(), count);
                break;
            case 2:
                run(std::integral_constant<int, 2>(), count);
                break;
            case 3:
                run(std::integral_constant<int, 3>(), count);
                break;
            case 4:
                run(std::integral_constant<int, 4>(), count);
                break;
            default:
                run(terms, count);
        }
}

BatchedDevices::BatchedDevices(const System& system) {
    const int ground = system.size();
    std::vector<std::pair<int, int>> slopes, currents, charges;
    std::size_t at = 0;
    for (const auto& group : system.groups()) {
        const auto n = group.terminals, stride = group.stride;
        buffers_.push_back({group, at});
        const auto f = at + n * stride, q = f + n * stride, df = q + n * stride;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < stride; ++k) {
                const int u = group.unknowns[std::min(k, group.members.size() - 1) * n + j];
                terminals_.push_back(u < 0 ? ground : u);
                if (u < 0 || k >= group.members.size()) continue;
                currents.emplace_back(u, static_cast<int>(f + j * stride + k));
                charges.emplace_back(u, static_cast<int>(q + j * stride + k));
            }
        for (std::size_t k = 0; k < group.members.size(); ++k)
            for (std::size_t entry = 0; entry < n * n; ++entry)
                if (const auto matrix_entry = group.entries[k * n * n + entry]; matrix_entry < system.pattern().entries())
                    slopes.emplace_back(static_cast<int>(matrix_entry), static_cast<int>(df + entry * stride + k));
        at += (3 * n + 2 * n * n) * stride;
    }
    lines_.resize(at / 8);
    slopes_ = make_scatter(std::move(slopes)), currents_ = make_scatter(std::move(currents)), charges_ = make_scatter(std::move(charges));
}

void BatchedDevices::evaluate(const EvalContext& context, double rate, const std::vector<double>& x, std::vector<double>& J,
                              std::vector<double>& r) {
    const int* terminal = terminals_.data();
    for (const auto& buffer : buffers_) {
        const auto n = buffer.group.terminals, stride = buffer.group.stride;
        double *const v = numbers() + buffer.offset, *const f = v + n * stride, *const q = f + n * stride, *const df = q + n * stride;
        for (std::size_t k = 0; k < n * stride; ++k) v[k] = x[static_cast<std::size_t>(*terminal++)];
        buffer.group.batch->eval(context, {stride, v, f, df, nullptr, q, df + n * n * stride, rate});
    }
    slopes_.add(numbers(), J.data());
    currents_.add(numbers(), r.data());
}

void BatchedDevices::add_charges(const std::vector<double>& step, std::vector<double>& q) {
    const int* terminal = terminals_.data();
    for (const auto& buffer : buffers_) {
        const auto n = buffer.group.terminals, stride = buffer.group.stride;
        double *const dv = numbers() + buffer.offset, *const charges = dv + 2 * n * stride, *const dq = charges + (1 + n) * n * stride;
        for (std::size_t k = 0; k < n * stride; ++k) dv[k] = step[static_cast<std::size_t>(*terminal++)];
        buffer.group.batch->extrapolate(stride, dv, dq, charges);
    }
    charges_.add(numbers(), q.data());
}

}  // namespace corpuscle::circuit
