#include "corpuscle/sweep.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/result.hpp"
#include "core/text/printable.hpp"
#include "sweep/parallel/shard_text.hpp"
#include "sweep/stats/progress_status.hpp"
#include "sweep/stats/sweep_tables.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

constexpr double write_interval = 0.05;  // s; the sweep notices a stop after each write
constexpr std::size_t max_failures = 1000;

std::vector<SweepQuantity> quantities_of(const std::vector<SweepColumn>& columns) {
    std::vector<SweepQuantity> out;
    for (const auto& c : columns) out.push_back({c.name, c.unit, c.description, c.labels, c.min, c.max});
    return out;
}

SweepRunOptions run_options_of(const SweepSettings& settings, const Shard& shard, bool& is_stopped) {
    SweepRunOptions out{.threads = settings.threads, .shard = shard, .write_interval = write_interval};
    out.should_stop = [&is_stopped] { return is_stopped; };
    out.on_progress = [&](const SweepProgress& p) {
        const double all = static_cast<double>(std::max<std::int64_t>(1, p.planned));
        if (settings.progress && !settings.progress(static_cast<double>(p.finished()) / all)) is_stopped = true;
    };
    return out;
}

/// Runs the missing items of a sweep. Returns the path of the results.
std::string run_missing(const Sweep& sweep, const std::string& file, const SweepSettings& settings) {
    const auto shard = value_or_throw(parse_shard(settings.shard));
    auto results = value_or_throw(SweepResults::open(results_path(file, settings.results, shard), sweep));
    bool is_stopped = false;
    SweepProgress counts;
    const auto done = run_sweep(sweep, results, run_options_of(settings, shard, is_stopped), counts);
    const auto checkpointed = results.checkpoint();
    if (!done && done.error().code == ErrorCode::interrupted)
        throw InterruptedError(fmt::format("interrupted; {} of {} items have ended and are saved in {}; the same call resumes the sweep",
                                           results.finished_count(), results.item_count, results.path()));
    value_or_throw(done);
    value_or_throw(checkpointed);
    value_or_throw(check_any_converged(value_or_throw(read_sweep_status(results, shard))));
    return results.path();
}

}  // namespace

struct SweepRecords::Impl {
    std::string path, title;
    SweepTable table;
    std::optional<MismatchSamples> samples;
    std::vector<std::pair<std::int64_t, std::string>> failures;

    SweepSummary summary() const { return value_or_throw(summary_of(table, samples, {})); }
};

SweepRecords::SweepRecords(const std::string& path) {
    const auto results = value_or_throw(SweepResults::open_read_only(path));
    Impl impl{path, title_of(results), value_or_throw(read_table(results, {})), value_or_throw(read_mismatch_samples(results)), {}};
    for (auto& f : value_or_throw(failed_items(results, max_failures))) impl.failures.emplace_back(f.item, std::move(f.reason));
    impl_ = std::make_shared<const Impl>(std::move(impl));
}

const std::string& SweepRecords::results() const { return impl_->path; }
const std::string& SweepRecords::title() const { return impl_->title; }
std::int64_t SweepRecords::item_count() const { return impl_->table.item_count; }
const std::vector<std::int64_t>& SweepRecords::items() const { return impl_->table.items; }
std::vector<std::pair<std::int64_t, std::string>> SweepRecords::failures() const { return impl_->failures; }
std::vector<SweepQuantity> SweepRecords::axes() const { return quantities_of(impl_->table.axes); }
std::vector<SweepQuantity> SweepRecords::measures() const { return quantities_of(impl_->table.measures); }

std::vector<std::string> SweepRecords::ends() const {
    std::vector<std::string> out;
    for (const auto end : impl_->table.ends) out.emplace_back(end_name(end));
    return out;
}

const std::vector<double>& SweepRecords::axis_values(std::size_t axis) const {
    const auto& all = impl_->table.axis_values;
    if (axis >= all.size()) throw InputError(fmt::format("there is no axis {}; the sweep has {}", axis, all.size()));
    return all[axis];
}

const std::vector<double>& SweepRecords::measure_values(std::size_t measure) const {
    const auto& all = impl_->table.measure_values;
    if (measure >= all.size()) throw InputError(fmt::format("there is no measure {}; the sweep has {}", measure, all.size()));
    return all[measure];
}

std::string SweepRecords::text() const { return sweep_tables(impl_->table, impl_->summary(), impl_->title, false); }
std::string SweepRecords::summary() const { return json_text(document_of(impl_->table, impl_->summary(), impl_->title)); }

SweepRecords sweep(const std::string& path, const SweepSettings& settings) {
    const auto read = value_or_throw(read_sweep(path, {settings.seed, settings.samples}));
    return SweepRecords(run_missing(*read, path, settings));
}

SweepRecords sweep_text(const std::string& text, const SweepSettings& settings, const std::string& name) {
    const auto read = value_or_throw(read_sweep_text(text, name, {settings.seed, settings.samples}));
    return SweepRecords(run_missing(*read, name, settings));
}

}  // namespace corpuscle
