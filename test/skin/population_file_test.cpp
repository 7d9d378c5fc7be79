// Populations of a skin: their files, the positions of their afferents, and their receptive fields.

#include <cmath>
#include <fstream>
#include <sstream>

#include "skin/innervation.hpp"
#include "skin/plan/site_grid.hpp"
#include "support/property.hpp"
#include "support/support.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

/// The population "hand", placed once for all tests.
const Innervation& hand() {
    static const auto placed = innervate(*load_skin_plan("hand"));
    return **placed;
}

/// The receptive field of each receptor of a class, as pairs of site and weight.
std::vector<std::vector<std::pair<std::uint32_t, double>>> fields_of_class(const Innervation& skin, std::size_t class_index) {
    std::vector<std::vector<std::pair<std::uint32_t, double>>> out((skin.class_begin[class_index + 1] - skin.class_begin[class_index]) *
                                                                   skin.fields[class_index].receptors);
    const auto& f = skin.fields[class_index];
    for (std::uint32_t s = 0; s + 1 < f.begin.size(); ++s)
        for (auto k = f.begin[s]; k < f.begin[s + 1]; ++k) out[f.afferent[k]].emplace_back(s, f.weight[k]);
    return out;
}

TEST(HandPopulation, HasThePublishedNumbersAndFractionsOfAfferents) {
    const auto& h = hand();
    EXPECT_NEAR(static_cast<double>(h.afferents.size()), 17000, 300);
    const std::pair<std::string, double> fractions[] = {{"sa1", 0.25}, {"fa1", 0.43}, {"sa2", 0.19}, {"fa2", 0.13}};
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(h.plan.classes[c].name, fractions[c].first);
        EXPECT_NEAR(static_cast<double>(h.class_begin[c + 1] - h.class_begin[c]) / static_cast<double>(h.afferents.size()),
                    fractions[c].second, 0.02);
        EXPECT_FALSE(h.plan.classes[c].sources.empty());
    }
    for (const auto& [region, total] : {std::pair("index.tip", 241.0), {"middle.base", 93.0}, {"palm", 58.0}}) {
        const auto at = static_cast<std::size_t>(std::find(h.plan.sites.regions.begin(), h.plan.sites.regions.end(), region) -
                                                 h.plan.sites.regions.begin());
        double sum = 0;
        for (const auto& c : h.plan.classes) sum += c.density[at] * 1e-4;
        EXPECT_NEAR(sum, total, 1e-9) << region;
    }
}

TEST(HandPopulation, HasTheAfferentsOfNervesAndAThesisParameterIsRefusedWithARemedy) {
    for (const auto* name : {"hand", "fingertip"}) {
        const auto plan = *load_skin_plan(name);
        std::vector<std::string> afferents;
        for (const auto& c : plan.classes) afferents.push_back(c.name + " " + c.afferent_name);
        EXPECT_EQ(afferents, (std::vector<std::string>{"sa1 sa1-nerve", "fa1 fa1-nerve", "sa2 sa2", "fa2 fa2"}));
        const auto error_of = [&](const char* setting) { return apply_overrides(plan, test::parse_settings({setting})).error().text(); };
        const auto is_another = ": the class sa1 of " + std::string(name) + " is the afferent sa1-nerve; ";
        EXPECT_EQ(error_of("sa1.f_B=25Hz"),
                  "sa1.f_B=25Hz" + is_another + "the thesis's sa1 is in a population file with afferent = \"sa1\" (doc/skin.md)");
        EXPECT_EQ(error_of("sa1.k_A=1.5u"), "sa1.k_A=1.5u" + is_another +
                                                "its k_A is set by sa1-nerve.k_A, and the thesis's sa1 is in a population file with "
                                                "afferent = \"sa1\" (doc/skin.md)");
        for (const auto* setting : {"sa1-nerve.k_A=3", "SA1-NERVE.k_A=3"})
            EXPECT_EQ(apply_overrides(plan, test::parse_settings({setting}))->result.classes[0].afferent.value("k_A"), 3) << setting;
        for (const auto* setting : {"RA.F_0=9uN", "pc.F_0=9uN"}) EXPECT_TRUE(apply_overrides(plan, test::parse_settings({setting}))->unused.empty());
        EXPECT_EQ(apply_overrides(plan, test::parse_settings({"sa1.f_X=25Hz"})).error().text().find("thesis"), std::string::npos);
        EXPECT_TRUE(apply_overrides(plan, test::parse_settings({"sa1.F_0=20mN"})));
    }
}

