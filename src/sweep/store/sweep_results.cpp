#include "sweep/store/sweep_results.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>

#include "sweep/store/results_impl.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "spikes and traces have the same byte order in the file and in memory");

constexpr std::array<std::string_view, 3> item_ends = {  // in the order of ItemEnd
    "done", "truncated", "diverged"};

ItemEnd end_of(std::string_view name) {
    const auto* at = std::find(item_ends.begin(), item_ends.end(), name);
    return at == item_ends.end() ? ItemEnd::diverged : static_cast<ItemEnd>(at - item_ends.begin());
}

/// The statement that inserts a row into the table items.
std::string insert_statement(const ResultsLayout& layout) {
    const std::vector<char> values(layout.item_columns.size() + layout.stored_column_names.size(), '?');
    return fmt::format("INSERT INTO items({}) VALUES({}) ON CONFLICT(item) DO NOTHING", layout.columns(), fmt::join(values, ", "));
}

/// The numbers of a blob; an incomplete last number is ignored.
template <class T>
std::vector<T> numbers(std::span<const std::byte> bytes) {
    std::vector<T> out(bytes.size() / sizeof(T));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
}

/// The numbers in the blob that a query selects by item and index; empty if there is no row.
template <class T>
Result<std::vector<T>> read_blob(sqlite3* file, const std::string& path, const char* query, std::int64_t item, std::size_t index) {
    auto row = TRY(sql::Statement::make(file, path, query));
    if (!TRY(row.set(1, item).set(2, static_cast<std::int64_t>(index)).step())) return std::vector<T>{};
    return numbers<T>(row.bytes(0));
}

/// Creates the folder of a file.
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

std::string_view end_name(ItemEnd end) { return item_ends[static_cast<std::size_t>(end)]; }

Result<void> SweepResults::Impl::open_file(int flags) {
    file = TRY(sql::open(path, flags));
    return {};
}

Result<void> SweepResults::Impl::begin_writing() {
    if (is_writing) return {};
    if (!lock) return bad_input("was opened for reading only", {path});
    TRY(sql::run(file.get(), path,
                 "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0; PRAGMA synchronous = FULL; PRAGMA cache_size = -32768"));
    insert_item = TRY(sql::Statement::make(file.get(), path, insert_statement(layout)));
    insert_spikes = TRY(sql::Statement::make(file.get(), path, "INSERT INTO spikes(item, train, times) VALUES(?, ?, ?)"));
    insert_probe = TRY(sql::Statement::make(file.get(), path, "INSERT INTO traces(item, trace, samples) VALUES(?, ?, ?)"));
    set_next_checkpoint_size();
    is_writing = true;
    return {};
}

Result<void> SweepResults::Impl::insert(const Sweep& sweep, const ItemOutcome& o) {
    const auto values = sweep.values(o.item);
    if (o.item < 0 || o.item >= layout.item_count || (!o.measures.empty() && o.measures.size() != layout.measures.size()) ||
        values.size() != layout.axes.size())
        return bad_input(
            fmt::format("item {} with {} axes and {} measures does not fit this file of {} items with {} axes and {} measures", o.item,
                        values.size(), o.measures.size(), layout.item_count, layout.axes.size(), layout.measures.size()),
            {path});
    insert_item.set(1, o.item).set(2, end_name(o.end)).set(3, o.steps).set(4, o.iterations).set(5, std::int64_t{o.ran_alone});
    insert_item.set(6, std::string_view(o.reason));
    int position = 7;
    for (const double x : values) insert_item.set(position++, x);
    for (std::size_t k = 0; k < layout.measures.size(); ++k, ++position)
        k < o.measures.size() ? insert_item.set(position, o.measures[k]) : insert_item.set_null(position);
    TRY(insert_item.finish());
    if (sqlite3_changes(file.get()) == 0) return {};  // the item has a row already
    ++finished;
    for (std::size_t k = 0; k < o.spikes.size(); ++k)
        if (!o.spikes[k].empty())
            TRY(insert_spikes.set(1, o.item).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.spikes[k]))).finish());
    for (std::size_t k = 0; k < o.probes.size(); ++k)
        TRY(insert_probe.set(1, o.item).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.probes[k]))).finish());
    return {};
}

Result<SweepResults> SweepResults::open(const std::string& path, const Sweep& sweep) {
    return open_with_layout(path, ResultsLayout::of(sweep));
}

Result<SweepResults> SweepResults::open(const std::string& path, const SweepResults& other) {
    return open_with_layout(path, other.impl_->layout);
}

Result<SweepResults> SweepResults::open_with_layout(const std::string& path, const ResultsLayout& expected) {
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    TRY(make_folder(path));
    impl->lock = TRY(WriterLock::take(path));
    impl->remove_new_file();
    if (std::error_code status; !fs::exists(path, status)) {
        impl->layout = expected;  // create_file() writes it
        TRY(impl->create_file());
    }
    TRY(impl->open_file(SQLITE_OPEN_READWRITE));
    impl->layout = TRY(ResultsLayout::read(impl->file.get(), path));
    if (!impl->layout.is_current_format()) return impl->layout.read_only_format(path);
    if (const auto difference = expected.difference_from(impl->layout); !difference.empty())
        return bad_input(fmt::format("holds results of another sweep: {}. Give another file with --out, undo the change, or "
                                     "remove this file",
                                     difference),
                         {path});
    impl->finished = TRY(sql::query_integer(impl->file.get(), path, "SELECT count(*) FROM items"));
    return SweepResults(std::move(impl));
}

