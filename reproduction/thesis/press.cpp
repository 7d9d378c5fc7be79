#include "reproduction/thesis/press.hpp"

#include <fmt/format.h>

namespace corpuscle::press {

Result<StudyCurve> force_curve(double T) {
    auto stimulus = TRY(trial_force({.afferent = {}, .rate = 1 / T}));
    return stimulus.curve();
}

std::string phase_counts(const std::vector<double>& train) {
    std::string out;
    for (const auto* phase : {&rest, &protraction, &plateau, &retraction, &after})
        out += fmt::format("{}{:g}", out.empty() ? "" : " ", spike_count(train, *phase));
    return out;
}

StudyCurve frequency_at_start(const std::vector<double>& train) {
    StudyCurve out{{}, instantaneous_rates(train)};
    if (!train.empty()) out.x.assign(train.begin(), train.end() - 1);
    return out;
}

StudyCurve frequency_at_end(const std::vector<double>& train) {
    StudyCurve out{{}, instantaneous_rates(train)};
    if (!train.empty()) out.x.assign(train.begin() + 1, train.end());
    return out;
}

TrialSpec thesis_algorithm(std::string afferent, std::vector<std::string> settings) {
    return {
        .afferent = std::move(afferent), .settings = std::move(settings), .rate = 1e3, .method = Method::backward_euler, .sampled = true};
}

}  // namespace corpuscle::press
