// Layouts of taxels: their table, and how their forces are spread over the sites of a skin.

#include <cmath>
#include <numeric>

#include "skin/plan/skin_plan.hpp"
#include "skin/taxel/overlap.hpp"
#include "skin/taxel/stuck_taxels.hpp"
#include "skin/taxel/taxel_frames.hpp"
#include "skin/taxel/taxel_placement.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;

const Sites& hand_sites() {
    static const Sites sites = load_skin_plan("hand")->sites;
    return sites;
}

Result<TaxelLayout> read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_taxel_layout(folder.write("taxels.csv", text));
}

Result<TaxelMap> map_text(const std::string& text, const Sites& sites = hand_sites()) {
    const auto layout = read_text(text);
    return layout ? map_taxels(*layout, sites) : layout.error();
}

/// The forces at all sites.
std::vector<double> site_forces(const TaxelMap& map, const std::vector<double>& taxels, std::size_t sites) {
    std::vector<double> force(sites);
    map.spread(taxels.data(), force.data());
    return force;
}

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(TaxelTable, IsReadWithPosesUnitsAndDeadTaxels) {
    const auto layout =
        value_or_throw(read_text("# of a glove\nName;x_cm;y_mm;area_mm2;patch;region;patch_x_mm;rotation_deg;dead;note\n"
                                 "a;0,1;2;30;p;palm;5;370;0;\nb;0;0;30;p;;;;1;broken\nc;0;0;30;q;index.tip;;-180;interpolate;\n"));
    ASSERT_EQ(layout.taxels.size(), 3U);
    const auto &a = layout.taxels[0], &b = layout.taxels[1], &c = layout.taxels[2];
    EXPECT_DOUBLE_EQ(a.x, 1e-3);
    EXPECT_DOUBLE_EQ(a.area, 30e-6);
    EXPECT_EQ(a.pose.region, "palm");
    EXPECT_NEAR(a.pose.rotation, 10.0 / 360, 1e-15);
    EXPECT_EQ(b.pose, a.pose) << "empty fields have the values of the patch's first row";
    EXPECT_EQ(b.use, TaxelUse::excluded);
    EXPECT_EQ(c.pose.region, "index.tip");
    EXPECT_EQ(c.use, TaxelUse::interpolated);
}

