#include "reproduction/skin/slip_experiment.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {
namespace {

constexpr Position tip_middle{0, 12e-3};  // m
constexpr double contact_begin = 0.1;     // s
constexpr double press_duration = 0.1;    // s, in which the force rises
constexpr double pull_begin = 0.3;        // s
constexpr double pull_speed = 10e-3;      // m/s
constexpr double lift_begin = 1.0;        // s

Result<std::vector<SpikeTimes>> lift(const std::shared_ptr<const Innervation>& skin, double friction) {
    return simulate_touch(
        skin,
        {"ramp-hold",
         "sphere",
         {fmt::format("ramp-hold.F_max={}", slip_force), fmt::format("ramp-hold.t_rest={}", contact_begin),
          fmt::format("ramp-hold.t_up={}", press_duration), fmt::format("ramp-hold.t_hold={}", lift_begin - contact_begin - press_duration),
          fmt::format("ramp-hold.t_down={}", slip_lift), "ramp-hold.t_post=0.1", fmt::format("contact.radius={}", slip_radius),
          fmt::format("contact.E_star={}", slip_E_star), fmt::format("contact.friction={}", friction),
          fmt::format("contact.x={}", tip_middle.x), fmt::format("contact.y={}", tip_middle.y), fmt::format("contact.x1={}", tip_middle.x),
          fmt::format("contact.y1={}", tip_middle.y + slip_pull), fmt::format("contact.t_start={}", pull_begin),
          fmt::format("contact.speed={}", pull_speed)},
         2e3});
}

void add(SlipResponse::Part& part, std::size_t with, std::size_t without) {
    part.afferents += with > 0, part.spikes += static_cast<double>(with);
    part.afferents_without += without > 0, part.spikes_without += static_cast<double>(without);
    part.only += with > 0 && without == 0;
}

}  // namespace

double time_to_full_slip() {
    const double a = std::sqrt(2 * slip_radius * slip_pull / (3 * slip_friction));  // m: the contact's radius when c = 0
    const double force = std::pow(a, 3) * 4 * slip_E_star / (3 * slip_radius);      // N
    return slip_lift * (1 - force / slip_force);
}

Result<std::vector<SlipResponse>> measure_slip(const std::shared_ptr<const Innervation>& fingertip) {
    const auto with = TRY(lift(fingertip, slip_friction)), without = TRY(lift(fingertip, 0));
    const double slips = lift_begin + time_to_full_slip(), end = lift_begin + slip_lift;
    std::vector<SlipResponse> out;
    for (const auto& c : fingertip->plan.classes) out.push_back({c.name, {}, {}});
    for (std::size_t u = 0; u < with.size(); ++u) {
        auto& response = out[fingertip->afferents[u].class_index];
        add(response.partial, spikes_between(with[u], lift_begin, slips), spikes_between(without[u], lift_begin, slips));
        add(response.full, spikes_between(with[u], slips, end), spikes_between(without[u], slips, end));
    }
    return out;
}

}  // namespace corpuscle
