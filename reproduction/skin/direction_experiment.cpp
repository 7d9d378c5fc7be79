#include "reproduction/skin/direction_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::directions {
namespace {

constexpr double radius = 5e-3, peak_force = 4, rest_force = 0.2;  // m, N, N
constexpr double place_shift = 4e-3;                               // m, of the places from the middle
constexpr auto abstract = "Birznieks et al. 2001, abstract";

struct ClassOfAfferents {
    const char *afferent, *name;
};
constexpr ClassOfAfferents classes[] = {{"sa1", "SA-I"}, {"fa1", "FA-I"}, {"sa2", "SA-II"}};

/// True for the class `type` ("sa1") and for classes calibrated to nerve data ("sa1-nerve").
bool is_of(const std::string& afferent, std::string_view type) { return afferent.substr(0, type.size()) == type; }

Punch punch(double angle, double azimuth, const Position& shift = {}) {
    return {.radius = radius, .force = peak_force, .rest_force = rest_force, .tilt = angle, .azimuth = azimuth, .shift = shift};
}

/// The afferents of one class that respond.
std::vector<AfferentTuning> responding(const std::vector<AfferentTuning>& all, std::string_view type) {
    std::vector<AfferentTuning> out;
    std::copy_if(all.begin(), all.end(), std::back_inserter(out), [&](const auto& u) { return is_of(u.afferent, type) && u.responds(); });
    return out;
}

template <class F>
double mean_over(const std::vector<AfferentTuning>& all, const F& value) {
    double sum = 0;
    for (const auto& u : all) sum += value(u);
    return all.empty() ? 0 : sum / static_cast<double>(all.size());
}

/// The mean number of spikes over the angle between the force and an afferent's preferred direction, in eight bins.
StudyCurve tuning_curve(const std::vector<AfferentTuning>& all) {
    constexpr std::size_t bins = 8;
    std::array<double, bins> sums{}, counts{};
    for (const auto& u : all)
        for (std::size_t d = 0; d < sides.size(); ++d) {
            double angle = sides[d].azimuth / 360 - u.direction / (2 * std::numbers::pi);  // turns
            angle -= std::floor(angle + 0.5);
            const auto bin = std::min(bins - 1, static_cast<std::size_t>((angle + 0.5) * bins));
            sums[bin] += u.spikes[d], counts[bin] += 1;
        }
    StudyCurve out;
    for (std::size_t b = 0; b < bins; ++b)
        if (counts[b] > 0) out.x.push_back(-180 + 45 * (static_cast<double>(b) + 0.5)), out.y.push_back(sums[b] / counts[b]);
    return out;
}

/// The largest angle (degrees) between neighbouring preferred directions, as they show in spikes.
double largest_gap(const std::vector<AfferentTuning>& all) {
    std::vector<double> angles;  // turns
    for (const auto& u : all)
        if (u.is_tuned()) angles.push_back(std::atan2(u.y(), u.x()) / (2 * std::numbers::pi));
    if (angles.empty()) return 360;
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 1 - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
    return std::round(360 * gap);
}

void report_class(StudyResult& out, const ClassOfAfferents& c, const std::vector<AfferentTuning>& units) {
    const std::string name = c.name;
    out.claim(name + ": spikes of an afferent, normal force", mean_over(units, [](const auto& u) { return u.normal; }), "spikes");
    for (std::size_t d = 0; d < sides.size(); ++d)
        out.claim(fmt::format("{}: spikes of an afferent, {}", name, sides[d].name),
                  mean_over(units, [d](const auto& u) { return u.spikes[d]; }), "spikes");
    out.claim(name + ": tuned to a direction, fraction of the afferents that respond",
              mean_over(units, [](const auto& u) { return u.is_tuned() ? 1.0 : 0.0; }))
        .allow_min(0.5, std::string(abstract) + ": most");
    out.claim(name + ": largest gap between preferred directions", largest_gap(units), "degrees")
        .allow_max(120, std::string(abstract) + ": preferred directions in all angular directions; at most 120 degrees here");
}

/// The bias of the preferred directions: the mean component along an axis, as a fraction of the mean length.
double bias(const std::vector<AfferentTuning>& all, bool along_y) {
    const double length = mean_over(all, [](const auto& u) { return std::hypot(u.x(), u.y()); });
    return length > 0 ? mean_over(all, [along_y](const auto& u) { return along_y ? u.y() : u.x(); }) / length : 0;
}

void report_biases(StudyResult& out, const std::vector<AfferentTuning>& all) {
    const auto of = [&](const char* type, bool along_y) { return bias(responding(all, type), along_y); };
    out.claim("SA-I: bias of the preferred directions to distal", of("sa1", true))
        .allow_min(0, std::string(abstract) + ": biased to distal");
    out.claim("SA-II: bias to proximal", -of("sa2", true)).allow_min(0, std::string(abstract) + ": biased to proximal");
    out.claim("FA-I: bias to proximal", -of("fa1", true)).allow_min(0, std::string(abstract) + ": biased to proximal and radial");
    out.claim("FA-I: bias to radial", of("fa1", false)).allow_min(0, std::string(abstract) + ": biased to proximal and radial");
}

/// The afferents that respond to a normal force at each place (fig. 4 B).
Result<void> report_places(StudyResult& out) {
    const auto report_place = [&](const std::string& name, const Position& shift) -> Result<void> {
        const auto trains = TRY(simulate_fingertip(punch(0, 0, shift)));
        for (const auto& c : classes) {
            const auto count = std::count_if(trains.begin(), trains.end(),
                                             [&](const auto& t) { return is_of(t.afferent, c.afferent) && !t.spikes.empty(); });
            out.claim(fmt::format("{}: afferents that respond, {}", c.name, name), static_cast<double>(count), "afferents");
        }
        return {};
    };
    TRY(report_place("in the middle", {}));
    for (const auto& s : sides) {
        const double angle = s.azimuth * std::numbers::pi / 180;
        TRY(report_place(fmt::format("4 mm {}", s.name),
                         {place_shift * std::round(std::cos(angle)), place_shift * std::round(std::sin(angle))}));
    }
    return {};
}

}  // namespace