Result<SweepResults> SweepResults::open_read_only(const std::string& path) {
    std::error_code status;
    if (!fs::exists(path, status)) return bad_input("does not exist; 'corpuscle sweep FILE --out RESULTS' creates it", {path});
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    TRY(impl->open_file(SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX));
    auto stored = ResultsLayout::read(impl->file.get(), path);
    if (!stored && (sqlite3_errcode(impl->file.get()) & 0xff) == SQLITE_CANTOPEN) {
        // SQLite needs a -shm file beside the results, which cannot be created in a read-only folder. Without rows in the -wal, the file
        // can be opened as immutable instead.
        if (fs::exists(impl->wal_path(), status) && fs::file_size(impl->wal_path(), status) > 0) return needs_writable_folder(path);
        impl->file = TRY(sql::open("file:" + fs::absolute(path).string() + "?immutable=1",
                                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX));
        stored = ResultsLayout::read(impl->file.get(), path);
    }
    if (!stored) return stored.error();
    impl->layout = std::move(*stored);
    TRY(sql::run(impl->file.get(), path, "PRAGMA query_only = 1"));
    impl->finished = TRY(sql::query_integer(impl->file.get(), path, "SELECT count(*) FROM items"));
    return SweepResults(std::move(impl));
}

SweepResults::SweepResults(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SweepResults::SweepResults(SweepResults&&) noexcept = default;
SweepResults& SweepResults::operator=(SweepResults&&) noexcept = default;
SweepResults::~SweepResults() = default;

Result<void> SweepResults::add(const Sweep& sweep, std::vector<ItemOutcome>&& outcomes) {
    if (outcomes.empty()) return {};
    std::sort(outcomes.begin(), outcomes.end(), [](const ItemOutcome& a, const ItemOutcome& b) { return a.item < b.item; });
    auto& impl = *impl_;
    const auto before = impl.finished;
    auto ok = impl.begin_writing();
    if (ok) ok = sql::run(impl.file.get(), impl.path, "BEGIN IMMEDIATE");
    for (std::size_t k = 0; ok && k < outcomes.size(); ++k) ok = impl.insert(sweep, outcomes[k]);
    if (ok) ok = sql::run(impl.file.get(), impl.path, "COMMIT");
    if (!ok) {
        impl.finished = before;
        if (impl.file && !sqlite3_get_autocommit(impl.file.get())) (void)sql::run(impl.file.get(), impl.path, "ROLLBACK");
        return ok;
    }
    std::error_code status;
    const auto size = fs::file_size(impl.wal_path(), status);
    if (!status && static_cast<std::int64_t>(size) > impl.next_checkpoint_size && !impl.checkpoint())
        impl.set_next_checkpoint_size();  // if it failed, it is tried again when the -wal has grown
    return {};
}

void SweepResults::announce_run(std::int64_t planned_items) const {
    if (impl_->lock) impl_->lock->write_progress(finished_count(), planned_items);
}

const std::string& SweepResults::path() const { return impl_->path; }
std::int64_t SweepResults::item_count() const { return impl_->layout.item_count; }
std::int64_t SweepResults::finished_count() const { return impl_->finished; }
const std::vector<SweepColumn>& SweepResults::axes() const { return impl_->layout.axes; }
const std::vector<SweepColumn>& SweepResults::measures() const { return impl_->layout.measures; }
const std::vector<std::string>& SweepResults::train_names() const { return impl_->layout.train_names; }
const std::vector<std::string>& SweepResults::probe_names() const { return impl_->layout.probe_names; }
const std::vector<double>& SweepResults::probe_times() const { return impl_->layout.probe_times; }
const std::vector<std::string>& SweepResults::stored_column_names() const { return impl_->layout.stored_column_names; }
sqlite3* SweepResults::handle() const { return impl_->file.get(); }

std::string SweepResults::about(const std::string& key) const {
    const auto found = impl_->layout.about.find(key);
    return found == impl_->layout.about.end() ? "" : found->second;
}

Result<std::vector<std::pair<std::int64_t, std::int64_t>>> SweepResults::missing_ranges() const {
    auto rows = TRY(sql::Statement::make(handle(), path(), "SELECT item FROM items ORDER BY item"));
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    std::int64_t from = 0;
    for (;;) {
        const auto more = TRY(rows.step());
        const auto to = more ? rows.integer(0) : item_count();
        if (to > from) out.emplace_back(from, to);
        if (!more) return out;
        from = to + 1;
    }
}

Result<std::int64_t> SweepResults::count_ended(ItemEnd end) const {
    return sql::query_integer(handle(), path(), fmt::format("SELECT count(*) FROM items WHERE ended = '{}'", end_name(end)));
}

Result<void> SweepResults::for_each_row(const std::function<bool(const Row&)>& on_row) const {
    auto rows = TRY(sql::Statement::make(handle(), path(), "SELECT " + impl_->layout.columns() + " FROM items ORDER BY item"));
    Row row;
    row.axes.resize(axes().size()), row.measures.resize(measures().size());
    while (TRY(rows.step())) {
        row.item = rows.integer(0), row.end = end_of(rows.text(1)), row.steps = rows.integer(2), row.iterations = rows.integer(3);
        row.ran_alone = rows.integer(4) != 0, row.reason = rows.text(5);
        int column = ResultsLayout::item_columns.size();
        for (auto* into : {&row.axes, &row.measures})
            for (double& x : *into) x = rows.number(column++);
        if (!on_row(row)) return {};
    }
    return {};
}

Result<std::vector<double>> SweepResults::spikes(std::int64_t item, std::size_t train) const {
    return read_blob<double>(handle(), path(), "SELECT times FROM spikes WHERE item = ? AND train = ?", item, train);
}

Result<std::vector<float>> SweepResults::probe_samples(std::int64_t item, std::size_t probe) const {
    return read_blob<float>(handle(), path(), "SELECT samples FROM traces WHERE item = ? AND trace = ?", item, probe);
}

}  // namespace corpuscle