TEST(HandPopulation, EachAfferentIsInACellOfItsOwnRegion) {
    const auto& h = hand();
    const SiteGrid near(h.plan.sites.positions);
    for (const auto& u : h.afferents) {
        const auto site = near.nearest(u.position.x, u.position.y);
        ASSERT_LE(std::abs(h.plan.sites.positions[site].x - u.position.x), 1.0000001e-3);
        ASSERT_LE(std::abs(h.plan.sites.positions[site].y - u.position.y), 1.0000001e-3);
        ASSERT_EQ(h.plan.sites.region[site], u.region);
    }
}

TEST(HandPopulation, AReceptiveFieldSumsToItsGainAndStaysOnOneFinger) {
    const auto& h = hand();
    const double per_cell = h.plan.felt_area / h.plan.sites.area;  // the gain without a surround: felt area over the area of a site
    const auto finger = [&](std::uint32_t region) {
        return h.plan.sites.regions[region].substr(0, h.plan.sites.regions[region].find('.'));
    };
    for (std::size_t c = 0; c < h.fields.size(); ++c) {
        const auto receptive_fields = fields_of_class(h, c);
        for (std::size_t u = 0; u < receptive_fields.size(); ++u) {
            double sum = 0;
            for (const auto& [site, weight] : receptive_fields[u]) {
                ASSERT_TRUE(weight > 0 || h.plan.classes[c].surround > 0);
                sum += weight;
                const auto from = finger(h.afferents[h.class_begin[c] + u / h.fields[c].receptors].region),
                           to = finger(h.plan.sites.region[site]);
                ASSERT_TRUE(from == to || from == "palm" || to == "palm") << from << " feels " << to;
            }
            ASSERT_NEAR(sum, per_cell * (1 - h.plan.classes[c].surround), 1e-9 * per_cell);
        }
    }
}

TEST(HandPopulation, AfferentsWithNeighbouringNumbersAreClose) {
    const auto& h = hand();
    double sum = 0, tiles = 0;
    for (std::size_t c = 0; c < h.fields.size(); ++c)
        for (auto k = h.class_begin[c]; k + 64 <= h.class_begin[c + 1]; k += 64) {  // a tile of 64 consecutive afferents
            double max_distance = 0;                                                // from its first afferent, m
            for (std::size_t i = 1; i < 64; ++i)
                max_distance = std::max(max_distance, std::hypot(h.afferents[k + i].position.x - h.afferents[k].position.x,
                                                                 h.afferents[k + i].position.y - h.afferents[k].position.y));
            sum += max_distance, tiles += 1;
        }
    EXPECT_LT(sum / tiles, 30e-3);  // m; the hand is 110 by 190 mm
}

TEST(HandPopulation, DependsOnlyOnItsPlanAndSeed) {
    auto plan = *load_skin_plan("hand");
    const auto again = *innervate(plan);
    EXPECT_EQ(again->fields[1].weight, hand().fields[1].weight);
    plan.seed = 2;
    EXPECT_NE((*innervate(plan))->fields[1].weight, hand().fields[1].weight);
    plan.seed = 1;
    plan.classes.erase(plan.classes.begin());  // the receptive fields of the other classes must not change
    EXPECT_EQ((*innervate(plan))->fields[0].weight, hand().fields[1].weight);
}

