#include "io/recording/force_axes.hpp"

#include <fmt/format.h>
#include <map>
#include <numbers>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view digits = "0123456789";

/// Removes the end `word` of the text, in upper or lower case.
bool strip_end(std::string_view& text, std::string_view word) {
    if (text.size() < word.size() || !equal_ignoring_case(text.substr(text.size() - word.size()), word)) return false;
    text.remove_suffix(word.size());
    return true;
}

/// Removes a separator at the end. Returns false if the text is not empty and has none.
bool strip_separator(std::string_view& text) {
    if (text.empty()) return true;
    if (std::string_view("._-/ ").find(text.back()) == text.npos) return false;
    text.remove_suffix(1);
    return true;
}

/// The axis at the end of a name, which is removed with the word for a force before it: "fx", "F_x", "force.x".
std::optional<ForceAxis> strip_cartesian(std::string_view& name) {
    for (const auto axis : {ForceAxis::x, ForceAxis::y, ForceAxis::z}) {
        const char letter = "xyz"[static_cast<int>(axis)];
        for (const char* before : {"f", "f_", "force_", "force.", "force/", "force "}) {
            auto rest = name;
            if (strip_end(rest, std::string(before) + letter) && strip_separator(rest)) return name = rest, axis;
        }
    }
    return {};
}

std::optional<ForceAxis> strip_polar(std::string_view& name) {
    constexpr std::pair<std::string_view, ForceAxis> words[] = {{"inclination", ForceAxis::inclination},
                                                                {"azimuth", ForceAxis::azimuth},
                                                                {"magnitude", ForceAxis::magnitude},
                                                                {"force", ForceAxis::magnitude},
                                                                {"f", ForceAxis::magnitude}};
    for (const auto& [word, axis] : words) {
        auto rest = name;
        if (strip_end(rest, word) && strip_separator(rest)) return name = rest, axis;
    }
    return {};
}

/// The columns found so far for the sensors of one form.
struct SensorColumns {
    std::string name;
    std::array<std::optional<std::size_t>, 3> columns = {};
    std::size_t count() const {
        return static_cast<std::size_t>(std::count_if(columns.begin(), columns.end(), [](auto& c) { return c; }));
    }
};

/// The sensors of one form, in the order of their first columns.
std::vector<SensorColumns> sensors_of_form(const Table& table, std::optional<std::size_t> time, bool has_angles) {
    std::vector<SensorColumns> out;
    std::map<std::string, std::size_t> index;
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
        if (c == time) continue;
        const auto name = parse_axis_name(table.columns()[c].name);
        if (!name || (name->axis > ForceAxis::z) != has_angles) continue;
        const auto [at, is_new] = index.try_emplace(name->sensor, out.size());
        if (is_new) out.push_back({name->sensor});
        auto& column = out[at->second].columns[static_cast<std::size_t>(name->axis) % 3];
        if (!column) column = c;
    }
    return out;
}

/// A sensor that lacks one of its columns. The first column that is present names the missing one: "Fx2" gives "Fz2".
Error missing_axis(const Table& table, const SensorColumns& sensor, bool has_angles, const std::string& path) {
    constexpr std::string_view words[] = {"Fx", "Fy", "Fz", "F", "inclination", "azimuth"};
    std::vector<std::string> present;
    std::string_view missing;
    std::string force;  // the column that can be read as a force
    for (std::size_t k = 0; k < 3; ++k) {
        if (!sensor.columns[k]) {
            missing = words[k + (has_angles ? 3 : 0)];
            continue;
        }
        present.push_back("'" + table.columns()[*sensor.columns[k]].name + "'");
        if (!has_angles || k == 0) force = present.back();
    }
    const bool is_numbered = sensor.name.size() > 1 && sensor.name[0] == 'F' && sensor.name.find_first_not_of(digits, 1) == std::string::npos;
    const auto column = is_numbered       ? fmt::format("{}{}", missing, sensor.name.substr(1))
                        : sensor.name == "F" ? std::string(missing)
                                             : fmt::format("{}.{}", sensor.name, missing);
    return bad_input(fmt::format("sensor '{}' has {}, but no {}; add the column '{}'{}", sensor.name, joined(present, " and "), missing,
                                 column, force.empty() ? "" : fmt::format(", or use --channel {} to read one column as a force", force)),
                     {path});
}

/// A name that may stand for a force along with something else: without a name of a sensor, two axes are two separate channels.
bool is_plain(const SensorColumns& sensor) { return sensor.name == "F"; }

Result<void> check_angles(const Table& table, const AxisSensor& sensor, const std::string& path) {
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
        const auto& column = table.columns()[sensor.columns[k]];
        if (column.unit == "deg" || column.unit == "\u00b0" || column.unit == "rad") continue;
        return bad_input(fmt::format("'{}' is an angle {}; rename the column '{}_deg' or '{}_rad'", column.name,
                                     column.unit.empty() ? "without a unit" : "in '" + column.unit + "'", column.name, column.name),
                         {path});
    }
    return {};
}

}  // namespace

