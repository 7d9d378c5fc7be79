#include "study/sweep/results.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>

#include "study/sweep/results_held.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "spikes and traces have the same byte order in the file and in memory");

constexpr std::array<std::string_view, 3> unit_ends = {"done", "capped", "lost"};

UnitEnd end_of(std::string_view word) {
    const auto* at = std::find(unit_ends.begin(), unit_ends.end(), word);
    return at == unit_ends.end() ? UnitEnd::lost : static_cast<UnitEnd>(at - unit_ends.begin());
}

std::string insertion(const std::vector<std::string>& columns) {
    std::string names = "unit, ended, steps, iterations, alone, why", values = "?, ?, ?, ?, ?, ?";
    for (const auto& column : columns) names += ", " + sql::name(column), values += ", ?";
    return fmt::format("INSERT INTO units({}) VALUES({}) ON CONFLICT(unit) DO NOTHING", names, values);
}

/// The numbers of a blob; an incomplete last number is ignored.
template <class T>
std::vector<T> numbers(std::span<const std::byte> bytes) {
    std::vector<T> out(bytes.size() / sizeof(T));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
}

template <class T>
Result<std::vector<T>> blob(sqlite3* file, const std::string& path, const char* query, std::int64_t item, std::size_t which) {
    auto row = sql::Statement::make(file, path, query);
    if (!row) return row.error();
    const auto found = row->set(1, item).set(2, static_cast<std::int64_t>(which)).step();
    if (!found) return found.error();
    return *found ? numbers<T>(row->bytes(0)) : std::vector<T>{};
}

Result<void> make_folder(const std::string& path) {
    const auto folder = fs::path(path).parent_path();
    std::error_code failed;
    if (!folder.empty()) fs::create_directories(folder, failed);
    if (failed) return bad_input(fmt::format("its folder cannot be created ({}); give another path with --out", failed.message()), {path});
    return {};
}

Error needs_writable_folder(const std::string& path) {
    return bad_input(
        "was left by a run that was killed, and can be read only in a writable folder: copy it, together with "
        "its -wal file, to such a folder",
        {path});
}

}  // namespace

std::string_view word_of(UnitEnd end) { return unit_ends[static_cast<std::size_t>(end)]; }

Result<void> SweepResults::Held::open_file(int flags) {
    auto opened = sql::open(path, flags);
    if (!opened) return opened.error();
    file = std::move(*opened);
    return {};
}

Result<void> SweepResults::Held::begin_writing() {
    if (writing) return {};
    if (!lock) return bad_input("was opened for reading only", {path});
    if (auto ok =
            sql::run(file.get(), path,
                     "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0; PRAGMA synchronous = FULL; PRAGMA cache_size = -32768");
        !ok)
        return ok;
    const auto make = [&](const std::string& text, sql::Statement& out) -> Result<void> {
        auto made = sql::Statement::make(file.get(), path, text);
        if (!made) return made.error();
        out = std::move(*made);
        return {};
    };
    if (auto ok = make(insertion(layout.stored), unit); !ok) return ok;
    if (auto ok = make("INSERT INTO spikes(unit, train, times) VALUES(?, ?, ?)", spikes); !ok) return ok;
    if (auto ok = make("INSERT INTO traces(unit, trace, samples) VALUES(?, ?, ?)", trace); !ok) return ok;
    set_next_fold();
    writing = true;
    return {};
}

Result<void> SweepResults::Held::put(const Sweep& sweep, const UnitOutcome& o) {
    const auto values = sweep.values(o.unit);
    if (o.unit < 0 || o.unit >= layout.units || (!o.measures.empty() && o.measures.size() != layout.measures.size()) ||
        values.size() != layout.axes.size())
        return bad_input(fmt::format("unit {} with {} axes and {} measures does not fit {} units with {} and {}", o.unit, values.size(),
                                     o.measures.size(), layout.units, layout.axes.size(), layout.measures.size()),
                         {path});
    unit.set(1, o.unit).set(2, word_of(o.end)).set(3, o.steps).set(4, o.iterations).set(5, std::int64_t{o.alone});
    unit.set(6, std::string_view(o.why));
    int position = 7;
    for (const double x : values) unit.set(position++, x);
    for (std::size_t k = 0; k < layout.measures.size(); ++k, ++position)
        k < o.measures.size() ? unit.set(position, o.measures[k]) : unit.set_nothing(position);
    if (auto ok = unit.finish(); !ok) return ok;
    if (sqlite3_changes(file.get()) == 0) return {};  // the item has a row already
    ++finished;
    for (std::size_t k = 0; k < o.spikes.size(); ++k)
        if (!o.spikes[k].empty())
            if (auto ok = spikes.set(1, o.unit).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.spikes[k]))).finish();
                !ok)
                return ok;
    for (std::size_t k = 0; k < o.traces.size(); ++k)
        if (auto ok = trace.set(1, o.unit).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.traces[k]))).finish(); !ok)
            return ok;
    return {};
}

