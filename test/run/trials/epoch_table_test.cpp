// Tables of epochs: their forms, and the errors of damaged ones.

#include "run/trials/epoch_table.hpp"

#include <algorithm>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;

EpochTable read(const std::string& name, const std::string& text, const std::optional<std::string>& label = {}) {
    const TemporaryFolder folder;
    folder.write(name, text);
    return value_or_throw(read_epochs(folder / name, label));
}

TEST(EpochTable, HasTheSameTrialsInEveryFormat) {
    const std::pair<const char*, const char*> tables[] = {
        {"a.csv", "start,stop,label\n1,2.5,rough\n3,4,smooth\n"},
        {"a.tsv", "onset\tduration\ttrial_type\n1\t1.5\trough\n3\t1\tsmooth\n"},
        {"a.csv", "start_ms,stop_ms,condition\n1000,2500,rough\n3000,4000,smooth\n"},
        {"a.csv", "# a comment\nlabel;start [s];stop [s]\n\"rough\";1;2.5\nsmooth;3;4\n"},
        {"a.csv", "start_time,stop_time,label\n1s,2500ms,rough\n3 s,4000000 us,smooth\n"},
        {"a.jsonl", "{\"start\":1,\"stop\":2.5,\"label\":\"rough\"}\n{\"label\":\"smooth\",\"stop\":4,\"start\":3}\n"},
        {"a.json", "[{\"start\":1,\"stop\":2.5,\"label\":\"rough\"},{\"start\":3,\"stop\":4,\"label\":\"smooth\"}]"}};
    for (const auto& [name, text] : tables) {
        const auto table = read(name, text);
        ASSERT_EQ(table.trials.size(), 2U) << text;
        EXPECT_EQ(table.trials[0].start, 1) << text;
        EXPECT_EQ(table.trials[0].stop, 2.5) << text;
        EXPECT_EQ(table.trials[0].label, "rough") << text;
        EXPECT_EQ(table.trials[1].start, 3) << text;
        EXPECT_EQ(table.trials[1].stop, 4) << text;
        EXPECT_EQ(table.trials[1].label, "smooth") << text;
        EXPECT_TRUE(table.notes.empty()) << text;
    }
}

TEST(EpochTable, DoesNotDependOnTheOrderOfItsRowsAndAllowsOverlap) {
    EXPECT_TRUE(rc::check("shuffled rows", [] {
        auto rows = *rc::gen::container<std::vector<std::tuple<int, int, int>>>(
            rc::gen::tuple(rc::gen::inRange(0, 100), rc::gen::inRange(1, 50), rc::gen::inRange(0, 3)));
        rows.push_back({5, 20, 1});
        const auto text_of = [&] {
            std::string text = "start,stop,label\n";
            for (const auto& [start, length, label] : rows)
                text += std::to_string(start) + "," + std::to_string(start + length) + ",l" + std::to_string(label) + "\n";
            return text;
        };
        const auto first = read("a.csv", text_of());
        std::rotate(rows.begin(), rows.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(rows.size())), rows.end());
        std::reverse(rows.begin(), rows.end());
        const auto second = read("a.csv", text_of());
        RC_ASSERT(first.trials.size() == second.trials.size());
        for (std::size_t k = 0; k < first.trials.size(); ++k)
            RC_ASSERT(std::tie(first.trials[k].start, first.trials[k].stop, first.trials[k].label) ==
                      std::tie(second.trials[k].start, second.trials[k].stop, second.trials[k].label));
    }));
}

TEST(EpochTable, TakesLabelsFromTheColumnThatIsAskedForAndReportsOthers) {
    const auto table = read("a.csv", "start,stop,force,texture\n1,2,high,denim\n", "texture");
    EXPECT_EQ(table.trials[0].label, "denim");
    ASSERT_EQ(table.notes.size(), 1U);
    EXPECT_EQ(table.notes[0], "'force' is not used");
    EXPECT_EQ(read("a.csv", "start,stop\n1,2\n").trials[0].label, "trial");
}

TEST(EpochTable, NamesFileRowAndValueOfAnError) {
    const TemporaryFolder folder;
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"start,stop,label\n1,2,a\n3,x,b\n", "a.csv:3:3: 'stop': 'x' is not a time", "write start,stop,label"},
        {"start,stop,label\n1,,a\n", "a.csv:2:3: 'stop': an empty field is not a time", "such as"},
        {"start,stop,label\n2,1,a\n", "a.csv:2:3: the trial stops at 1 s, but starts at 2 s", "must be after start"},
        {"start,stop,label\n1,1,a\n", "a.csv:2:3: the trial stops at 1 s, but starts at 1 s", "must be after start"},
        {"start,duration\n1,0\n", "a.csv:2:3: the trial lasts 0 s", "must be above 0"},
        {"start,stop,label\n1,2\n", "a.csv:2: 2 columns where 3 are expected", "write"},
        {"start,stop,label\nnan,2,a\n", "a.csv:2:1: 'start': 'nan' is not a time", "write"},
        {"start,stop,label\n1,inf,a\n", "a.csv:2:3: 'stop': 'inf' is not a time", "write"},
        {"begin_N,end,label\n1,2,a\n", "a.csv:1: 'begin' is in 'N', which is not a unit of time", "begin_s"},
        {"trial,label\n1,a\n", "a.csv:1: a table of trials has the columns start, stop and label; this one has: trial, label", "rename"},
        {"start,stop,label\n", "a.csv: there are no trials in this file", "write"},
        {"", "a.csv", ""},
        {"{\"start\":1,\"stop\":2}\n{\"start\":\"q\",\"stop\":3}\n", "a.csv:2: 'start': 'q' is not a time", "write"},
    };
    for (const auto& [text, message, remedy] : cases) {
        folder.write("a.csv", text);
        const auto table = read_epochs(folder / "a.csv");
        ASSERT_FALSE(table) << text;
        EXPECT_NE(table.error().text().find(message), std::string::npos) << table.error().text();
        EXPECT_NE(table.error().text().find(remedy), std::string::npos) << table.error().text();
    }
    folder.write("a.csv", "start,stop\n1,2\n");
    const auto no_label = read_epochs(folder / "a.csv", "texture");
    ASSERT_FALSE(no_label);
    EXPECT_NE(no_label.error().text().find("--label texture: there is no such column; there are: start, stop"), std::string::npos);
    EXPECT_FALSE(read_epochs(folder / "none.csv"));
}

}  // namespace
}  // namespace corpuscle
