// Output for copies: the summary over them, and the table of each copy's parameters and measures.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/spikes/spike_files.hpp"
#include "run/run_inputs.hpp"
#include "run/summary/run_summary.hpp"
#include "support/property.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;

struct CopiesOfAfferents {
    std::vector<AfferentPlan> base, copies;
    CopySpec population;
};

CopiesOfAfferents make_test_copies(const std::vector<std::string>& names, std::uint32_t n, const std::vector<std::string>& spreads) {
    CopiesOfAfferents out;
    out.population.count = n;
    for (const auto& name : names) {
        out.base.push_back(value_or_throw(plan_afferent(name)));
        const auto distributions = value_or_throw(distributions_for(out.base.back(), test::parse_settings(spreads))).result;
        for (auto& c : value_or_throw(make_copies(out.base.back(), n, distributions, 4))) out.copies.push_back(c);
        out.population.distributions.insert(out.population.distributions.end(), distributions.begin(), distributions.end());
    }
    return out;
}

void simulate_press_and_sine(std::span<const AfferentPlan> plans, std::initializer_list<Sink*> sinks) {
    std::vector<std::unique_ptr<ForceSource>> sources;
    sources.push_back(value_or_throw(make_stimulus("press", 2e3, 0)));
    sources.push_back(value_or_throw(make_stimulus("sine", 2e3, 0)));
    (void)value_or_throw(corpuscle::run(sources, plans, std::vector<Sink*>(sinks), {}));
}

struct Statistics {
    double mean = no_value, deviation = no_value, min = no_value, max = no_value;
    std::int64_t n = 0;
};

/// The same statistics, computed from their definitions.
Statistics statistics(std::vector<double> x) {
    std::erase_if(x, [](double v) { return std::isnan(v); });
    Statistics s;
    s.n = static_cast<std::int64_t>(x.size());
    if (x.empty()) return s;
    double sum = 0, squares = 0;
    for (const double v : x) sum += v;
    s.mean = sum / static_cast<double>(x.size());
    for (const double v : x) squares += (v - s.mean) * (v - s.mean);
    if (x.size() > 1) s.deviation = std::sqrt(squares / static_cast<double>(x.size() - 1));
    std::sort(x.begin(), x.end());
    s.min = x.front(), s.max = x.back();
    return s;
}

bool is_nearly_equal(double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-9 * (1 + std::abs(b)); }

TEST(CopyStatistics, AreTheMeanDeviationMinAndMaxOfTheCopiesWithAValue) {
    EXPECT_TRUE(rc::check("compared with the definitions", [] {
        std::vector<double> x;
        for (const int k : *rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1001)))
            x.push_back(k % 7 == 0 ? no_value : k / 8.0);
        CopyStatistics accumulated;
        for (const double v : x) accumulated.add(v);
        const auto expected = statistics(x);
        RC_ASSERT(accumulated.copies == expected.n);
        RC_ASSERT(is_nearly_equal(accumulated.mean(), expected.mean));
        RC_ASSERT(is_nearly_equal(accumulated.standard_deviation(), expected.deviation));
        RC_ASSERT(is_nearly_equal(accumulated.min, expected.min) && is_nearly_equal(accumulated.max, expected.max));
    }));
}

/// The length of the phase of a row, or of its entire input, s.
double length_of(const RunSummary& summary, const MeasureRow& row) {
    for (const auto& input : summary.inputs) {
        if (std::find(input.channels.begin(), input.channels.end(), row.channel) == input.channels.end()) continue;
        for (const auto& p : input.phases)
            if (p.name == row.phase) return p.to - p.from;
        if (row.phase == "all") return static_cast<double>(input.samples) * input.clock.T();
    }
    return no_value;
}

/// The row of a single afferent has no mean rate if there is one spike, but the mean over copies includes that rate.
TEST(Summary, OfCopiesHasTheStatisticsOfTheirSeparateRows) {
    const auto p = make_test_copies({"sa1", "fa1"}, 25, {"sa1.f_B=20%", "sa1.V_th=40%", "fa1.k_A=40%"});
    auto separate_plans = p.copies;  // the same plans, as if each had been requested separately
    for (auto& plan : separate_plans) plan.copy_number = 0;
    RunSummary combined, separate;
    simulate_press_and_sine(p.copies, {&combined});
    simulate_press_and_sine(separate_plans, {&separate});
    ASSERT_EQ(combined.rows.size(), 2U * 5 + 2);
    ASSERT_EQ(separate.rows.size(), 25 * combined.rows.size());
    for (const auto& row : combined.rows)
        for (std::size_t m = 0; m < std::size(measures); ++m) {
            std::vector<double> values;
            for (const auto& r : separate.rows)
                if (r.afferent.starts_with(row.afferent + "#") && r.channel == row.channel && r.phase == row.phase)
                    values.push_back(m == measure_index<MeanRate>() && r.values[measure_index<SpikeCount>()] == 1
                                         ? 1 / length_of(separate, r)
                                         : r.values[m]);
            ASSERT_EQ(values.size(), 25U);
            const auto expected = statistics(values);
            const auto& accumulated = row.copy_statistics[m];
            EXPECT_EQ(accumulated.copies, expected.n) << row.phase << ' ' << measures[m].name;
            EXPECT_TRUE(is_nearly_equal(accumulated.mean(), expected.mean) &&
                        is_nearly_equal(accumulated.standard_deviation(), expected.deviation))
                << row.phase << ' ' << measures[m].name;
            EXPECT_TRUE(is_nearly_equal(accumulated.min, expected.min) && is_nearly_equal(accumulated.max, expected.max))
                << row.phase << ' ' << measures[m].name;
        }
}

