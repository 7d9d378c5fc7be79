#pragma once
// Sensors that measure force along three axes: which columns of a table belong to one sensor, and how their values become normal force and
// shear.

#include <array>

#include "io/recording/recording.hpp"

namespace corpuscle {

/// One column of a three-axis sensor. `magnitude`, `inclination` and `azimuth` are the form with two angles.
enum class ForceAxis { x, y, z, magnitude, inclination, azimuth };

/// A column name that ends in an axis: "r1c1.Fx", "index.tip_Fz", "wrench.force.y", "Fx3", "tip.inclination".
struct AxisName {
    std::string sensor;  ///< "r1c1", "index.tip", "wrench"; "F3" for "Fx3"; "F" for "Fx"
    ForceAxis axis;
};
std::optional<AxisName> parse_axis_name(std::string_view column);

/// The axes of a sensor on the skin, from the columns x_axis, y_axis and z_axis of a layout. The force along x of the skin is
/// x[0] F_x + x[1] F_y, and so on.
struct SensorAxes {
    std::array<double, 2> x = {1, 0}, y = {0, 1};
    double normal = 1;  ///< normal force for an F_z of 1; -1 if the z axis points out of the skin
};

/// A sensor and its columns in a table.
struct AxisSensor {
    std::string name;
    std::array<std::size_t, 3> columns = {};  ///< F_x, F_y, F_z; or magnitude, inclination, azimuth
    bool has_angles = false;                  ///< true: the second form
    SensorAxes axes = {};
};

/// The three-axis sensors of a table, in the order of their first columns; empty if it has none. A sensor with a name that lacks an axis,
/// and an angle without a unit, are errors. `path` is the path of the file, for messages.
Result<std::vector<AxisSensor>> find_axis_sensors(const Table&, std::optional<std::size_t> time, const std::string& path);

/// The factor that converts an angle to radians. Only for the columns of a sensor that find_axis_sensors() returned.
double radians_per_unit(const Column&);

/// Reads the axes of a sensor from the fields of a layout: "+x", "-y" ... and "in" or "out" for the z axis; "" for a missing field. Axes
/// that are not perpendicular or left-handed are errors.
Result<SensorAxes> parse_sensor_axes(std::string_view x_axis, std::string_view y_axis, std::string_view z_axis);

/// Returns an error for options that do not keep the direction of a force. `sensors` must not be empty.
Result<void> check_axis_options(const RecordingOptions&, std::span<const AxisSensor> sensors);

/// Combines the channels of `columns` to sensors: its channels are the columns of the sensors, one sensor after another. The result has one
/// channel for each sensor, its normal force, and shear. `placed`: the position of each sensor; empty: none is known.
std::unique_ptr<ForceSource> combine_axes(std::unique_ptr<ForceSource> columns, std::vector<AxisSensor> sensors,
                                          std::vector<std::optional<Position>> placed, const std::string& path);

}  // namespace corpuscle
