#include "sweep/store/sweep_results.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "spikes and traces have the same byte order in the file and in memory");

constexpr std::array<std::string_view, 3> item_ends = {  // in the order of ItemEnd
    "done", "truncated", "diverged"};

/// The statement that inserts a row into the table items.
std::string insert_statement(const ResultsLayout& layout) {
    const std::vector<char> values(layout.item_columns.size() + layout.stored_column_names.size(), '?');
    return fmt::format("INSERT INTO items({}) VALUES({}) ON CONFLICT(item) DO NOTHING", layout.columns(), fmt::join(values, ", "));
}

/// The numbers in the blob that a query selects by item and index; empty if there is no row.
template <class T>
Result<std::vector<T>> read_blob(const sql::Database& file, const char* query, std::int64_t item, std::size_t index) {
    auto row = TRY(file.prepare(query));
    if (!TRY(row.set(1, item).set(2, static_cast<std::int64_t>(index)).step())) return std::vector<T>{};
    return row.numbers<T>(0);
}

/// Creates the folder of a file.
Result<void> make_folder(const std::string& path) {
    const auto folder = fs::path(path).parent_path();
    std::error_code failed;
    if (!folder.empty()) fs::create_directories(folder, failed);
    if (failed) return bad_input(fmt::format("its folder cannot be created ({}); give another path with --out", failed.message()), {path});
    return {};
}

/// A path as part of a URI of SQLite, which gives these characters a meaning.
std::string uri_path(std::string_view path) {
    std::string out;
    for (const char c : path) out += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", static_cast<int>(c)) : std::string(1, c);
    return out;
}

Error needs_writable_folder(const std::string& path) {
    return bad_input(
        "was left by a run that was killed, and can be read only in a writable folder: copy it, together with "
        "its -wal file, to such a folder",
        {path});
}

}  // namespace

std::string_view end_name(ItemEnd end) { return item_ends[static_cast<std::size_t>(end)]; }

ItemEnd end_of_name(std::string_view name) {
    const auto* at = std::find(item_ends.begin(), item_ends.end(), name);
    return at == item_ends.end() ? ItemEnd::diverged : static_cast<ItemEnd>(at - item_ends.begin());
}

Result<void> SweepResults::read_layout() {
    static_cast<ResultsLayout&>(*this) = TRY(ResultsLayout::read(file_));
    return {};
}

Result<void> SweepResults::count_rows() {
    finished_ = TRY(file_.query_integer("SELECT count(*) FROM items"));
    return {};
}

Result<void> SweepResults::begin_writing() {
    if (is_writing_) return {};
    if (!lock_) return bad_input("was opened for reading only", {path()});
    TRY(file_.run("PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0; PRAGMA synchronous = FULL; PRAGMA cache_size = -32768"));
    insert_item_ = TRY(file_.prepare(insert_statement(*this)));
    insert_spikes_ = TRY(file_.prepare("INSERT INTO spikes(item, train, times) VALUES(?, ?, ?)"));
    insert_probe_ = TRY(file_.prepare("INSERT INTO traces(item, trace, samples) VALUES(?, ?, ?)"));
    set_next_checkpoint_size();
    is_writing_ = true;
    return {};
}

Result<void> SweepResults::insert(const Sweep& sweep, const ItemOutcome& o) {
    const auto values = sweep.values(o.item);
    if (o.item < 0 || o.item >= item_count || (!o.measures.empty() && o.measures.size() != measures.size()) || values.size() != axes.size())
        return bad_input(fmt::format("item {} with {} axes and {} measures does not fit this file of {} items with {} axes and {} measures",
                                     o.item, values.size(), o.measures.size(), item_count, axes.size(), measures.size()),
                         {path()});
    insert_item_.set(1, o.item).set(2, end_name(o.end)).set(3, o.steps).set(4, o.iterations).set(5, std::int64_t{o.ran_alone});
    insert_item_.set(6, std::string_view(o.reason));
    int position = 7;
    for (const double x : values) insert_item_.set(position++, x);
    for (std::size_t k = 0; k < measures.size(); ++k, ++position)
        k < o.measures.size() ? insert_item_.set(position, o.measures[k]) : insert_item_.set_null(position);
    TRY(insert_item_.finish());
    if (sqlite3_changes(file_.file.get()) == 0) return {};  // the item has a row already
    ++finished_;
    for (std::size_t k = 0; k < o.spikes.size(); ++k)
        if (!o.spikes[k].empty())
            TRY(insert_spikes_.set(1, o.item).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.spikes[k]))).finish());
    for (std::size_t k = 0; k < o.probes.size(); ++k)
        TRY(insert_probe_.set(1, o.item).set(2, static_cast<std::int64_t>(k)).set(3, std::as_bytes(std::span(o.probes[k]))).finish());
    return {};
}

