// Recordings of three-axis sensors: which columns belong together, the form with two angles, layouts with axes, and the errors.

#include "io/recording/force_axes.hpp"

#include <cmath>

#include "run/skin/skin_force.hpp"
#include "support/loaded_recording.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

/// A recording read completely, [channel][sample], N.
struct AxisRecording {
    std::vector<std::string> names, notes, warnings;
    std::vector<std::vector<double>> normal, x, y;
    std::vector<Channel> channels;
    std::string error;
};

AxisRecording read_axes(const TemporaryFolder& folder, const std::string& text, RecordingOptions options = {},
                        const std::string& layout = "") {
    AxisRecording out;
    if (!layout.empty()) options.layout = folder.write("layout.csv", layout);
    const auto source = open_recording(folder.write("x.csv", text), options);
    if (!source) return out.error = source.error().text(), out;
    out.channels = (*source)->channels();
    for (const auto& c : out.channels) out.names.push_back(c.name);
    EXPECT_TRUE((*source)->has_shear());
    out.normal.resize(out.names.size()), out.x = out.y = out.normal;
    for (Frames block(out.names.size(), 2, true);;) {
        if (const auto ok = (*source)->read(block); !ok) return out.error = ok.error().text(), out;
        if (block.count == 0) break;
        const auto append = [&](std::vector<double>& to, const std::vector<double>& from) {
            to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(block.count));
        };
        for (std::size_t c = 0; c < out.names.size(); ++c)
            append(out.normal[c], block.force[c]), append(out.x[c], block.shear_x[c]), append(out.y[c], block.shear_y[c]);
    }
    out.notes = (*source)->notes(), out.warnings = (*source)->quality().warnings;
    return out;
}

using AxisRows = std::vector<std::vector<double>>;

TEST(ForceAxes, AreFoundInTheNamesOfColumns) {
    const auto name = [](const char* column) {
        const auto found = parse_axis_name(column);
        return found ? found->sensor + ":" + std::to_string(static_cast<int>(found->axis)) : "none";
    };
    EXPECT_EQ(name("r1c1.Fx"), "r1c1:0");
    EXPECT_EQ(name("index.tip_Fz"), "index.tip:2");
    EXPECT_EQ(name("wrench.force.y"), "wrench:1");
    EXPECT_EQ(name("/wrench/force/x"), "/wrench:0");
    EXPECT_EQ(name("fx"), "F:0");
    EXPECT_EQ(name("F_z"), "F:2");
    EXPECT_EQ(name("Fy12"), "F12:1");
    EXPECT_EQ(name("tip.inclination"), "tip:4");
    EXPECT_EQ(name("tip.azimuth"), "tip:5");
    EXPECT_EQ(name("tip.F"), "tip:3");
    for (const char* other : {"time", "suffix", "fbg11", "x", "torque.x", "12", "", "tip.Fx2", "half", "index"})
        EXPECT_EQ(name(other), "none");
}

TEST(ForceAxes, MakeOneChannelOfEachSensor) {
    const TemporaryFolder folder;
    const auto r = read_axes(folder,
                             "time_s,r1c1.Fx_N,r1c1.Fy_N,r1c1.Fz_N,r1c2.Fz_mN,r1c2.Fy_mN,r1c2.Fx_mN,r1c1.Tx_Nm\n"
                             "0,1,2,3,6,5,4,9\n0.01,-1,-2,0,-6,-5,-4,9\n0.02,0,0,1,0,0,0,9\n");
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.names, (std::vector<std::string>{"r1c1", "r1c2"}));
    EXPECT_EQ(r.normal, (AxisRows{{3, 0, 1}, {6e-3, -6e-3, 0}}));
    EXPECT_EQ(r.x, (AxisRows{{1, -1, 0}, {4e-3, -4e-3, 0}}));
    EXPECT_EQ(r.y, (AxisRows{{2, -2, 0}, {5e-3, -5e-3, 0}}));
    ASSERT_EQ(r.notes.size(), 2U);
    EXPECT_EQ(r.notes[0], "'r1c1.Tx' was ignored: not an axis of a force (use --channel NAME to read one as a force)");
    EXPECT_NE(r.notes[1].find("pressing is positive"), std::string::npos);
}