TEST(TaxelTable, ErrorsNameThePlaceTheValueAndARemedy) {
    const std::pair<std::string, std::string> cases[] = {
        {"", "no taxels in this file"},
        {"name,x_mm,y_mm\n", "no taxels in this file"},
        {"name,x_mm\na,1\n", "taxels.csv:1: a layout of taxels needs the columns name (or channel), x and y"},
        {"name,x,y\na,1,1\n", "taxels.csv:1:6: column 'x' needs a unit of length; write x_mm"},
        {"name,x_mm,y_mm,area_mm\na,1,1,1\n", "taxels.csv:1:16: column 'area_mm' needs a unit of area; write area_mm2"},
        {"name,x_mm,y_mm,rotation\na,1,1,1\n", "taxels.csv:1:16: the rotation needs a unit of angle; write rotation_deg"},
        {"name,x_mm,y_mm,widht_mm\na,1,1,1\n", "taxels.csv:1:16: unknown column 'widht_mm'; did you mean 'width_mm'?"},
        {"name,x_mm,y_mm,width_mm\na,1,1,1\n", "taxels.csv:1:16: a rectangle needs width and height; add a column height_mm"},
        {"name,x_mm,y_mm,x_cm\na,1,1,1\n", "taxels.csv:1:16: column 'x' occurs twice"},
        {"name,x_mm,y_mm\na,1\n", "taxels.csv:2: 2 columns instead of 3"},
        {"name,x_mm,y_mm\na,1,\n", "taxels.csv:2:5: y is empty"},
        {"name,x_mm,y_mm\na,1,one\n", "taxels.csv:2:5: y: 'one' is not a number"},
        {"name,x_mm,y_mm\na,1,nan\n", "taxels.csv:2:5: y: 'nan' is not a number"},
        {"name,x_mm,y_mm\na,1,99999\n", "taxels.csv:2:5: y = 99999 is out of range: at most 10000 mm"},
        {"name,x_mm,y_mm,area_mm2\na,1,1,-4\n", "taxels.csv:2:7: taxel 'a' has the area -4; it must be above 0"},
        {"name,x_mm,y_mm,area_mm2\na,1,1,0\n", "taxels.csv:2:7: taxel 'a' has the area 0; it must be above 0"},
        {"name,x_mm,y_mm\na,1,1\na,2,2\n", "taxels.csv:3:1: taxel 'a' has two rows; the first is line 2"},
        {"name,x_mm,y_mm\n,1,1\n", "taxels.csv:2:1: name is empty"},
        {"channel,x_mm,y_mm\n1,0,0\n1,0,0\n", "taxels.csv:3:1: channel 1 has two rows; the first is line 2"},
        {"channel,x_mm,y_mm\n1,0,0\n3,0,0\n", "taxels.csv: channel 2 has no row, although channel 3 has one"},
        {"channel,x_mm,y_mm\n0,0,0\n", "taxels.csv:2:1: channel '0': must be a number from 1"},
        {"name,x_mm,y_mm,x_axis,y_axis,z_axis\na,0,0,+x,+y,in\n", "taxels.csv:2:13: taxel 'a': these axes are left-handed: with x_axis +x and y_axis +y, z points out of the skin; correct z_axis, "
         "or reverse one of the others. If z is positive under a press, however the axes are called, leave z_axis empty"},
        {"name,x_mm,y_mm,x_axis\na,0,0,up\n", "taxels.csv:2:7: taxel 'a': 'up' is not a direction on the skin; write +x"},
        {"name,x_mm,y_mm,x_axis,y_axis,z_axis\na,0,0,+x,+y,OUT\n", "taxels.csv:2:13: taxel 'a': z_axis 'OUT': write 'in'"},
        {"name,x_mm,y_mm,area_mm^2,rotation_rad\na,1,1,-4,1\n", "taxels.csv:2:7: taxel 'a' has the area -4"},
        {"name,x_mm,y_mm,dead\na,0,0,maybe\n", "taxels.csv:2:7: dead is 'maybe'; write 1"},
        {"name,x_mm,y_mm,patch,rotation_deg\na,0,0,p,1\nb,0,0,p,2\n",
         "taxels.csv:3:7: taxel 'b' gives patch 'p' another pose than line 2"}};
    for (const auto& [text, message] : cases) {
        const auto layout = read_text(text);
        ASSERT_FALSE(layout) << text;
        EXPECT_NE(layout.error().text().find(message), std::string::npos) << layout.error().text() << "\n" << text;
    }
    EXPECT_NE(read_taxel_layout("/none.csv").error().text().find("there is no such file"), std::string::npos);
}

TEST(TaxelPlaces, OffTheSkinOrInAnUnknownRegionAreErrorsThatNameTheNearest) {
    const std::pair<std::string, std::string> cases[] = {
        {"name,x_mm,y_mm,area_mm2\nt5,300,20,20\n", "taxels.csv:2:4: taxel 't5' is at (300, 20) mm, off the skin; the nearest region is "},
        {"name,x_mm,y_mm\nt5,-300,20\n", "off the skin; the nearest region is palm"},
        {"name,x_mm,y_mm,region\nt5,0,0,plam\n", "taxels.csv:2: taxel 't5': there is no region 'plam'; did you mean 'palm'?"},
        {"name,x_mm,y_mm,region,dead\nt5,0,0,palm,interpolate\n", "taxel 't5' cannot be interpolated"}};
    for (const auto& [text, message] : cases) {
        const auto map = map_text(text);
        ASSERT_FALSE(map) << text;
        EXPECT_NE(map.error().text().find(message), std::string::npos) << map.error().text();
    }
}

