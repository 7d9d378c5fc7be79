#include "model/sensor/front_end.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {

FrontEnd::FrontEnd(std::vector<FrontEndStage> stages, double F_cal) : stages_(std::move(stages)), F_cal_(F_cal) {
    at_zero_ = read(0).value;
    at_cal_ = read(F_cal_).value;
}

double FrontEnd::apply_hysteresis(double last, double F) const {
    const double h = stages_.empty() ? 0 : stages_.front().hysteresis;
    return F > 0 ? std::min(std::max(last, F), (1 + h) * F) : F;
}

FrontEnd::SensorReading FrontEnd::read(double sensed, double* stage_outputs) const {
    SensorReading r{sensed};
    for (const auto& stage : stages_) {
        r.value = stage.curve(r.value);
        if (r.value > stage.limit) r.value = stage.limit, r.saturated = true;
        if (stage_outputs) *stage_outputs++ = r.value;
    }
    return r;
}

double FrontEnd::inverse(double value, double low, double high) const {
    for (int halving = 0; halving < 64; ++halving) {  // the number of halvings is fixed, so that the result is the same on every machine
        const double middle = 0.5 * (low + high);
        (read(middle).value < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Result<void> FrontEnd::check_range(std::string_view name, double low, std::string_view parameter, double high) const {
    double x = high;
    for (const auto& s : stages_) {
        x = s.curve(x);
        if (x > s.limit)
            return bad_input(fmt::format("{}: at {} = {:g} N {} would be {:.4g} {}, above {} = {:g} {}; lower {} or {}", name, parameter,
                                         high, s.output.name, x, s.output.unit, s.limit_name, s.limit, s.output.unit, s.gain_name,
                                         parameter));
    }
    if (read(high).value > read(low).value) return {};
    return bad_input(
        fmt::format("{}: {} = {:g} N gives the same reading as {:g} N with this sensor; raise {}", name, parameter, high, low, parameter));
}

}  // namespace corpuscle
