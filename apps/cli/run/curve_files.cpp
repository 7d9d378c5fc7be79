#include "cli/run/curve_files.hpp"

#include <algorithm>

#include "circuit/analyses.hpp"
#include "cli/output/output_files.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t block = 1 << 16;                      // bytes of pending points that are written at once
constexpr auto max_delay = std::chrono::milliseconds(500);  // longest time between two writes of pending points

}  // namespace

using namespace circuit;

Result<void> CurveFiles::begin_variant(const Variant& variant) {
    title_ = variant.circuit->title, label_ = variant.label;
    plot_count_ = 0, file_ = transient_file_ = nullptr;
    expected_count_ = 0;
    for (const auto& c : variant.circuit->directives)
        if (const auto* analysis = find_analysis(c.name)) expected_count_ += analysis->plot_count;
    if (!files_.empty()) return {};
    auto check = check_;
    const auto count = is_csv_ ? expected_count_ : 1;
    for (std::size_t k = 0; k < count; ++k) TRY(check.check_growing_file(path_of(count, k), is_csv_ ? is_own_table : is_own_raw));
    return {};
}

Result<void> CurveFiles::begin(const Plot& head) {
    file_ = TRY(is_csv_ ? open(expected_count_, plot_count_++, (has_steps_ ? "step," : "") + csv_header(head)) : open(1, 0, {}));
    head_ = head, rows_.clear(), point_count_ = 0, last_write_ = Clock::now();
    if (is_transient()) transient_file_ = file_;
    if (is_csv_) return {};
    if (!label_.empty()) head_.name += fmt::format(" ({})", label_);
    const auto text = raw_header(title_, head_, !is_ascii_);
    count_offset_ = file_->size() + text.count_offset;
    return file_->write(text.text);
}

Result<void> CurveFiles::add_point(const PlotRow& row) {
    if (is_csv_ && has_steps_) rows_ += label_ + ",";
    is_csv_ ? append_csv_row(rows_, head_, row) : append_raw_point(rows_, point_count_, row, !is_ascii_);
    ++point_count_;
    if (is_transient()) newest_time_ = row.real[0], has_streamed_ = has_streamed_ || point_count_ > 1;
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
    has_complete_plots_ = has_complete_plots_ || !is_transient();
    if (auto ok = write_pending(); !ok || is_csv_) return ok;
    return file_->write(raw_footer(!is_ascii_));
}

Result<void> CurveFiles::finish() {
    for (auto& file : files_) TRY(file.commit());
    const bool is_any_synced = std::any_of(files_.begin(), files_.end(), [](const auto& f) { return f.is_synced(); });
    files_.clear();
    return is_any_synced ? sync_directory_of(path_) : Result<void>();
}

Result<std::string> CurveFiles::finish_early(bool interrupted) {
    if (!has_streamed_ && !(interrupted && has_complete_plots_))
        files_.clear();  // removes the unfinished files; files of earlier runs at these paths remain
    if (files_.empty()) return std::string();
    const bool in_transient = transient_file_ != nullptr;
    const auto note =
        fmt::format("{} ends early{}{}", in_transient ? transient_file_->path() : path_, label_.empty() ? "" : ", in " + label_,
                    in_transient ? ", at " + format_quantity(written_time_, "s") : "");
    TRY(finish());
    return note;
}

std::string CurveFiles::path_of(std::size_t file_count, std::size_t index) const {
    auto path = path_;
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
