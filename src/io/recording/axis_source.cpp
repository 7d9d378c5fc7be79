// Combines the columns of three-axis sensors to normal force and shear, block by block.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "core/number/elementary.hpp"
#include "core/text/ascii_text.hpp"
#include "io/recording/force_axes.hpp"

namespace corpuscle {
namespace {

constexpr double half_pi = std::numbers::pi / 2;

class AxisSource final : public ForceSource {
    std::unique_ptr<ForceSource> columns_;
    std::vector<AxisSensor> sensors_;
    std::string path_;
    std::vector<Channel> channels_;
    Frames block_{0, 0};                    // of columns_
    std::int64_t samples_ = 0;              // read so far
    std::vector<double> lowest_, highest_;  // normal force of each sensor so far, N

    /// Normal force and shear of one sample of a sensor, N: from F_x, F_y and F_z.
    static std::array<double, 3> from_components(const SensorAxes& a, double x, double y, double z) {
        return {a.normal * z, a.x[0] * x + a.x[1] * y, a.y[0] * x + a.y[1] * y};
    }
    /// The same from magnitude (N), inclination and azimuth (rad).
    static std::array<double, 3> from_angles(const SensorAxes& a, double magnitude, double inclination, double azimuth) {
        const double turn = 1 / (2 * std::numbers::pi), shear = magnitude * num::sin_turns(inclination * turn);
        return from_components(a, shear * num::cos_turns(azimuth * turn), shear * num::sin_turns(azimuth * turn),
                               a.normal * magnitude * num::cos_turns(inclination * turn));
    }

    Result<void> check_inclination(std::size_t sensor, double inclination, std::size_t sample) const {
        if (inclination >= 0 && inclination <= half_pi * (1 + 1e-12)) return {};
        return bad_input(
            fmt::format("the inclination of '{}' is {:g} degrees at sample {}, outside [0, 90]; it must be the angle between the force "
                        "and the inward normal. A sensor that also pulls needs the columns Fx, Fy and Fz",
                        sensors_[sensor].name, inclination * 180 / std::numbers::pi, samples_ + static_cast<std::int64_t>(sample)),
            {path_});
    }

    Result<void> combine(std::size_t s, Frames& out) {
        const auto *first = block_.force[3 * s].data(), *second = block_.force[3 * s + 1].data(), *third = block_.force[3 * s + 2].data();
        const auto& sensor = sensors_[s];
        for (std::size_t k = 0; k < block_.count; ++k) {
            if (sensor.has_angles) TRY(check_inclination(s, second[k], k));
            const auto force = sensor.has_angles ? from_angles(sensor.axes, first[k], second[k], third[k])
                                                 : from_components(sensor.axes, first[k], second[k], third[k]);
            out.force[s][k] = force[0];
            lowest_[s] = std::min(lowest_[s], force[0]), highest_[s] = std::max(highest_[s], force[0]);
            if (!out.shear_x.empty()) out.shear_x[s][k] = force[1], out.shear_y[s][k] = force[2];
        }
        return {};
    }

public:
    AxisSource(std::unique_ptr<ForceSource> columns, std::vector<AxisSensor> sensors, std::vector<std::optional<Position>> placed,
               std::string path)
        : columns_(std::move(columns)), sensors_(std::move(sensors)), path_(std::move(path)), lowest_(sensors_.size(), 0),
          highest_(sensors_.size(), 0) {
        for (std::size_t s = 0; s < sensors_.size(); ++s)
            channels_.push_back({static_cast<std::uint32_t>(s), sensors_[s].name, placed.empty() ? std::nullopt : placed[s]});
    }

    bool is_recording() const override { return true; }
    const std::string& name() const override { return columns_->name(); }
    const Clock& clock() const override { return columns_->clock(); }
    const std::vector<Channel>& channels() const override { return channels_; }
    bool has_shear() const override { return true; }
    double progress() const override { return columns_->progress(); }
    std::string description() const override {
        return fmt::format("{} of {}", sensors_.size() == 1 ? "a three-axis sensor" : fmt::format("{} three-axis sensors", sensors_.size()),
                           columns_->description());
    }
    std::vector<MetadataEntry> metadata() const override { return columns_->metadata(); }

    std::vector<std::string> notes() const override {
        auto out = columns_->notes();
        out.push_back(
            fmt::format("{} is read as {}: pressing is positive, and the force is that on the skin. A population (--population) feels the "
                        "shear, too; single afferents have the normal force only",
                        sensors_.size() == 1 ? fmt::format("'{}'", sensors_[0].name) : fmt::format("each of {} sensors", sensors_.size()),
                        sensors_[0].has_angles ? "one force with two angles" : "one force with three axes"));
        return out;
    }

    RecordingQuality quality() const override {
        auto out = columns_->quality();
        std::vector<QualityMetric> metrics;
        for (auto& m : out.metrics) {  // of the column with the normal force or the magnitude
            const auto& sensor = sensors_[m.channel / 3];
            if (sensor.has_angles && m.name == "noise") continue;  // a deadband, its remedy, does not apply to angles
            if (m.channel % 3 == (sensor.has_angles ? 0U : 2U)) m.channel /= 3, metrics.push_back(m);
        }
        out.metrics = std::move(metrics);
        std::vector<std::string> negative;
        for (std::size_t s = 0; s < sensors_.size(); ++s)
            if (lowest_[s] < 0 && !(highest_[s] > 0)) negative.push_back("'" + sensors_[s].name + "'");
        if (negative.size() > 6) negative.resize(6), negative.push_back("...");
        if (!negative.empty())
            out.warnings.push_back(fmt::format(
                "the normal force of {} is never positive, so nothing presses. If the file has the force of the skin on the object, "
                "use --scale -1 (in newtons). If the z axis of the sensor points out of the skin, give a --layout with z_axis = out",
                joined(negative)));
        return out;
    }

    Result<void> read(Frames& out) override {
        if (block_.capacity < out.capacity) block_ = Frames(3 * sensors_.size(), out.capacity);
        block_.capacity = out.capacity;
        TRY(columns_->read(block_));
        out.count = block_.count;
        for (std::size_t s = 0; s < sensors_.size(); ++s) TRY(combine(s, out));
        samples_ += static_cast<std::int64_t>(block_.count);
        return {};
    }
};

}  // namespace

std::unique_ptr<ForceSource> combine_axes(std::unique_ptr<ForceSource> columns, std::vector<AxisSensor> sensors,
                                          std::vector<std::optional<Position>> placed, const std::string& path) {
    return std::make_unique<AxisSource>(std::move(columns), std::move(sensors), std::move(placed), path);
}

}  // namespace corpuscle
