#pragma once
// A layout of taxels: the force sensors of a robot's skin, with their positions, areas, and poses on a simulated skin. Read from a text
// table (doc/taxels.md).

#include <span>

#include "core/force_source.hpp"
#include "io/recording/force_axes.hpp"

namespace corpuscle {

/// The pose of a patch of taxels on a skin.
struct TaxelPose {
    std::string region;   ///< `shift` begins at the centre of this region, the mean of its sites; "": at the origin of the skin
    Position shift = {};  ///< m, from there to the origin of the patch, along the axes of the skin
    double rotation = 0;  ///< turns, counter-clockwise, from the axes of the skin to those of the patch; above -0.5, at most 0.5
    bool operator==(const TaxelPose&) const;
};

/// How the force of a taxel is used.
enum class TaxelUse {
    measured,      ///< as measured
    excluded,      ///< dead: the force is 0
    interpolated,  ///< dead: the force is that of its neighbours, see map_taxels()
};

struct Taxel {
    std::string name;
    double x = 0, y = 0;           ///< m, centre of the taxel in the axes of its patch
    double width = 0, height = 0;  ///< m, of a rectangle along the axes of the patch; both 0: not a rectangle
    double area = 0;               ///< m2; without width and height: of a disc, or 0 for a point
    TaxelPose pose;
    TaxelUse use = TaxelUse::measured;
    std::optional<std::size_t> channel = {};  ///< number of its channel in a frame or recording, from 0, if the table states it
    SensorAxes axes = {};                     ///< of its shear, in the axes of the patch
    SourceLocation location = {};             ///< in the table, of x
};

struct TaxelLayout {
    std::string file;
    std::vector<Taxel> taxels;  ///< at least one; in the order of the table, or of the channel numbers if the table has them
    bool has_axes = false;      ///< true: the table says how the axes of the taxels point, so all of them measure three forces
    bool has_channel_numbers() const { return taxels.front().channel.has_value(); }
};

inline constexpr std::size_t max_taxels = std::size_t{1} << 17;

/// Reads a table with the columns name or channel, x and y with a unit ("x_mm"), and optionally area ("area_mm2") or width and height,
/// patch, region, patch_x, patch_y, rotation_deg, dead, and x_axis,
/// y_axis and z_axis. Within a patch, an empty field of the pose has the value of the patch's first
/// row. Errors name file, line and column.
Result<TaxelLayout> read_taxel_layout(const std::string& path);

/// For each channel, the index of its taxel. If the layout has channel numbers, channel k belongs to number k. Otherwise channels have the
/// names of taxels, possibly with units ("t1_N"), or none has, and there are as many channels as taxels, in the same order. `source` is the
/// name of the recording or frame in messages.
Result<std::vector<std::uint32_t>> match_taxels(const TaxelLayout&, std::span<const std::string> channels, const std::string& source);

/// For each column of a frame, the index of its force in TaxelFrames. `columns`: names from a header. Frames of three-axis taxels have the
/// columns t1.Fx, t1.Fy and t1.Fz; see parse_axis_name().
Result<std::vector<std::uint32_t>> match_frame_columns(const TaxelLayout&, std::span<const std::string> columns, const std::string& source);

}  // namespace corpuscle
