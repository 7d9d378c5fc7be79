#include "circuit/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::circuit {
namespace {

constexpr double sharp = 2e-3;      // of the largest force: a bend worth a corner ...
constexpr double sharper = 4;       // ... if it is so many times that of the calmer side
constexpr double far_off = 0.05;    // of the largest force: from the line of the last corner
constexpr std::size_t numbers = 7;  // before corners and samples, in save()

/// A number of samples that can be counted; a damaged state may ask for others.
double in_reach(double samples) { return samples >= -0x1p53 && samples <= 0x1p53 ? samples : samples > 0 ? 0x1p53 : -0x1p53; }

}  // namespace

double Trace::sample(std::int64_t k) const {
    if (samples_.empty()) return 0;
    return samples_[static_cast<std::size_t>(std::clamp<std::int64_t>(k - first_, 0, static_cast<std::int64_t>(samples_.size()) - 1))];
}

void Trace::append(std::span<const double> force) {
    samples_.insert(samples_.end(), force.begin(), force.end());
    while (looked_ + lag < first_ + static_cast<std::int64_t>(samples_.size())) look();
}

/// Whether the next sample is a corner.
void Trace::look() {
    const std::int64_t k = looked_++;
    const auto begin_line = [&](std::int64_t from) {
        line_from_ = static_cast<double>(from), line_at_ = sample(from), line_slope_ = sample(from + 1) - sample(from);
    };
    largest_ = std::max({largest_, std::abs(sample(k - 1)), std::abs(sample(k)), std::abs(sample(k + lag))});
    if (k == 1) begin_line(0);
    const double calm = std::min(std::abs(bend(k - 2)), std::abs(bend(k + 2)));
    const bool bends = std::abs(bend(k)) > std::max(sharp * largest_, sharper * calm);
    const double line = line_at_ + line_slope_ * (static_cast<double>(k) - line_from_);
    if (!bends && std::abs(sample(k) - line) <= far_off * largest_) return;
    corners_.push_back(k);
    begin_line(k);
}

double Trace::at(double t) const {
    const double place = in_reach(t / T_), before = std::floor(place);
    const auto k = static_cast<std::int64_t>(before);
    const double a = sample(k);
    return a + (place - before) * (sample(k + 1) - a);
}

double Trace::next_corner(double t) const {
    const auto after =
        std::upper_bound(corners_.begin(), corners_.end(), t, [&](double at, std::int64_t k) { return at < static_cast<double>(k) * T_; });
    return after == corners_.end() ? std::numeric_limits<double>::infinity() : static_cast<double>(*after) * T_;
}

void Trace::forget(double t) {
    const auto from = std::min(static_cast<std::int64_t>(std::floor(in_reach(t / T_))) - 1, looked_ - lag);
    if (from <= first_) return;
    const auto gone = std::min<std::int64_t>(from - first_, static_cast<std::int64_t>(samples_.size()));
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(gone));
    first_ += gone;
    corners_.erase(corners_.begin(), std::lower_bound(corners_.begin(), corners_.end(), from));
}

void Trace::shift(std::int64_t samples) {
    first_ -= samples, looked_ -= samples, line_from_ -= static_cast<double>(samples);
    for (auto& k : corners_) k -= samples;
}

void Trace::save(std::vector<double>& out) const {
    for (const std::int64_t n : {first_, looked_, static_cast<std::int64_t>(corners_.size())}) out.push_back(static_cast<double>(n));
    for (const double x : {line_from_, line_at_, line_slope_, largest_}) out.push_back(x);
    for (const auto k : corners_) out.push_back(static_cast<double>(k));
    out.insert(out.end(), samples_.begin(), samples_.end());
}

bool Trace::restore(std::span<const double> in) {
    const auto whole = [](double x) { return std::abs(x) < 0x1p53 && x == std::floor(x); };
    if (in.size() < numbers || !whole(in[0]) || !whole(in[1]) || !(in[2] >= 0 && in[2] <= static_cast<double>(in.size() - numbers)))
        return false;
    const auto corners = in.subspan(numbers).first(static_cast<std::size_t>(in[2]));
    if (!std::all_of(corners.begin(), corners.end(), whole)) return false;
    first_ = static_cast<std::int64_t>(in[0]), looked_ = static_cast<std::int64_t>(in[1]);
    line_from_ = in[3], line_at_ = in[4], line_slope_ = in[5], largest_ = in[6];
    corners_.clear();
    for (const double k : corners) corners_.push_back(static_cast<std::int64_t>(k));
    samples_.assign(in.begin() + static_cast<std::ptrdiff_t>(numbers + corners.size()), in.end());
    return true;
}

}  // namespace corpuscle::circuit