RC_GTEST_PROP(Innervate, WeightsAreProportionalToGaussians, ()) {
    SkinPlan plan{"any", "", *grid_sites(*rc::gen::inRange<std::size_t>(1, 9), *rc::gen::inRange<std::size_t>(1, 9), 2e-3), {}};
    for (auto& p : plan.sites.positions) p.x += *rc::gen::inRange(-9, 9) * 1e-4;
    SkinClass c{"sa1", *plan_afferent("sa1")};
    c.per_site = *rc::gen::inRange(1U, 3U), c.sigma = *rc::gen::inRange(1, 80) * 1e-4;
    c.velocity = 50;
    plan.classes = {c}, plan.nerve = Position{0.01, -0.1, 0};
    const auto skin = *innervate(plan);
    const auto receptive_fields = fields_of_class(*skin, 0);
    for (std::size_t u = 0; u < receptive_fields.size(); ++u) {
        const auto& at = skin->afferents[u].position;
        RC_ASSERT(std::abs(skin->afferents[u].delay - std::hypot(at.x - 0.01, at.y + 0.1) / 50) < 1e-15);
        std::vector<double> expected(plan.sites.size());
        double sum = 0;
        for (std::size_t s = 0; s < expected.size(); ++s) {
            const double d = std::hypot(plan.sites.positions[s].x - at.x, plan.sites.positions[s].y - at.y);
            if (d <= 3 * c.sigma) sum += expected[s] = std::exp(-d * d / (2 * c.sigma * c.sigma));
        }
        for (const auto& [site, weight] : receptive_fields[u]) RC_ASSERT(std::abs(weight - std::exchange(expected[site], 0) / sum) < 1e-12);
        for (const double missed : expected)
            RC_ASSERT(missed / sum < 0.02);  // only sites at the cutoff of 3 sigma, which rounding may exclude
    }
}

TEST(Grid, IsNumberedByRowsUpwardsWithTwoAfferentsPerSite) {
    const auto skin = *innervate(*load_skin_plan("grid 3x2"));
    EXPECT_EQ(skin->plan.sites.names, (std::vector<std::string>{"r1c1", "r1c2", "r2c1", "r2c2", "r3c1", "r3c2"}));
    EXPECT_EQ(skin->plan.sites.positions[3].x, 2e-3);
    EXPECT_EQ(skin->plan.sites.positions[5].y, 4e-3);
    EXPECT_EQ(skin->afferents.size(), 12U);
    EXPECT_EQ(skin->afferent_name(7), "fa1#2");
    EXPECT_EQ(skin->afferents[7].position.x, 2e-3);
    EXPECT_EQ(load_skin_plan("grid:3x2")->name, "grid 3x2");
}

TEST(PopulationNames, AreKnownSuggestedOrRefused) {
    EXPECT_EQ(load_skin_plan("hnad").error().text(),
              "there is no population 'hnad'; did you mean 'hand'? (there are fingertip, hand, grid ROWSxCOLUMNS, and files: own.toml)");
    EXPECT_EQ(load_skin_plan("grid 3").error().text(), "'grid 3' is not a grid; write rows and columns, such as 'grid 8x8'");
    EXPECT_EQ(load_skin_plan("no/such.toml").error().text(), "no/such.toml: cannot be read: there is no such file");
    EXPECT_EQ(load_skin_plan("grid 0x9").error().text(), "a grid of 0 rows and 9 columns: it must have 1 to 4194304 sites");
    for (const auto& s : named_skins()) EXPECT_TRUE(load_skin_plan(s.name)) << s.name;
}

TEST(PopulationFile, ThatNamesTheThesissAfferentsHasThemAndTheirParameters) {
    const auto plan = load_skin_plan(test::source_root() + "/test/skin/thesis_fingertip.toml");
    ASSERT_TRUE(plan) << plan.error().text();
    EXPECT_EQ(plan->classes[0].afferent.composition(), "sa1b+lif-b");
    EXPECT_EQ(plan->classes[1].afferent.composition(), "fa1b+lif-b");
    const auto set = apply_overrides(*plan, test::parse_settings({"sa1.f_B=25Hz", "fa1.f=5Hz"}));
    ASSERT_TRUE(set) << set.error().text();
    EXPECT_TRUE(set->unused.empty());
    EXPECT_EQ(set->result.classes[0].afferent.value("f_B"), 25);
    EXPECT_TRUE(innervate(set->result));
}