TEST(ForceAxes, AreSingleChannelsIfSelectedByName) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,4,5,6\n");
    EXPECT_EQ(test::load_recording(path, {.channels = {"Fx"}}).names, std::vector<std::string>{"Fx"});
    EXPECT_EQ(test::load_recording(path).force, (AxisRows{{3, 6}}));  // of a reader without shear
}

TEST(ForceAxes, WithTwoAnglesAreTheSameForce) {
    const TemporaryFolder folder;
    const auto r = read_axes(folder,
                             "time_s,tip.F_N,tip.inclination_deg,tip.azimuth_deg,b.F_N,b.inclination_rad,b.azimuth_rad\n"
                             "0,2,30,90,1,0,0\n0.1,2,0,17,1,0.5,3.141592653589793\n0.2,2,90,180,0,0,0\n");
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.names, (std::vector<std::string>{"tip", "b"}));
    const AxisRows normal = {{2 * std::cos(M_PI / 6), 2, 0}, {1, std::cos(0.5), 0}}, x = {{0, 0, -2}, {0, -std::sin(0.5), 0}},
                   y = {{1, 0, 0}, {0, 0, 0}};
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(r.normal[c][k], normal[c][k], 1e-12) << c << k;
            EXPECT_NEAR(r.x[c][k], x[c][k], 1e-12) << c << k;
            EXPECT_NEAR(r.y[c][k], y[c][k], 1e-12) << c << k;
        }
}

TEST(ForceAxes, AreTurnedAsALayoutSays) {
    const TemporaryFolder folder;
    const std::string text = "time_s,a.Fx_N,a.Fy_N,a.Fz_N,b.Fx_N,b.Fy_N,b.Fz_N\n0,1,2,3,4,5,6\n0.01,1,2,3,4,5,6\n0.02,1,2,3,4,5,6\n";
    const auto r = read_axes(folder, text, {}, "channel,name,x_mm,y_mm,x_axis,y_axis,z_axis\nb,tip,1,2,+y,-x,out\na,,3,4,,-y,in\n");
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.names, (std::vector<std::string>{"tip", "a"}));
    EXPECT_EQ(r.channels[0].position->y, 2e-3);
    EXPECT_EQ(r.normal, (AxisRows{{-6, -6, -6}, {3, 3, 3}}));
    EXPECT_EQ(r.x, (AxisRows{{-5, -5, -5}, {1, 1, 1}}));
    EXPECT_EQ(r.y, (AxisRows{{4, 4, 4}, {-2, -2, -2}}));
}

TEST(ForceAxes, ErrorsNameTheSensorAndARemedy) {
    const TemporaryFolder folder;
    const auto has = [&](const std::string& text, const std::string& error, const RecordingOptions& options = {},
                         const std::string& layout = "") {
        const auto found = read_axes(folder, text, options, layout).error;
        EXPECT_NE(found.find(error), std::string::npos) << found;
    };
    has("time_s,a.Fx_N,a.Fz_N\n0,1,2\n1,1,2\n",
        "sensor 'a' has 'a.Fx' and 'a.Fz', but no Fy; add the column 'a.Fy', or use --channel 'a.Fz' to read one column as a force");
    has("time_s,a.Fx_N,a.Fy_N,a.Fz_N,b.Fz_N\n0,1,2,3,4\n1,1,2,3,4\n", "sensor 'b' has 'b.Fz', but no");
    has("time_s,a.F_N,a.inclination_deg\n0,1,2\n1,1,2\n", "but no azimuth");
    has("time_s,a.F_N,a.inclination,a.azimuth_deg\n0,1,2,3\n1,1,2,3\n",
        "'a.inclination' is an angle without a unit; rename the column 'a.inclination_deg' or 'a.inclination_rad'");
    has("time_s,a.F_N,a.inclination_deg,a.azimuth_deg\n0,1,20,3\n1,1,120,3\n2,1,20,3\n",
        "the inclination of 'a' is 120 degrees at sample 1, outside [0, 90]");
    const std::string angles = "time_s,a.F_N,a.inclination_deg,a.azimuth_deg\n0,1,20,3\n1,1,20,3\n",
                      axes = "time_s,a.Fx_N,a.Fy_N,a.Fz_N\n0,1,20,3\n1,1,20,3\n";
    has(angles, "--resample would interpolate across 360 degrees", {.resample = 3});
    has(axes, "--abs removes the direction of the force of the three-axis sensor 'a'", {.absolute = true});
    has(axes, "layout.csv:2:3: 'a': these axes are left-handed: with x_axis +x and y_axis +y, z points out of the skin", {},
        "channel,z_axis\na,in\n");
    has(axes, "layout.csv:2:3: 'a': x_axis +x and y_axis -x are parallel", {}, "channel,x_axis,y_axis\na,+x,-x\n");
    has(axes, "'up' is not a direction on the skin; write +x, -x, +y or -y", {}, "channel,x_axis\na,up\n");
    has(axes, "no three-axis sensor 'b'; did you mean 'a'?", {}, "channel,x_mm\nb,1\n");
}