bool AfferentTuning::is_tuned() const {
    const auto [low, high] = std::minmax_element(spikes.begin(), spikes.end());
    return *high - *low >= 2 && *high - *low >= 0.2 * mean();
}

Result<std::vector<AfferentTuning>> measure_tuning() {
    std::vector<AfferentTuning> out;
    const auto under_normal_force = TRY(simulate_fingertip(punch(0, 0)));
    for (const auto& t : under_normal_force) out.push_back({t.afferent, t.direction, static_cast<double>(t.spikes.size()), {}});
    for (std::size_t d = 0; d < sides.size(); ++d) {
        const auto trains = TRY(simulate_fingertip(punch(tilt, sides[d].azimuth)));
        for (std::size_t u = 0; u < trains.size(); ++u) out[u].spikes[d] = static_cast<double>(trains[u].spikes.size());
    }
    return out;
}

Result<void> report(StudyResult& out) {
    const auto all = TRY(measure_tuning());
    std::vector<std::pair<const char*, StudyCurve>> curves;
    for (const auto& c : classes) {
        const auto units = responding(all, c.afferent);
        report_class(out, c, units);
        curves.emplace_back(c.name, tuning_curve(units));
    }
    report_biases(out, all);
    TRY(report_places(out));
    auto& plot = out.plot("Spikes of an afferent and the direction of the force", "angle between force and preferred direction (degrees)",
                          "spikes in a press of 4 N, 20 degrees off the normal");
    for (auto& [name, curve] : curves) plot.add(name, std::move(curve));
    plot.describe_published("the thesis has no rates for directions; Birznieks et al. 2001 report broad tuning");
    out.note(
        "Directions and places (fig. 4 A, B): a flat punch of 5 mm radius on the built-in fingertip, with the force as above. The thesis "
        "prints "
        "five directions and several places, but no rates for them. The strength and spread of the tuning are choices (direction_gain and "
        "direction_spread in skins/fingertip.toml), and the mean directions were set to the biases that the abstract of Birznieks et al. "
        "2001 "
        "reports. So the claims on tuning test the simulation, not the nerve.");
    out.note(
        "Nearly all of the 196 afferents of the nerve responded, wherever in the end segment they were. Here only afferents near the punch "
        "respond, because the force does not spread through the finger.");
    return {};
}

}  // namespace corpuscle::directions