constexpr std::string_view pad = R"(unit = "mm"
[sites]
pitch = 1
[[region]]
name = "pad"
shapes = [{capsule = [[0, 0], [0, 20]], width = [10, 8]}]
[[class]]
afferent = "sa1"
density = "70 /cm2"
)";

/// The error of a population file in which `part` is replaced by `replacement`.
std::string error_in(std::string text, std::string_view part, std::string_view replacement) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    const auto plan = parse_skin_plan(text.replace(at, part.size(), replacement), "pad.toml");
    return plan ? "accepted" : plan.error().text();
}

TEST(PopulationFile, SitesCoverTheAreaOfTheShapes) {
    const auto area = [](std::string_view shape) {
        auto text = std::string(pad).replace(pad.find("{capsule"), pad.find("}]") - pad.find("{capsule") + 1, shape);
        text.replace(text.find("pitch = 1"), 9, "pitch = 0.1");
        const auto plan = parse_skin_plan(text, "pad.toml");
        EXPECT_TRUE(plan) << plan.error().text();
        return static_cast<double>(plan->sites.size()) * 0.01;  // mm2
    };
    EXPECT_NEAR(area("{strip = [[1, 2], [13, 7]], width = [10, 8]}"), 13 * 9, 1);
    EXPECT_NEAR(area("{capsule = [[0, 0], [0, 20]], width = 10}"), 200 + M_PI * 25, 1);
    EXPECT_NEAR(area("{ellipse = [3, 4], width = 20, height = 10, angle = 30}"), M_PI * 50, 1);
    EXPECT_NEAR(area("{polygon = [[0, 0], [10, 0], [10, 10], [5, 2]]}"), 35, 1);
}