TEST(ForceAxes, AForceThatNeverPressesIsAWarningWithARemedy) {
    const TemporaryFolder folder;
    const std::string text = "time_s,a.Fx_N,a.Fy_N,a.Fz_N\n0,1,2,-3\n0.01,1,2,-3\n0.02,1,2,0\n";
    const auto r = read_axes(folder, text);
    const auto warns = [](const AxisRecording& recording) {
        return std::any_of(recording.warnings.begin(), recording.warnings.end(),
                           [](const auto& w) { return w.starts_with("the normal force of 'a' is never positive"); });
    };
    EXPECT_TRUE(warns(r));
    const auto reversed = read_axes(folder, text, {.scale = -1});
    EXPECT_EQ(reversed.normal, (AxisRows{{3, 3, -0.0}}));
    EXPECT_EQ(reversed.x, (AxisRows{{-1, -1, -1}}));
    EXPECT_FALSE(warns(reversed));
    EXPECT_FALSE(warns(read_axes(folder, text, {}, "channel,z_axis\na,out\n")));
}

TEST(ForceAxes, ReachTheSitesOfASkin) {
    const TemporaryFolder folder;
    const auto source = test::value_or_throw(
        open_recording(folder.write("x.csv", "time_s,b.Fx_N,b.Fy_N,b.Fz_N,a.Fx_N,a.Fy_N,a.Fz_N\n0,1,2,3,4,5,6\n1,7,8,9,1,2,3\n"), {}));
    const auto force = make_site_force(*source, {1, 0}, 3);
    const auto block = test::value_or_throw(force->next());
    const auto at = [&](const double* component, std::size_t site, std::size_t step) {
        return component[site * block.force.stride + step];
    };
    EXPECT_EQ(at(block.force.data, 1, 0), 3);
    EXPECT_EQ(at(block.force.shear_x, 1, 1), 7);
    EXPECT_EQ(at(block.force.shear_y, 0, 0), 5);
    EXPECT_EQ(at(block.force.shear_y, 2, 0), 0);
    EXPECT_EQ(block.total_force[0], 9);
}

TEST(ForceAxes, OfATurnedPatchOfTaxelsAreTurnedToTheSkin) {
    const TemporaryFolder folder;
    const auto source =
        test::value_or_throw(open_recording(folder.write("x.csv", "time_s,t.Fx_N,t.Fy_N,t.Fz_N\n0,1,2,3\n1,0,0,0\n2,4,5,0\n"), {}));
    const auto taxels = test::value_or_throw(read_taxel_layout(folder.write("taxels.csv", "name,x_mm,y_mm,rotation_deg\nt,0,0,90\n")));
    auto sites = *grid_sites(2, 2, 2e-3);
    sites.area = 4e-6;
    const auto force = make_taxel_force(*source, taxels, test::value_or_throw(map_taxels(taxels, sites)), {0}, 4);
    const auto block = test::value_or_throw(force->next());
    ASSERT_EQ(block.force.touched.size(), 1U);
    const auto at = block.force.touched[0] * block.force.stride;
    EXPECT_EQ(block.force.data[at], 3);
    EXPECT_NEAR(block.force.shear_x[at], -2, 1e-12);
    EXPECT_NEAR(block.force.shear_y[at], 1, 1e-12);
    EXPECT_NEAR(block.force.shear_x[at + 2], -5, 1e-12);
}

}  // namespace
}  // namespace corpuscle
