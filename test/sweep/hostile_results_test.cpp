// A results file that another program has changed is refused, with the fault and the remedy. No SQL in it is executed.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>

#include "support/plain_sweep.hpp"
#include "support/support.hpp"
#include "sweep/parallel/run_sweep.hpp"
#include "sweep/stats/sweep_table.hpp"
#include "sweep/store/sqlite.hpp"

namespace corpuscle {
namespace {

using test::PlainSweep;
using test::read_file;
using test::TemporaryFolder;
using test::value_or_throw;

/// The path of a results file of 100 items, changed by SQL statements as another program might.
std::string changed_results(const TemporaryFolder& folder, const std::string& statements) {
    const auto path = folder / "r.sqlite";
    const PlainSweep sweep(100);
    {
        auto results = value_or_throw(SweepResults::open(path, sweep));
        std::vector<ItemOutcome> all;
        for (std::int64_t item = 0; item < 100; ++item) all.push_back(sweep.outcome(item));
        EXPECT_TRUE(results.add(sweep, std::move(all)) && results.checkpoint());
    }
    sqlite3* file = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &file), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(file, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(file);
    sqlite3_close(file);
    return path;
}

std::string refusal_of(const std::string& path) {
    const auto results = SweepResults::open_read_only(path);
    return results ? "" : results.error().text();
}

/// Schema and contents of a results file of format 1.
constexpr const char* first_format = R"tables(
CREATE TABLE about(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE columns(position INTEGER PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, sentence TEXT NOT NULL,
                     words TEXT NOT NULL, at_least REAL, at_most REAL, stored TEXT NOT NULL);
CREATE TABLE spikes(unit INTEGER NOT NULL, train INTEGER NOT NULL, times BLOB NOT NULL, PRIMARY KEY(unit, train)) WITHOUT ROWID;
CREATE TABLE traces(unit INTEGER NOT NULL, trace INTEGER NOT NULL, samples BLOB NOT NULL, PRIMARY KEY(unit, trace)) WITHOUT ROWID;
CREATE TABLE units(unit INTEGER PRIMARY KEY, ended TEXT NOT NULL, steps INTEGER NOT NULL, iterations INTEGER NOT NULL,
                   alone INTEGER NOT NULL, why TEXT NOT NULL, "temp" REAL, "v(q)" REAL);
INSERT INTO about VALUES('facts', '["title","results format"]'), ('title', 'old'), ('results format', '1'), ('units', '2'),
    ('trains', '["out"]'), ('traces', '[]'), ('trace_times', '[]');
INSERT INTO columns VALUES(0, 'axis', 'temp', 'C', '', '[]', NULL, NULL, 'temp'), (1, 'measure', 'v(q)', 'V', '', '[]', 0.3, NULL, 'v(q)');
INSERT INTO units VALUES(0, 'done', 1, 2, 0, '', 27, 0.35), (1, 'lost', 1, 2, 0, 'no rest', 85, NULL);
INSERT INTO spikes VALUES(0, 0, X'000000000000F03F');
PRAGMA application_id = 1400333680;
)tables";

std::string old_results(const TemporaryFolder& folder, const std::string& statements) {
    const auto path = folder / "old.sqlite";
    sqlite3* file = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &file), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(file, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(file);
    sqlite3_close(file);
    return path;
}

TEST(SweepResults, OfTheFirstFormatAreReadAndThoseOfALaterFormatRefused) {
    const TemporaryFolder folder;
    const auto results =
        value_or_throw(SweepResults::open_read_only(old_results(folder, std::string(first_format) + "PRAGMA user_version = 1;")));
    EXPECT_EQ(results.finished_count(), 2);
    std::string text;
    ASSERT_TRUE(dump_results(results, [&](const std::string& more) { return text += more, true; }));
    EXPECT_EQ(text,
              "item,ended,steps,iterations,alone,why,temp,v(q),spikes of out\n0,done,1,2,0,,27,0.35,1\n1,diverged,1,2,0,no rest,85,,\n");
    const TemporaryFolder later;
    const auto refused = SweepResults::open_read_only(old_results(later, std::string(first_format) + "PRAGMA user_version = 3;"));
    ASSERT_FALSE(refused);
    EXPECT_NE(
        refused.error().text().find("was written by a later corpuscle (its format is 3, this one reads up to 2): use the later version"),
        std::string::npos)
        << refused.error().text();
}

TEST(SweepResults, OfTheFirstFormatAreNotExtendedOrMergedAndTheRemedyIsNamed) {
    const TemporaryFolder folder;
    const auto path = old_results(folder, std::string(first_format) + "PRAGMA user_version = 1;");
    auto results = value_or_throw(SweepResults::open_read_only(path));
    EXPECT_EQ(value_or_throw(results.file().query_integer("SELECT count(*) FROM items WHERE ended = 'diverged'")), 1);
    EXPECT_EQ(value_or_throw(results.spikes(0, 0)), std::vector<double>{1.0});
    const auto table = value_or_throw(read_table(results, {}));
    EXPECT_EQ(table.items, (std::vector<std::int64_t>{0, 1}));
    EXPECT_EQ(table.ends, (std::vector<ItemEnd>{ItemEnd::done, ItemEnd::diverged}));
    const auto bytes = read_file(path);
    const PlainSweep sweep(100);
    const auto extended = SweepResults::open(path, sweep);
    ASSERT_FALSE(extended);
    EXPECT_EQ(
        extended.error().message,
        "has results of format 1, of an earlier corpuscle; this one writes format 2 and only reads the earlier one (sweep show, sweep "
        "dump). To compute or merge, run the sweep into another file: corpuscle sweep FILE --out NEW.sqlite");
    auto into = value_or_throw(SweepResults::open(folder / "all.sqlite", sweep));
    const auto merged = into.merge(results);
    ASSERT_FALSE(merged);
    EXPECT_EQ(merged.error().message, extended.error().message);
    EXPECT_EQ(read_file(path), bytes) << "it is not changed";
}

TEST(HostileResults, WithoutAColumnAreRefusedByItsName) {
    const struct {
        const char *statements, *message;
    } cases[] = {{"ALTER TABLE items RENAME COLUMN gain TO gian", "its table 'items' has no column 'gain'"},
                 {"ALTER TABLE items RENAME COLUMN ended TO over", "its table 'items' has no column 'ended'"},
                 {"ALTER TABLE spikes RENAME COLUMN times TO t", "its table 'spikes' has no column 'times'"},
                 {"ALTER TABLE columns RENAME COLUMN unit TO u", "its table 'columns' has no column 'unit'"},
                 {"ALTER TABLE traces RENAME TO trace", "it has no table 'traces'"},
                 {"PRAGMA user_version = 0", "its format version is missing"},
                 {"UPDATE about SET value = '-5' WHERE key = 'items'", "its number of items is -5"},
                 {"UPDATE about SET value = '[[' WHERE key = 'trains'", "its tables about and columns cannot be read"}};
    for (const auto& c : cases) {
        const TemporaryFolder folder;
        const auto message = refusal_of(changed_results(folder, c.statements));
        EXPECT_NE(message.find(c.message), std::string::npos) << c.statements << ": " << message;
        EXPECT_NE(message.find("another file"), std::string::npos) << message;
    }
}

TEST(HostileResults, OfItemsThatTheSweepDoesNotHaveAreRefused) {
    for (const auto* item : {"-1", "100", "4611686018427387904"}) {
        const TemporaryFolder folder;
        const auto path = changed_results(folder, fmt::format("UPDATE items SET item = {} WHERE item = 7", item));
        EXPECT_NE(refusal_of(path).find(fmt::format("it holds item {}, of a sweep of 100 items (0 to 99)", item)), std::string::npos)
            << refusal_of(path);
        EXPECT_FALSE(SweepResults::open(path, PlainSweep(100)));
    }
}

TEST(HostileResults, OpeningExecutesNoTriggerOfTheSchema) {
    const TemporaryFolder folder;
    const auto path = changed_results(folder,
                                      "DELETE FROM items WHERE item > 50; DELETE FROM spikes; DELETE FROM traces;"
                                      "CREATE TRIGGER t AFTER INSERT ON items BEGIN UPDATE items SET ended = 'diverged'; END");
    const PlainSweep sweep(100);
    auto results = value_or_throw(SweepResults::open(path, sweep));
    std::vector<ItemOutcome> one;
    one.push_back(sweep.outcome(60));
    ASSERT_TRUE(results.add(sweep, std::move(one)));
    std::int64_t diverged = 0, expected_diverged = 0;
    ASSERT_TRUE(results.for_each_row([&](const std::vector<double>&, const ItemOutcome& row) {
        diverged += row.end == ItemEnd::diverged, expected_diverged += sweep.outcome(row.item).end == ItemEnd::diverged;
        return true;
    }));
    EXPECT_EQ(diverged, expected_diverged);
}

TEST(HostileResults, WithAViewInsteadOfATableAreRefused) {
    const TemporaryFolder folder;
    const auto path = changed_results(folder,
                                      "ALTER TABLE items RENAME TO old;"
                                      "CREATE VIEW items AS WITH RECURSIVE n(item) AS (SELECT 1 UNION ALL SELECT item + 1 FROM n) "
                                      "SELECT item, 'done' AS ended, 1 AS steps, 1 AS iterations, 0 AS alone, '' AS why FROM n");
    const auto message = refusal_of(path);
    EXPECT_NE(message.find("changed by another program"), std::string::npos) << message;
}

TEST(HostileResults, WithAVeryLargeTextAreRefusedBeforeItIsLoaded) {
    const TemporaryFolder folder;
    const auto path = changed_results(folder, "UPDATE columns SET words = '[\"' || hex(zeroblob(5000000)) || '\"]' WHERE position = 0");
    EXPECT_NE(refusal_of(path).find("its table columns holds more than 4 MB of labels"), std::string::npos) << refusal_of(path);
    const TemporaryFolder other;
    const auto big = changed_results(other, "UPDATE about SET value = zeroblob(100000000) WHERE key = 'trace_times'");
    EXPECT_NE(refusal_of(big).find("a text or a blob is larger than 64 MB"), std::string::npos) << refusal_of(big);
}

TEST(HostileResults, InAnotherOrderOfColumnsAreMergedColumnByColumn) {
    const TemporaryFolder folder;
    const PlainSweep sweep(100);
    const auto path = changed_results(folder,
                                      "DELETE FROM items WHERE item < 50; DELETE FROM spikes WHERE item < 50; DELETE FROM traces WHERE "
                                      "item < 50; ALTER TABLE items ADD COLUMN extra; ALTER TABLE items RENAME COLUMN why TO w;"
                                      "ALTER TABLE items ADD COLUMN why TEXT NOT NULL DEFAULT ''; UPDATE items SET why = w");
    auto into = value_or_throw(SweepResults::open(folder / "all.sqlite", sweep));
    const auto merged = into.merge(value_or_throw(SweepResults::open_read_only(path)));
    ASSERT_TRUE(merged) << merged.error().text();
    EXPECT_EQ(*merged, 50);
    ASSERT_TRUE(into.for_each_row([&](const std::vector<double>&, const ItemOutcome& row) {
        const auto o = sweep.outcome(row.item);
        EXPECT_EQ(row.steps, o.steps);
        EXPECT_EQ(row.reason, o.reason);
        return true;
    }));
}

TEST(HostileResults, OpeningNeverEmptiesALinkOrAForeignFile) {
    const TemporaryFolder folder;
    folder.write("thesis.tex", "years of work\n");
    std::filesystem::create_symlink("thesis.tex", folder / "r.sqlite-writer");
    const auto refused = SweepResults::open(folder / "r.sqlite", PlainSweep(10));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().text().find("r.sqlite-writer: is at the path of the results' lock file"), std::string::npos)
        << refused.error().text();
    std::filesystem::remove(folder / "r.sqlite-writer");
    folder.write("r.sqlite-writer", "years of work\n");
    EXPECT_FALSE(SweepResults::open(folder / "r.sqlite", PlainSweep(10)));
    EXPECT_EQ(test::read_file(folder / "r.sqlite-writer"), "years of work\n");
    std::filesystem::remove(folder / "r.sqlite-writer");
    std::filesystem::create_symlink("thesis.tex", folder / "r.sqlite-fold");
    folder.write("lock-of-a-killed-run", "4711 1790000000.000 5 10 host\n");
    std::filesystem::rename(folder / "lock-of-a-killed-run", folder / "r.sqlite-writer");
    EXPECT_TRUE(SweepResults::open(folder / "r.sqlite", PlainSweep(10)));
    EXPECT_EQ(test::read_file(folder / "thesis.tex"), "years of work\n");
}

}  // namespace
}  // namespace corpuscle
