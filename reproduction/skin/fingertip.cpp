#include "reproduction/skin/fingertip.hpp"

#include <fmt/format.h>
#include <cmath>

#include "reproduction/skin/skin_touch.hpp"

namespace corpuscle {
namespace {

constexpr Position fingertip_centre{0, 12e-3};  // m: x, y of the middle of the built-in fingertip

}  // namespace

Result<std::vector<FingertipTrain>> simulate_fingertip(const Punch& punch) {
    const auto tip = TRY(skin_without_conduction("fingertip"));
    const Position centre{fingertip_centre.x + punch.shift.x, fingertip_centre.y + punch.shift.y};
    std::vector<std::string> settings = {fmt::format("press.F_min={}", punch.rest_force), fmt::format("press.F_max={}", punch.force),
                                         fmt::format("contact.radius={}", punch.radius), fmt::format("contact.x={}", centre.x),
                                         fmt::format("contact.y={}", centre.y)};
    if (punch.tilt > 0)
        settings.push_back(fmt::format("contact.tilt={}", punch.tilt)),
            settings.push_back(fmt::format("contact.azimuth={}", punch.azimuth));
    auto trains = TRY(simulate_touch(tip, {"press", "flat", std::move(settings)}));
    std::vector<FingertipTrain> out;
    for (std::size_t k = 0; k < trains.size(); ++k) {
        const auto& u = tip->afferents[k];
        const double dx = u.position.x - centre.x, dy = u.position.y - centre.y;
        out.push_back({tip->plan.classes[u.class_index].name, std::hypot(dx, dy), std::move(trains[k]), u.direction});
    }
    return out;
}

}  // namespace corpuscle