std::optional<AxisName> parse_axis_name(std::string_view column) {
    const auto last = column.find_last_not_of(digits);
    if (last == column.npos) return {};
    auto name = column.substr(0, last + 1);
    const auto number = column.substr(last + 1);
    auto axis = strip_cartesian(name);
    if (!axis) axis = strip_polar(name);
    if (!axis) return {};
    if (!number.empty() && !name.empty()) return {};  // "tip.Fx2" may be anything
    return AxisName{name.empty() ? "F" + std::string(number) : std::string(name), *axis};
}

double radians_per_unit(const Column& column) { return column.unit == "rad" ? 1 : std::numbers::pi / 180; }

Result<std::vector<AxisSensor>> find_axis_sensors(const Table& table, std::optional<std::size_t> time, const std::string& path) {
    std::vector<AxisSensor> out;
    for (const bool has_angles : {false, true}) {
        const auto found = sensors_of_form(table, time, has_angles);
        const bool any_complete = std::any_of(found.begin(), found.end(), [](const auto& s) { return s.count() == 3; });
        for (const auto& s : found) {
            // A force by itself is not a three-axis sensor. Neither are Fx and Fz without the name of a sensor.
            if (s.count() == 1 && (!any_complete || has_angles)) continue;
            if (s.count() < 3 && is_plain(s) && !any_complete && !has_angles) continue;
            if (s.count() < 3) return missing_axis(table, s, has_angles, path);
            out.push_back({s.name, {*s.columns[0], *s.columns[1], *s.columns[2]}, has_angles});
            if (has_angles) TRY(check_angles(table, out.back(), path));
        }
    }
    return out;
}

namespace {

/// "+x" as (1, 0).
std::optional<std::array<double, 2>> unit_vector(std::string_view text) {
    const double sign = text.starts_with('-') ? -1 : 1;
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    if (text == "x") return std::array{sign, 0.0};
    if (text == "y") return std::array{0.0, sign};
    return {};
}

}  // namespace

Result<SensorAxes> parse_sensor_axes(std::string_view x_axis, std::string_view y_axis, std::string_view z_axis) {
    SensorAxes out;
    const auto x = unit_vector(x_axis.empty() ? "x" : x_axis), y = unit_vector(y_axis.empty() ? "y" : y_axis);
    if (!x || !y)
        return bad_input(fmt::format("'{}' is not a direction on the skin; write +x, -x, +y or -y", (!x ? x_axis : y_axis).substr(0, 40)));
    if (!z_axis.empty() && z_axis != "in" && z_axis != "out")
        return bad_input(fmt::format("z_axis '{}': write 'in' (into the skin) or 'out'", z_axis.substr(0, 40)));
    const double turn = (*x)[0] * (*y)[1] - (*x)[1] * (*y)[0];  // 1: x and y make a right-handed frame with an axis out of the skin
    if (turn == 0) return bad_input(fmt::format("x_axis {} and y_axis {} are parallel; they must be perpendicular", x_axis, y_axis));
    if (!z_axis.empty() && (turn > 0) != (z_axis == "out"))
        return bad_input(
            fmt::format("these axes are left-handed: with x_axis {} and y_axis {}, z points {} the skin; correct z_axis, or "
                        "reverse one of the others. If z is positive under a press, however the axes are called, leave z_axis empty",
                        x_axis.empty() ? "+x" : x_axis, y_axis.empty() ? "+y" : y_axis, turn > 0 ? "out of" : "into"));
    // The force along x of the skin is the sum over the sensor's axes of their x components times the force along them.
    out.x = {(*x)[0], (*y)[0]}, out.y = {(*x)[1], (*y)[1]};
    out.normal = z_axis == "out" ? -1 : 1;
    return out;
}

Result<void> check_axis_options(const RecordingOptions& options, std::span<const AxisSensor> sensors) {
    const auto refuse = [&](bool is_set, std::string_view option, std::string_view why) {
        return is_set ? Result<void>(bad_usage(fmt::format("{} {} of the three-axis sensor '{}'; omit it, or select single columns with "
                                                           "--channel",
                                                           option, why, sensors[0].name)))
                      : Result<void>();
    };
    TRY(refuse(options.absolute, "--abs", "removes the direction of the force"));
    if (std::none_of(sensors.begin(), sensors.end(), [](const AxisSensor& s) { return s.has_angles; })) return {};
    TRY(refuse(options.offset != 0, "--offset", "does not apply to the angles"));
    TRY(refuse(!options.calibrations.empty(), "--calibrate", "does not apply to the angles"));
    TRY(refuse(options.zero.has_value(), "--zero", "does not apply to the angles"));
    TRY(refuse(options.deadband.has_value(), "--deadband", "does not apply to the angles"));
    TRY(refuse(options.range.has_value(), "--range", "does not apply to the angles"));
    TRY(refuse(options.resample.has_value(), "--resample", "would interpolate across 360 degrees between angles"));
    TRY(refuse(options.despike || options.lowpass || !options.notch.empty(), "a filter", "would average across 360 degrees the angles"));
    return {};
}

}  // namespace corpuscle