Result<SweepResults> SweepResults::open(const std::string& path, const SweepDescription& sweep) {
    TRY(make_folder(path));
    SweepResults out(path);
    out.lock_ = TRY(WriterLock::take(path));
    out.remove_new_file();
    if (std::error_code status; !fs::exists(path, status)) {
        static_cast<ResultsLayout&>(out) = ResultsLayout::of(sweep);  // create_file() writes it
        TRY(out.create_file());
    }
    out.file_ = TRY(sql::open(path, SQLITE_OPEN_READWRITE));
    TRY(out.read_layout());
    TRY(out.check_current_format(path));
    if (const auto found = difference(sweep, out); !found.empty())
        return bad_input(fmt::format("holds results of another sweep: {}. Give another file with --out, undo the change, or "
                                     "remove this file",
                                     found),
                         {path});
    TRY(out.count_rows());
    return out;
}

Result<SweepResults> SweepResults::open_read_only(const std::string& path) {
    std::error_code status;
    if (!fs::exists(path, status)) return bad_input("does not exist; 'corpuscle sweep FILE --out RESULTS' creates it", {path});
    SweepResults out(path);
    out.file_ = TRY(sql::open(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX));
    auto ok = out.read_layout();
    if (!ok && (sqlite3_errcode(out.file_.file.get()) & 0xff) == SQLITE_CANTOPEN) {
        // SQLite needs a -shm file beside the results, which cannot be created in a read-only folder. Without rows in the -wal, the file
        // can be opened as immutable instead.
        if (fs::exists(out.wal_path(), status) && fs::file_size(out.wal_path(), status) > 0) return needs_writable_folder(path);
        const auto uri = "file:" + uri_path(fs::absolute(path).string()) + "?immutable=1";
        out.file_ = TRY(sql::open(uri, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX));
        out.file_.path = path;
        ok = out.read_layout();
    }
    TRY(std::move(ok));
    TRY(out.file_.run("PRAGMA query_only = 1"));
    TRY(out.count_rows());
    return out;
}

Result<void> SweepResults::add(const Sweep& sweep, std::vector<ItemOutcome>&& outcomes) {
    if (outcomes.empty()) return {};
    std::sort(outcomes.begin(), outcomes.end(), [](const ItemOutcome& a, const ItemOutcome& b) { return a.item < b.item; });
    const auto before = finished_;
    auto ok = begin_writing();
    if (ok) ok = file_.run("BEGIN IMMEDIATE");
    for (std::size_t k = 0; ok && k < outcomes.size(); ++k) ok = insert(sweep, outcomes[k]);
    if (ok) ok = file_.run("COMMIT");
    if (!ok) {
        finished_ = before;
        if (file_.file && !sqlite3_get_autocommit(file_.file.get())) (void)file_.run("ROLLBACK");
        return ok;
    }
    std::error_code status;
    const auto size = fs::file_size(wal_path(), status);
    if (!status && static_cast<std::int64_t>(size) > next_checkpoint_size_ && !checkpoint())
        set_next_checkpoint_size();  // if it failed, it is tried again when the -wal has grown
    return {};
}

void SweepResults::announce_run(std::int64_t planned_items) const {
    if (lock_) lock_->write_progress(finished_, planned_items);
}

std::string SweepResults::about(std::string_view name) const {
    const auto* text = find_metadata(name);
    return text ? *text : "";
}

Result<std::vector<std::pair<std::int64_t, std::int64_t>>> SweepResults::missing_ranges() const {
    auto rows = TRY(file_.prepare("SELECT item FROM items ORDER BY item"));
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    std::int64_t from = 0;
    for (;;) {
        const auto more = TRY(rows.step());
        const auto to = more ? rows.integer(0) : item_count;
        if (to > from) out.emplace_back(from, to);
        if (!more) return out;
        from = to + 1;
    }
}

Result<void> SweepResults::for_each_row(const std::function<bool(const std::vector<double>&, const ItemOutcome&)>& on_row) const {
    auto rows = TRY(file_.prepare("SELECT " + columns() + " FROM items ORDER BY item"));
    std::vector<double> axis_values(axes.size());
    ItemOutcome row;
    row.measures.resize(measures.size());
    while (TRY(rows.step())) {
        row.item = rows.integer(0), row.end = end_of_name(rows.text(1)), row.steps = rows.integer(2), row.iterations = rows.integer(3);
        row.ran_alone = rows.integer(4) != 0, row.reason = rows.text(5);
        int column = item_columns.size();
        for (auto* into : {&axis_values, &row.measures})
            for (double& x : *into) x = rows.number(column++);
        if (!on_row(axis_values, row)) return {};
    }
    return {};
}

Result<std::vector<double>> SweepResults::spikes(std::int64_t item, std::size_t train) const {
    return read_blob<double>(file_, "SELECT times FROM spikes WHERE item = ? AND train = ?", item, train);
}

Result<std::vector<float>> SweepResults::probe_samples(std::int64_t item, std::size_t probe) const {
    return read_blob<float>(file_, "SELECT samples FROM traces WHERE item = ? AND trace = ?", item, probe);
}

}  // namespace corpuscle