TEST(TaxelPlaces, OneThatIsPartlyOffTheSkinHasItsCompleteForceOnTheSkinWithANote) {
    const auto sites = value_or_throw(grid_sites(4, 4, 2e-3));  // cells from -1 to 7 mm
    const auto map = value_or_throw(map_text("name,x_mm,y_mm,width_mm,height_mm\na,7,3,4,8\n", sites));
    EXPECT_DOUBLE_EQ(sum_of(site_forces(map, {3}, sites.size())), 3);
    ASSERT_EQ(map.notes.size(), 1U);
    EXPECT_EQ(map.notes[0], "1 of 1 taxels are partly off the skin; their complete force acts on the part that is on it: a (50 %)");
}

TEST(TaxelPlaces, ARectangleGivesEachCellTheShareOfItsOverlap) {
    const auto sites = value_or_throw(grid_sites(2, 2, 2e-3));  // cells from -1 to 3 mm
    const auto map = value_or_throw(map_text("name,x_mm,y_mm,width_mm,height_mm\na,0.5,0,2,1\n", sites));
    const auto force = site_forces(map, {4}, sites.size());
    EXPECT_NEAR(force[0], 3, 1e-12);
    EXPECT_NEAR(force[1], 1, 1e-12);
    EXPECT_EQ(force[2] + force[3], 0);
    // Turned by 90 degrees around the origin of the patch it is at (0, 0.5) mm, and upright.
    const auto turned = value_or_throw(map_text("name,x_mm,y_mm,width_mm,height_mm,rotation_deg\na,0.5,0,2,1,90\n", sites));
    const auto turned_force = site_forces(turned, {4}, sites.size());
    EXPECT_NEAR(turned_force[0], 3, 1e-12);
    EXPECT_NEAR(turned_force[2], 1, 1e-12);
}

TEST(TaxelPlaces, ADiscHasItsAreaAndAPointIsOneSite) {
    EXPECT_NEAR(area_of(disc(2e-5)), 2e-5, 1e-18);
    const auto sites = value_or_throw(grid_sites(9, 9, 1e-3));
    const auto map = value_or_throw(map_text("name,x_mm,y_mm,area_mm2\na,4,4,9\n", sites));
    const auto force = site_forces(map, {9}, sites.size());
    EXPECT_NEAR(force[4 * 9 + 4], 1, 1e-6) << "a cell within the disc has its share of the area";
    EXPECT_NEAR(force[4 * 9 + 3], force[3 * 9 + 4], 1e-12);
    const auto point = value_or_throw(map_text("name,x_mm,y_mm\na,4.4,3.7\n", sites));
    EXPECT_EQ(point.sites, (std::vector<std::uint32_t>{4 * 9 + 4}));
    EXPECT_EQ(point.weight, (std::vector<double>{1}));
}

TEST(TaxelMaps, ADeadTaxelHasNoForceOrThatOfItsNeighbours) {
    const std::string rows = "name,x_mm,y_mm,area_mm2,region,dead\na,-10,0,9,palm,\nb,0,0,9,palm,{}\nc,5,0,9,palm,\n";
    const auto& sites = hand_sites();
    const auto text = [&](const std::string& dead) { return rows.substr(0, rows.find("{}")) + dead + rows.substr(rows.find("{}") + 2); };
    const auto excluded = value_or_throw(map_text(text("1")));
    EXPECT_NEAR(sum_of(site_forces(excluded, {1, 1000, 2}, sites.size())), 3, 1e-12);
    EXPECT_EQ(excluded.total, (std::vector<double>{1, 0, 1}));
    const auto interpolated = value_or_throw(map_text(text("interpolate")));
    // b is 10 mm from a and 5 mm from c: its force is (1 / 10 + 2 / 5) / (1 / 10 + 1 / 5) = 5/3 N.
    EXPECT_NEAR(sum_of(site_forces(interpolated, {1, 1000, 2}, sites.size())), 3 + 5.0 / 3, 1e-12);
    EXPECT_NEAR(sum_of(interpolated.total), 3, 1e-12);
}