TEST(PopulationFile, ErrorsGiveTheLocationAndARemedy) {
    const std::string text(pad);
    EXPECT_EQ(error_in(text, "density =", "densty ="),
              "pad.toml:9:1: [[class]]: there is no 'densty'; did you mean 'density'? (there are name, afferent, set, spread, density, "
              "per_site, sigma, depth, surround, hot_spots, hot_spot_spread, receptors, velocity, velocity_spread, direction_gain, "
              "direction, direction_spread, "
              "wave_speed, wave_decay, wave_radius, wave_gain, wave_corner, source)");
    EXPECT_EQ(error_in(text, "\"sa1\"", "\"sa9\"").substr(0, 14), "pad.toml:8:12:");
    EXPECT_EQ(error_in(text, "\"70 /cm2\"", "70"), "pad.toml:9:11: density = 70: the unit is missing; write density = \"70 /cm2\"");
    EXPECT_EQ(error_in(text, "\"70 /cm2\"", "{paed = \"1 /cm2\"}"),
              "pad.toml:9:19: density: there is no region 'paed'; did you mean 'pad'? (there are pad)");
    EXPECT_EQ(error_in(text, "\"70 /cm2\"", "\"70 cm\""),
              "pad.toml:9:11: density: '70 cm' is a length; expected a value in 1/m2, such as '2 1/m2'");
    EXPECT_EQ(error_in(text, "unit = \"mm\"", ""),
              "pad.toml:3:9: pitch = 1: the unit is missing; write pitch = \"1 mm\", or unit = \"mm\" at the top for all lengths");
    EXPECT_EQ(error_in(text, "pitch = 1", "pitch = \"2 m\""), "pad.toml:3:9: pitch = 2 m is outside [10 um, 100 mm]");
    EXPECT_EQ(error_in(text, "pitch = 1", "pitch = 50"),
              "pad.toml:2:1: region 'pad' has no site: it is smaller than the pitch, or earlier regions cover all of it");
    EXPECT_EQ(error_in(text, "pitch = 1", "rows = 2"),
              "pad.toml:2:1: [sites] needs either rows and columns, or a list, or pitch and regions ([[region]])");
    EXPECT_EQ(error_in(text, "width = [10, 8]", "height = 3"), "pad.toml:6:11: a capsule has neither height nor angle");
    EXPECT_EQ(error_in(text, "[0, 20]]", "[0, 20, 1]]"), "pad.toml:6:31: capsule: a position needs two numbers, [x, y]");
    EXPECT_EQ(error_in(text, "density = \"70 /cm2\"", "density = \"70 /cm2\"\nspread = {f_B = \"5%\", f_X = \"5%\"}").substr(0, 65),
              "pad.toml:10:29: sa1: unknown parameter 'f_X'; did you mean 'f_B'?");
    EXPECT_EQ(error_in(text, "density = \"70 /cm2\"", "per_site = 1.5"),
              "pad.toml:9:12: per_site = 1.5: must be an integer from 1 to 1000");
    EXPECT_EQ(error_in(text, "[[class]]", "[[clas]]").substr(0, 55), "pad.toml:7:3: there is no 'clas'; did you mean 'class'?");
    EXPECT_EQ(error_in(text, "[sites]\npitch = 1", "sites = \"chanels\""),
              "pad.toml:2:9: sites = 'chanels': the only word allowed is \"channels\"");
    EXPECT_EQ(error_in(text, "/cm2\"", "/cm2\"\nhot_spots = 3"),
              "pad.toml:10:13: several hot spots need a depth or a sigma, and a hot_spot_spread");
    const auto with = [&](const std::string& keys) { return error_in(text, "/cm2\"", "/cm2\"\n" + keys); };
    EXPECT_EQ(with("depth = 0.6\nsigma = 1"), "pad.toml:10:9: a receptive field has either a depth or a sigma; remove one of them");
    EXPECT_EQ(with("depth = 0"), "pad.toml:10:9: depth = 0 m is outside [10 um, 100 mm]");
    EXPECT_EQ(with("sigma = 1\nsurround = 0.5"), "pad.toml:11:12: surround needs a depth, such as depth = \"0.6 mm\"");
    EXPECT_EQ(with("depth = 0.6\nsurround = 1.5"), "pad.toml:11:12: surround = 1.5 is outside [0, 1]");
    EXPECT_EQ(with("depth = 0.6\nreceptors = \"each\""), "pad.toml:11:13: receptors = 'each': write \"one\" or \"per hot spot\"");
    EXPECT_EQ(with("depth = 0.6\nreceptors = \"per hot spot\""),
              "pad.toml:11:13: receptors = \"per hot spot\" needs several hot spots, such as hot_spots = 4");
    EXPECT_EQ(with("depth = 0.6\nhot_spots = 4\nhot_spot_spread = 1\nreceptors = \"per hot spot\""), "accepted");
    EXPECT_EQ(with("spread = {f_B = \"x3\"}"), "accepted");
    EXPECT_EQ(error_in(text, "\"70 /cm2\"", "\"1 /um2\"").substr(0, 20), "pad.toml:9:11: densi");
}

