#include "study/thesis/press.hpp"

#include <fmt/format.h>

namespace corpuscle::press {

Result<Line> force_curve(double T) {
    auto stimulus = touch_of({.afferent = {}, .rate = 1 / T});
    if (!stimulus) return stimulus.error();
    return stimulus->line();
}

std::string phase_counts(const std::vector<double>& train) {
    std::string out;
    for (const auto* phase : {&rest, &protraction, &plateau, &retraction, &after})
        out += fmt::format("{}{:g}", out.empty() ? "" : " ", spike_count(train, *phase));
    return out;
}

Line frequency_at_start(const std::vector<double>& train) {
    Line out{{}, instantaneous_rates(train)};
    if (!train.empty()) out.x.assign(train.begin(), train.end() - 1);
    return out;
}

Line frequency_at_end(const std::vector<double>& train) {
    Line out{{}, instantaneous_rates(train)};
    if (!train.empty()) out.x.assign(train.begin() + 1, train.end());
    return out;
}

Claim& set_reference(Claim& c, double value, const std::string& mark) {
    c.source = fmt::format("{}: {}", quantity_of(value, c), mark);
    return c;
}

Asked thesis_algorithm(std::string afferent, std::vector<std::string> settings) {
    return {
        .afferent = std::move(afferent), .settings = std::move(settings), .rate = 1e3, .method = Method::backward_euler, .sampled = true};
}

}  // namespace corpuscle::press