TEST(StuckTaxel, IsNamedIfItsReadingNeverChangesOrStaysAtItsHighest) {
    const auto layout =
        value_or_throw(read_text("name,x_mm,y_mm,dead\nfine,0,0,\nconstant,1,0,\nrail,2,0,\nuntouched,3,0,\nknown,4,0,1\nheld,5,0,\n"));
    StuckTaxels stuck(layout);
    for (int k = 0; k < 100; ++k) {
        const double force[] = {0.01 * k, 0.3, k < 40 ? 0.1 * k : 5.0, 0, 0.3, k < 60 ? 0.0 : 2.0};
        for (std::size_t t = 0; t < std::size(force); ++t) stuck.add(t, force[t]);
    }
    EXPECT_EQ(stuck.notes(),
              (std::vector<std::string>{"2 of 6 taxels are probably dead: constant (0.3 N throughout), rail (at its highest, 5 N, "
                                        "for 60 % of the time); set dead = 1 in " +
                                        layout.file + " to exclude them"}));
    StuckTaxels pressed(layout);
    for (int k = 0; k < 100; ++k)
        for (std::size_t t = 0; t < 6; ++t) pressed.add(t, k < 20 ? 0.1 * k : 2);
    EXPECT_TRUE(pressed.notes().empty()) << "a press that is held on all taxels";
    StuckTaxels still(layout);
    for (int k = 0; k < 100; ++k) still.add(1, 0.3);
    EXPECT_TRUE(still.notes().empty()) << "nothing varies";
}

/// A random layout of taxels around the palm.
std::string random_layout() {
    const auto number = [](int low, int high) { return *rc::gen::inRange(low, high); };
    std::string text = "name,x_mm,y_mm,width_mm,height_mm,region,patch_x_mm,patch_y_mm,rotation_deg\n";
    const int taxels = number(1, 12);
    for (int k = 0; k < taxels; ++k)
        text += "t" + std::to_string(k) + "," + std::to_string(0.1 * number(-200, 200)) + "," + std::to_string(0.1 * number(-200, 200)) +
                "," + std::to_string(0.1 * number(1, 150)) + "," + std::to_string(0.1 * number(1, 150)) + ",palm," +
                std::to_string(number(-5, 6)) + "," + std::to_string(number(-5, 6)) + "," + std::to_string(number(-720, 720)) + "\n";
    return text;
}

TEST(TaxelMaps, ForceIsConservedForAnyLayoutAndPose) {
    EXPECT_TRUE(rc::check([] {
        const auto map = value_or_throw(map_text(random_layout()));
        std::vector<double> by_taxel(map.taxel_count), force(map.taxel_count);
        for (std::size_t e = 0; e < map.taxel.size(); ++e) {
            RC_ASSERT(map.weight[e] > 0);
            by_taxel[map.taxel[e]] += map.weight[e];
        }
        for (const double sum : by_taxel) RC_ASSERT(std::abs(sum - 1) < 1e-15 * 64);
        for (double& F : force) F = *rc::gen::inRange(-1000, 4000) * 1e-3;
        const double total = sum_of(force), on_sites = sum_of(site_forces(map, force, hand_sites().size()));
        double scale = 1;
        for (const double F : force) scale += std::abs(F);
        RC_ASSERT(std::abs(on_sites - total) < 1e-13 * scale);
    }));
}

TEST(TaxelMaps, AFullTurnOfThePoseChangesNoBit) {
    EXPECT_TRUE(rc::check([] {
        const auto degrees = *rc::gen::inRange(-360, 360);
        const auto map_at = [](int rotation) {
            const auto turn = std::to_string(rotation) + "\n";
            return value_or_throw(
                map_text("name,x_mm,y_mm,width_mm,height_mm,region,rotation_deg\na,3,-4,7,5,palm," + turn + "b,-8,2,3,9,palm," + turn));
        };
        const auto once = map_at(degrees);
        for (const int turn : {-720, 360, 1080}) {
            const auto turned = map_at(degrees + turn);
            RC_ASSERT(turned.sites == once.sites && turned.taxel == once.taxel && turned.begin == once.begin);
            RC_ASSERT(turned.weight == once.weight);
        }
    }));
}

