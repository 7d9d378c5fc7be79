#include "study/bins_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace corpuscle {

BinsFile::BinsFile(OutputFile file, double bin) : file_(std::move(file)), bin_(bin) {
    (void)file_.write("afferent,channel,from_s,to_s,spikes,rate_Hz\n");
}

std::int64_t BinsFile::bin_of(double t) const { return static_cast<std::int64_t>(std::floor(t / bin_ + 1e-9)); }

/// The bin that fills is done, and ends at `to` (s since the start).
void BinsFile::put(double to) {
    const double from = static_cast<double>(at_) * bin_;
    for (std::size_t u = 0; u < now_.size(); ++u)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f},{:.9f},{},{:.6g}\n", names_[u], t0_ + from, t0_ + to, now_[u],
                       static_cast<double>(now_[u]) / (to - from));
    now_.assign(now_.size(), 0);
    ++at_;
}

void BinsFile::fill_up_to(std::int64_t bin) {
    while (at_ < bin) put(static_cast<double>(at_ + 1) * bin_);
}

Result<void> BinsFile::begin(const Input& input) {
    names_ = unit_names(input);
    now_.assign(input.units(), 0);
    since_start_ = input.source.clock();
    t0_ = std::exchange(since_start_.t0, 0.0);
    at_ = 0;
    return {};
}

Result<void> BinsFile::block(const Input& input, const Answered& answered) {
    text_.clear();
    for (const auto& s : answered.spikes) {
        fill_up_to(bin_of(since_start_.time(s.step, s.offset)));
        ++now_[s.unit - input.first_unit];
    }
    // What comes later is behind this block's last sample.
    fill_up_to(bin_of(since_start_.time(answered.first + static_cast<std::int64_t>(answered.force.count) - 1)));
    return file_.write({text_.data(), text_.size()});
}

Result<void> BinsFile::end(const Input&, std::int64_t samples) {
    text_.clear();
    const double end = since_start_.time(samples);
    fill_up_to(std::max<std::int64_t>(static_cast<std::int64_t>(std::ceil(end / bin_ - 1e-9)) - 1, 0));
    put(end);
    return file_.write({text_.data(), text_.size()});
}

}  // namespace corpuscle