Result<SweepResults> SweepResults::open(const std::string& path, const Sweep& sweep) { return open_as(path, ResultsLayout::of(sweep)); }

Result<SweepResults> SweepResults::open(const std::string& path, const SweepResults& other) { return open_as(path, other.held_->layout); }

Result<SweepResults> SweepResults::open_as(const std::string& path, const ResultsLayout& expected) {
    auto impl = std::make_unique<Held>();
    impl->path = path;
    if (auto ok = make_folder(path); !ok) return ok.error();
    auto lock = WriterLock::take(path);
    if (!lock) return lock.error();
    impl->lock = std::move(*lock);
    ::unlink(impl->folded().c_str());  // left by a killed run
    if (std::error_code none; !fs::exists(path, none)) {
        impl->layout = expected;
        if (auto ok = impl->make(); !ok) return ok.error();
    }
    if (auto ok = impl->open_file(SQLITE_OPEN_READWRITE); !ok) return ok.error();
    auto stored = ResultsLayout::read(impl->file.get(), path);
    if (!stored) return stored.error();
    impl->layout = std::move(*stored);
    if (const auto difference = expected.differs_from(impl->layout); !difference.empty())
        return bad_input(fmt::format("holds results of another sweep: {}. Give another file with --out, undo the change, or "
                                     "remove this file",
                                     difference),
                         {path});
    const auto rows = sql::integer(impl->file.get(), path, "SELECT count(*) FROM units");
    if (!rows) return rows.error();
    impl->finished = *rows;
    return SweepResults(std::move(impl));
}

Result<SweepResults> SweepResults::look(const std::string& path) {
    std::error_code none;
    if (!fs::exists(path, none)) return bad_input("does not exist; 'corpuscle sweep FILE --out RESULTS' creates it", {path});
    auto impl = std::make_unique<Held>();
    impl->path = path;
    if (auto ok = impl->open_file(SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX); !ok) return ok.error();
    auto stored = ResultsLayout::read(impl->file.get(), path);
    if (!stored && (sqlite3_errcode(impl->file.get()) & 0xff) == SQLITE_CANTOPEN) {
        // SQLite needs a file beside it, which cannot be created here. It is not needed if the -wal has no rows.
        if (fs::exists(impl->wal(), none) && fs::file_size(impl->wal(), none) > 0) return needs_writable_folder(path);
        auto opened =
            sql::open("file:" + fs::absolute(path).string() + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX);
        if (!opened) return opened.error();
        impl->file = std::move(*opened);
        stored = ResultsLayout::read(impl->file.get(), path);
    }
    if (!stored) return stored.error();
    impl->layout = std::move(*stored);
    if (auto ok = sql::run(impl->file.get(), path, "PRAGMA query_only = 1"); !ok) return ok.error();
    const auto rows = sql::integer(impl->file.get(), path, "SELECT count(*) FROM units");
    if (!rows) return rows.error();
    impl->finished = *rows;
    return SweepResults(std::move(impl));
}

SweepResults::SweepResults(std::unique_ptr<Held> impl) : held_(std::move(impl)) {}
SweepResults::SweepResults(SweepResults&&) noexcept = default;
SweepResults& SweepResults::operator=(SweepResults&&) noexcept = default;
SweepResults::~SweepResults() = default;