TEST(TaxelMaps, ShearIsTurnedFromTheTaxelToTheSkinAndConserved) {
    EXPECT_TRUE(rc::check([] {
        const auto turn = *rc::gen::inRange(-180, 181);
        const auto layout = value_or_throw(read_text("name,x_mm,y_mm,area_mm2,region,rotation_deg,x_axis,y_axis,z_axis\na,3,-4,30,palm," +
                                                     std::to_string(turn) + ",+y,-x,out\n"));
        TaxelFrames taxels(layout, value_or_throw(map_taxels(layout, hand_sites())), true);
        RC_ASSERT(taxels.frame_size() == 3U);
        const double x = *rc::gen::inRange(-100, 100) * 0.01, y = *rc::gen::inRange(-100, 100) * 0.01;
        const double frame[] = {x, y, -2}, angle = turn * std::acos(-1) / 180;
        std::vector<double> force[3];
        for (auto& f : force) f.resize(hand_sites().size());
        RC_ASSERT(taxels.spread(frame, force[0].data(), force[1].data(), force[2].data()) == 2);
        // The x axis of the taxel is the y axis of the patch, its y axis the negative x axis.
        const double along_x = -y, along_y = x;
        RC_ASSERT(std::abs(sum_of(force[0]) - 2) < 1e-12);
        RC_ASSERT(std::abs(sum_of(force[1]) - (along_x * std::cos(angle) - along_y * std::sin(angle))) < 1e-12);
        RC_ASSERT(std::abs(sum_of(force[2]) - (along_x * std::sin(angle) + along_y * std::cos(angle))) < 1e-12);
    }));
}

TEST(TaxelChannels, AreMatchedByNameOrOrderAndErrorsNameTheRow) {
    const auto layout = value_or_throw(read_text("name,x_mm,y_mm\na,0,0\nb,1,0\nc,2,0\n"));
    using Names = std::vector<std::string>;
    EXPECT_EQ(value_or_throw(match_taxels(layout, Names{"c_mN", "a", "b [N]"}, "r")), (std::vector<std::uint32_t>{2, 0, 1}));
    EXPECT_EQ(value_or_throw(match_taxels(layout, Names{"ch1", "ch2", "ch3"}, "r")), (std::vector<std::uint32_t>{0, 1, 2}));
    const std::pair<Names, std::string> cases[] = {
        {{"a", "b", "d"}, "channel 'd' of r has no row in "},
        {{"a", "b"}, "taxels.csv:4:3: taxel 'c' is not a channel of r"},
        {{"a", "b", "b_N"}, "two channels of r have the name of taxel 'b'"},
        {{"ch1", "ch2"}, "taxels.csv:4:3: r has 2 channels, but "},
        {{"ch1", "ch2", "ch3", "ch4"},
         "channel 'ch4' has no row; add it (with dead = 1 if it is not used), or select 3 channels by --channel"}};
    for (const auto& [names, message] : cases) {
        const auto matched = match_taxels(layout, names, "r");
        ASSERT_FALSE(matched);
        EXPECT_NE(matched.error().text().find(message), std::string::npos) << matched.error().text();
    }
    const auto three = value_or_throw(read_text("name,x_mm,y_mm,x_axis\na,0,0,\nb,1,0,\n"));
    EXPECT_EQ(value_or_throw(match_frame_columns(three, Names{"b_Fx", "b_Fz", "a_Fx", "a_Fy", "b_Fy", "a_Fz"}, "r")),
              (std::vector<std::uint32_t>{3, 5, 0, 1, 4, 2}));
    EXPECT_FALSE(match_frame_columns(three, Names{"b_Fx", "b_Fx", "a_Fx", "a_Fy", "b_Fy", "a_Fz"}, "r"));
    EXPECT_FALSE(match_frame_columns(three, Names{"b_Fx", "b_Fz", "a_Fx", "a_Fy", "b_Fy", "what"}, "r"));
    const auto numbered = value_or_throw(read_text("channel,name,x_mm,y_mm\n2,a,0,0\n1,b,1,0\n"));
    EXPECT_EQ(numbered.taxels[0].name, "b") << "taxels are in the order of their channels";
    EXPECT_EQ(value_or_throw(match_taxels(numbered, Names{"x", "y"}, "r")), (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace corpuscle