TEST(Summary, OfAHundredTimesAsManyCopiesHasTheSameLength) {
    const auto size = [](std::uint32_t n) {
        const auto p = make_test_copies({"sa1"}, n, {"sa1.f_B=10%"});
        RunSummary summary;
        simulate_press_and_sine(p.copies, {&summary});
        const auto document = summary.document(p.base, {}, {}, {});
        EXPECT_EQ(document["afferents"].size(), 1U);
        EXPECT_EQ(document["rates"].size(), 6U);
        EXPECT_EQ(document["rates"][1]["spikes"]["copies"], n);
        return document.dump().size();
    };
    EXPECT_NEAR(static_cast<double>(size(300)), static_cast<double>(size(3)), 3000);
}

std::vector<std::vector<std::string>> table_of(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line + ",");
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

TEST(CopiesFile, HasTheParametersOfEachCopyAndTheMeasuresOfItsTrain) {
    const TemporaryFolder folder;
    const auto p = make_test_copies({"sa1", "fa1"}, 4, {"sa1.f_B=20%", "sa1.V_th=10%", "fa1.V_th=10%", "fa1.k_A=10%"});
    const auto file = test::make_sink(copies_format, folder.path(), {.copies = p.population}),
               spikes = test::make_sink(spikes_format, folder.path());
    simulate_press_and_sine(p.copies, {file.get(), spikes.get()});
    ASSERT_TRUE(bool(file->commit()) && bool(spikes->commit()));
    const auto rows = table_of(test::read_file(folder / "copies.csv"));
    ASSERT_EQ(rows.size(), 1U + 2 * 8);
    const auto at = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    };
    EXPECT_EQ((std::vector(rows[0].begin(), rows[0].begin() + 6)),
              (std::vector<std::string>{"afferent", "channel", "f_B_Hz", "V_th_V", "k_A_A/N", "spikes"}));
    EXPECT_EQ(rows[0].size(), 5 + std::size(measures));
    const auto trains = value_or_throw(read_spikes(folder / "spikes.csv"));
    EXPECT_EQ(trains.size(), 12U);
    for (std::size_t k = 1; k < rows.size(); ++k) {
        ASSERT_EQ(rows[k].size(), rows[0].size());
        const auto& plan = *std::find_if(p.copies.begin(), p.copies.end(), [&](const auto& c) { return c.name == rows[k][0]; });
        EXPECT_EQ(rows[k][1], k <= 8 ? "press" : "sine");
        EXPECT_EQ(std::stod(rows[k][at("V_th_V")]), *plan.value("V_th")) << "written with all digits";
        EXPECT_EQ(rows[k][at("f_B_Hz")].empty(), plan.original_name == "fa1");
        EXPECT_EQ(rows[k][at("k_A_A/N")].empty(), plan.original_name == "sa1");
        const auto train =
            std::find_if(trains.begin(), trains.end(), [&](const auto& t) { return t.name() == rows[k][0] + "," + rows[k][1]; });
        EXPECT_EQ(rows[k][at("vector_strength")].empty(), rows[k][1] == "press" || plan.original_name == "fa1")
            << "the press has no cycle, fa1 no spikes";
        EXPECT_EQ(std::stoul(rows[k][at("spikes")]), train == trains.end() ? 0 : train->times.size());
        if (train == trains.end()) continue;  // silent
        const auto rates = instantaneous_rates(train->times);
        EXPECT_NEAR(std::stod(rows[k][at("peak_rate_Hz")]), *std::max_element(rates.begin(), rates.end()), 1e-3);
        EXPECT_NEAR(std::stod(rows[k][at("latency_s")]), train->times[0], 1e-8);
    }
}

}  // namespace
}  // namespace corpuscle
