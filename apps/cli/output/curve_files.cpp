#include "cli/output/curve_files.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "cli/arguments/own_files.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t block = 1 << 16;                      // bytes of pending points that are written at once
constexpr auto max_delay = std::chrono::milliseconds(500);  // longest time between two writes of pending points

}  // namespace

using namespace circuit;

Result<void> CurveFiles::begin_variant(const Variant& variant) {
    title_ = variant.circuit->title, label_ = variant.label;
    plot_count_ = 0, file_ = nullptr;
    analysis_count_ = static_cast<std::size_t>(std::count_if(variant.circuit->directives.begin(), variant.circuit->directives.end(),
                                                             [](const Directive& c) { return find_analysis(c.name) != nullptr; }));
    if (!files_.empty()) return {};
    auto check = check_;
    const auto count = is_csv_ ? analysis_count_ : 1;
    for (std::size_t k = 0; k < count; ++k) TRY(check.check_growing_file(path_of(count, k), is_csv_ ? is_own_table : is_own_raw));
    return {};
}

Result<void> CurveFiles::add_plots(std::span<const Plot> plots) {
    has_complete_plots_ = true;
    if (is_csv_) {
        for (const auto& plot : plots) TRY(write_table(plot, plots.size()));
        return {};
    }
    const auto file = TRY(open(1, 0, {}));
    std::vector<Plot> named(plots.begin(), plots.end());
    for (auto& plot : named)
        if (!label_.empty()) plot.name += fmt::format(" ({})", label_);
    return file->write(raw_text(title_, named, !options_.ascii));
}

Result<void> CurveFiles::write_table(const Plot& plot, std::size_t count) {
    // The number of files matters only if it is 1, because the path then has no number.
    const auto file = TRY(open(analysis_count_ + count - 1, plot_count_++, (has_steps_ ? "step," : "") + csv_header(plot)));
    return file->write(csv_rows(plot, has_steps_ ? label_ + "," : ""));
}

Result<void> CurveFiles::begin(const Plot& head) {
    file_ = TRY(is_csv_ ? open(analysis_count_, plot_count_++, (has_steps_ ? "step," : "") + csv_header(head)) : open(1, 0, {}));
    rows_.clear(), point_count_ = 0, last_write_ = Clock::now();
    if (is_csv_) return {};
    Plot named = head;
    if (!label_.empty()) named.name += fmt::format(" ({})", label_);
    const auto text = raw_header(title_, named, !options_.ascii);
    count_offset_ = file_->size() + text.count_offset;
    return file_->write(text.text);
}

Result<void> CurveFiles::add_point(std::span<const double> row) {
    if (is_csv_ && has_steps_) rows_ += label_ + ",";
    is_csv_ ? append_csv_row(rows_, row) : append_raw_point(rows_, point_count_, row, !options_.ascii);
    ++point_count_, newest_time_ = row[0];
    has_streamed_ = has_streamed_ || point_count_ > 1;
    return rows_.size() >= block || Clock::now() - last_write_ > max_delay ? write_pending() : Result<void>();
}

/// Writes the points before their count, so that the count in the file never exceeds the points in it.
Result<void> CurveFiles::write_pending() {
    last_write_ = Clock::now();
    TRY(file_->write(rows_));
    rows_.clear(), written_time_ = newest_time_;
    return is_csv_ ? Result<void>() : file_->overwrite(count_offset_, raw_count(point_count_));
}

Result<void> CurveFiles::end() {
    if (auto ok = write_pending(); !ok || is_csv_) return ok;
    return file_->write(raw_footer(!options_.ascii));
}

Result<void> CurveFiles::finish() {
    for (auto& file : files_) TRY(file.commit());
    const bool is_any_synced = std::any_of(files_.begin(), files_.end(), [](const auto& f) { return f.is_synced(); });
    files_.clear();
    return is_any_synced ? sync_directory_of(options_.path) : Result<void>();
}

Result<std::string> CurveFiles::finish_early(bool interrupted) {
    if (!has_streamed_ && !(interrupted && has_complete_plots_))
        files_.clear();  // removes the unfinished files; files of earlier runs at these paths remain
    if (files_.empty()) return std::string();
    const bool in_transient = file_ != nullptr;
    const auto note = fmt::format("{} ends early{}{}", in_transient ? file_->path() : options_.path, label_.empty() ? "" : ", in " + label_,
                                  in_transient ? ", at " + format_quantity(written_time_, "s") : "");
    TRY(finish());
    return note;
}

std::string CurveFiles::path_of(std::size_t file_count, std::size_t index) const {
    auto path = options_.path;
    if (file_count > 1) path.insert(path.size() - std::string_view(".csv").size(), fmt::format("-{}", index + 1));
    return path;
}

/// Returns file `index`, from 0, of `file_count`. The first call creates it and writes `head`.
Result<OutputFile*> CurveFiles::open(std::size_t file_count, std::size_t index, const std::string& head) {
    if (index < files_.size()) return &files_[index];
    const auto path = path_of(file_count, index);
    TRY(check_.check_growing_file(path, is_csv_ ? is_own_table : is_own_raw));
    files_.push_back(TRY(OutputFile::create_growing(path)));
    TRY(files_.back().write(head));
    return &files_.back();
}

}  // namespace corpuscle