Result<void> SweepResults::add(const Sweep& sweep, std::vector<UnitOutcome>&& outcomes) {
    if (outcomes.empty()) return {};
    std::sort(outcomes.begin(), outcomes.end(), [](const UnitOutcome& a, const UnitOutcome& b) { return a.unit < b.unit; });
    auto& impl = *held_;
    const auto before = impl.finished;
    auto ok = impl.begin_writing();
    if (ok) ok = sql::run(impl.file.get(), impl.path, "BEGIN IMMEDIATE");
    for (std::size_t k = 0; ok && k < outcomes.size(); ++k) ok = impl.put(sweep, outcomes[k]);
    if (ok) ok = sql::run(impl.file.get(), impl.path, "COMMIT");
    if (!ok) {
        impl.finished = before;
        if (impl.file && !sqlite3_get_autocommit(impl.file.get())) (void)sql::run(impl.file.get(), impl.path, "ROLLBACK");
        return ok;
    }
    std::error_code none;
    const auto size = fs::file_size(impl.wal(), none);
    if (!none && static_cast<std::int64_t>(size) > impl.next_fold && !impl.fold(false)) impl.set_next_fold();  // tried again later
    return {};
}

void SweepResults::note(std::int64_t to_do) const {
    if (held_->lock) held_->lock->note(finished(), to_do);
}

const std::string& SweepResults::path() const { return held_->path; }
std::int64_t SweepResults::units() const { return held_->layout.units; }
std::int64_t SweepResults::finished() const { return held_->finished; }
const std::vector<SweepColumn>& SweepResults::axes() const { return held_->layout.axes; }
const std::vector<SweepColumn>& SweepResults::measures() const { return held_->layout.measures; }
const std::vector<std::string>& SweepResults::trains() const { return held_->layout.trains; }
const std::vector<std::string>& SweepResults::traces() const { return held_->layout.traces; }
const std::vector<double>& SweepResults::trace_times() const { return held_->layout.trace_times; }
const std::vector<std::string>& SweepResults::stored() const { return held_->layout.stored; }
sqlite3* SweepResults::handle() const { return held_->file.get(); }

std::string SweepResults::about(const std::string& key) const {
    const auto found = held_->layout.about.find(key);
    return found == held_->layout.about.end() ? "" : found->second;
}

Result<std::vector<std::pair<std::int64_t, std::int64_t>>> SweepResults::missing() const {
    auto rows = sql::Statement::make(handle(), path(), "SELECT unit FROM units ORDER BY unit");
    if (!rows) return rows.error();
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    std::int64_t from = 0;
    for (;;) {
        const auto more = rows->step();
        if (!more) return more.error();
        const auto to = *more ? rows->integer(0) : units();
        if (to > from) out.emplace_back(from, to);
        if (!*more) return out;
        from = to + 1;
    }
}

Result<std::int64_t> SweepResults::ended(UnitEnd end) const {
    return sql::integer(handle(), path(), fmt::format("SELECT count(*) FROM units WHERE ended = '{}'", word_of(end)));
}

Result<void> SweepResults::each(const std::function<bool(const Row&)>& on_row) const {
    std::string text = "SELECT unit, ended, steps, iterations, alone, why";
    for (const auto& column : stored()) text += ", " + sql::name(column);
    auto rows = sql::Statement::make(handle(), path(), text + " FROM units ORDER BY unit");
    if (!rows) return rows.error();
    Row row;
    row.axes.resize(axes().size()), row.measures.resize(measures().size());
    for (;;) {
        const auto more = rows->step();
        if (!more) return more.error();
        if (!*more) return {};
        row.unit = rows->integer(0), row.end = end_of(rows->text(1)), row.steps = rows->integer(2), row.iterations = rows->integer(3);
        row.alone = rows->integer(4) != 0, row.why = rows->text(5);
        int column = 6;
        for (auto* into : {&row.axes, &row.measures})
            for (double& x : *into) x = rows->number(column++);
        if (!on_row(row)) return {};
    }
}

Result<std::vector<double>> SweepResults::spikes(std::int64_t item, std::size_t train) const {
    return blob<double>(handle(), path(), "SELECT times FROM spikes WHERE unit = ? AND train = ?", item, train);
}

Result<std::vector<float>> SweepResults::trace(std::int64_t item, std::size_t trace) const {
    return blob<float>(handle(), path(), "SELECT samples FROM traces WHERE unit = ? AND trace = ?", item, trace);
}

}  // namespace corpuscle
