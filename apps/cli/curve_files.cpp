#include "curve_files.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "own_files.hpp"
#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t block = 1 << 16;                      // bytes
constexpr auto max_delay = std::chrono::milliseconds(500);  // before a pending point is written

}  // namespace

using namespace circuit;

void CurveFiles::next(const Variant& variant) {
    title_ = variant.circuit->title, label_ = variant.label;
    plots_ = 0, file_ = nullptr;
    analyses_ = static_cast<std::size_t>(std::count_if(variant.circuit->directives.begin(), variant.circuit->directives.end(),
                                                       [](const Directive& c) { return find_analysis(c.name) != nullptr; }));
}

Result<void> CurveFiles::add_plots(std::span<const Plot> plots) {
    has_whole_ = true;
    if (csv_) {
        for (const auto& plot : plots)
            if (auto ok = table(plot, plots.size()); !ok) return ok;
        return {};
    }
    const auto file = open(1, 0, {});
    if (!file) return file.error();
    std::vector<Plot> named(plots.begin(), plots.end());
    for (auto& plot : named)
        if (!label_.empty()) plot.name += fmt::format(" ({})", label_);
    return (*file)->write(raw_text(title_, named, !words_.ascii));
}

Result<void> CurveFiles::table(const Plot& plot, std::size_t count) {
    const auto file = open(analyses_ + count - 1, plots_++, (several_ ? "step," : "") + csv_header(plot));
    if (!file) return file.error();
    return (*file)->write(csv_rows(plot, several_ ? label_ + "," : ""));
}

Result<void> CurveFiles::begin(const Plot& head) {
    const auto file = csv_ ? open(analyses_, plots_++, (several_ ? "step," : "") + csv_header(head)) : open(1, 0, {});
    if (!file) return file.error();
    file_ = *file;
    rows_.clear(), points_ = 0, written_ = Clock::now();
    if (csv_) return {};
    Plot named = head;
    if (!label_.empty()) named.name += fmt::format(" ({})", label_);
    const auto text = raw_header(title_, named, !words_.ascii);
    count_at_ = file_->size() + text.count_offset;
    return file_->write(text.text);
}

Result<void> CurveFiles::add_point(std::span<const double> row) {
    if (csv_ && several_) rows_ += label_ + ",";
    csv_ ? append_csv_row(rows_, row) : append_raw_point(rows_, points_, row, !words_.ascii);
    ++points_, time_ = row[0];
    streamed_ = streamed_ || points_ > 1;
    return rows_.size() >= block || Clock::now() - written_ > max_delay ? write_out() : Result<void>();
}

/// Writes the points before their count, so that the count in the file never exceeds the points in it.
Result<void> CurveFiles::write_out() {
    written_ = Clock::now();
    if (auto ok = file_->write(rows_); !ok) return ok;
    rows_.clear(), written_to_ = time_;
    return csv_ ? Result<void>() : file_->overwrite(count_at_, raw_count(points_));
}

Result<void> CurveFiles::end() {
    if (auto ok = write_out(); !ok || csv_) return ok;
    return file_->write(raw_footer(!words_.ascii));
}

Result<void> CurveFiles::finish() {
    for (auto& file : files_)
        if (auto ok = file.commit(); !ok) return ok;
    const bool synced = std::any_of(files_.begin(), files_.end(), [](const auto& f) { return f.is_synced(); });
    files_.clear();
    return synced ? sync_directory_of(words_.out) : Result<void>();
}

Result<std::string> CurveFiles::finish_early(bool interrupted) {
    if (!streamed_ && !(interrupted && has_whole_)) files_.clear();  // keeps the earlier files at these paths
    if (files_.empty()) return std::string();
    const bool in_transient = file_ != nullptr;
    const auto note = fmt::format("{} ends early{}{}", in_transient ? file_->path() : words_.out, label_.empty() ? "" : ", in " + label_,
                                  in_transient ? ", at " + format_quantity(written_to_, "s") : "");
    if (auto ok = finish(); !ok) return ok.error();
    return note;
}

std::string CurveFiles::path_of(std::size_t count, std::size_t k) const {
    auto path = words_.out;
    if (count > 1) path.insert(path.size() - 4, fmt::format("-{}", k + 1));
    return path;
}

Result<void> CurveFiles::check(std::size_t analysis_count) const {
    auto check = check_;
    if (words_.out.empty()) return {};
    const auto count = csv_ ? analysis_count : 1;
    for (std::size_t k = 0; k < count; ++k)
        if (auto ok = check.check_growing_file(path_of(count, k), csv_ ? is_own_table : is_own_raw); !ok) return ok;
    return {};
}

/// File k of `count`. The first use creates it with `head` as its content.
Result<OutputFile*> CurveFiles::open(std::size_t count, std::size_t k, const std::string& head) {
    if (k < files_.size()) return &files_[k];
    const auto path = path_of(count, k);
    if (auto ok = check_.check_growing_file(path, csv_ ? is_own_table : is_own_raw); !ok) return ok.error();
    auto file = OutputFile::create_growing(path);
    if (!file) return file.error();
    files_.push_back(std::move(*file));
    if (auto ok = files_.back().write(head); !ok) return ok.error();
    return &files_.back();
}

}  // namespace corpuscle