TEST(PopulationFile, AClassFeelsAContactWaveIfItHasAWaveSpeed) {
    const std::string skin = "[sites]\nrows = 2\ncolumns = 2\npitch = \"2 mm\"\n[[class]]\nafferent = \"fa2\"\nper_site = 1\n";
    const auto wave_of = [&](const std::string& keys) { return parse_skin_plan(skin + keys, "w.toml"); };
    EXPECT_EQ(wave_of("")->classes[0].wave, WaveParams{});
    EXPECT_EQ(wave_of("wave_speed = \"6 m/s\"")->classes[0].wave, WaveParams{.speed = 6});
    const auto all =
        wave_of("wave_speed = \"6 m/s\"\nwave_decay = \"2 cm\"\nwave_radius = \"3 mm\"\nwave_gain = 0.5\nwave_corner = \"9 Hz\"");
    ASSERT_TRUE(all) << all.error().text();
    EXPECT_EQ(all->classes[0].wave, (WaveParams{6, 2e-2, 3e-3, 0.5, 9}));
    EXPECT_EQ(wave_of("wave_gain = 0.5").error().text(), "w.toml:8:13: wave_gain needs a wave_speed: wave_speed = \"8 m/s\"");
    EXPECT_EQ(wave_of("wave_speed = 8").error().text(), "w.toml:8:14: wave_speed = 8: the unit is missing; write wave_speed = \"8 m/s\"");
    EXPECT_EQ(wave_of("wave_speed = \"0.1 m/s\"").error().text(), "w.toml:8:14: wave_speed = 100 mm/s is outside [500 mm/s, 200 m/s]");
    EXPECT_EQ(wave_of("wave_speed = \"8 m/s\"\nwave_decay = \"1 m\"").error().text(),
              "w.toml:9:14: wave_decay = 1 m is outside [1 mm, 200 mm]");
}

TEST(PopulationFile, SitesComeFromAListATableOrARecording) {
    const std::string classes = "[[class]]\nafferent = \"fa1\"\nname = \"quick\"\nper_site = 2\nset = {f = \"3 Hz\"}\nsigma = \"1 mm\"\n";
    const auto listed = parse_skin_plan(
        "[sites]\nlist = [{name = \"a\", x = \"1 mm\", y = \"2 mm\"}, {name = \"b\", x = \"3 mm\", y = \"4 mm\", region = \"top\"}]\n" +
            classes,
        "l.toml");
    ASSERT_TRUE(listed) << listed.error().text();
    EXPECT_EQ(listed->sites.regions, (std::vector<std::string>{"skin", "top"}));
    EXPECT_EQ(listed->classes[0].afferent.name, "quick");
    EXPECT_EQ(listed->classes[0].afferent.value("f"), 3);
    EXPECT_EQ((*innervate(*listed))->afferent_name(3), "quick#4");

    const auto folder = ::testing::TempDir();
    std::ofstream(folder + "places.csv") << "name,x_mm,y_mm,region\n# a comment\n% another\na,1,2,skin\nb,3,4,top\n";
    std::ofstream(folder + "bad.csv") << "name,x_mm,y_mm\na,1,2\nb,here,4\n";
    const auto table = parse_skin_plan("[sites]\nlist = \"places.csv\"\n" + classes, folder + "t.toml");
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_EQ(table->sites.names, listed->sites.names);
    EXPECT_EQ(table->sites.positions[1].y, listed->sites.positions[1].y);
    EXPECT_EQ(parse_skin_plan("[sites]\nlist = \"bad.csv\"\n" + classes, folder + "t.toml").error().text(),
              folder + "bad.csv:3:3: 'here' is not a coordinate");

    const Channel channels[] = {{0, "p1", Position{0, 0, 0}}, {1, "p2", Position{1e-3, 0, 0}}};
    const auto recorded = parse_skin_plan("sites = \"channels\"\n" + classes, "c.toml", channels);
    ASSERT_TRUE(recorded) << recorded.error().text();
    EXPECT_EQ(recorded->sites.names, (std::vector<std::string>{"p1", "p2"}));
    const Channel nowhere[] = {{0, "p1"}};
    EXPECT_EQ(parse_skin_plan("sites = \"channels\"\n" + classes, "c.toml", nowhere).error().text().substr(0, 44),
              "c.toml:1:9: channel 'p1' has no position on ");
}

TEST(PopulationFile, TheExampleInTheManualIsAccepted) {
    std::ifstream page(test::source_root() + "/doc/skin.md");
    std::stringstream all;
    all << page.rdbuf();
    const auto text = all.str();
    const auto from = text.find("```toml\n") + 8;
    const auto plan = parse_skin_plan(text.substr(from, text.find("```", from) - from), "manual.toml");
    ASSERT_TRUE(plan) << plan.error().text();
    EXPECT_TRUE(innervate(*plan));
}

}  // namespace
}  // namespace corpuscle
