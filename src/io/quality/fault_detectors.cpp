#include "io/quality/fault_detectors.hpp"

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// True if chunk number `chunk` is examined: each of the first 256 chunks, then every second one up to 512, every fourth up to 1024 ...
bool is_examined(std::int64_t chunk) {
    const auto spacing = static_cast<std::uint64_t>(std::max<std::int64_t>(chunk / 128, 1));
    return chunk % static_cast<std::int64_t>(std::bit_floor(spacing)) == 0;
}

/// The median of seven by a branch-free sorting network of thirteen exchanges.
inline double median_of_seven(const double* x) {
    double a = x[0], b = x[1], c = x[2], d = x[3], e = x[4], f = x[5], g = x[6];
    const auto order = [](double& low, double& high) {  // swaps them if the first one is larger
        const double smaller = low < high ? low : high, larger = low < high ? high : low;
        low = smaller, high = larger;
    };
    order(a, f), order(a, d), order(b, g), order(c, e), order(a, b), order(d, f), order(c, g);
    order(c, d), order(d, g), order(e, f), order(b, e), order(b, d), order(d, e);
    return d;
}

constexpr std::int64_t samples_per_chunk = 4096;  // windows of seven samples do not extend over the end of a chunk

}  // namespace

/// Examines the next samples of the current chunk. A sample is examined together with the three samples before and after it, so the last
/// samples wait in chunk_ for the next call.
void OutlierDetector::examine(std::span<const double> more) {
    chunk_.insert(chunk_.end(), more.begin(), more.end());
    const std::size_t n = chunk_.size() > 6 ? chunk_.size() - 6 : 0;  // number of complete windows; window k is centred on sample k + 3
    double deviation[samples_per_chunk + 6], isolation[samples_per_chunk + 6];
    const double* const x = chunk_.data();
    for (std::size_t k = 0; k < n; ++k) {
        const double middle = x[k + 3], left = middle - x[k + 2], right = middle - x[k + 4];
        deviation[k] = std::abs(middle - median_of_seven(x + k));
        const double nearer = std::abs(left) < std::abs(right) ? std::abs(left) : std::abs(right);
        const double smallest = nearer < deviation[k] ? nearer : deviation[k];
        isolation[k] = left * right > 0 ? smallest : 0;  // 0 unless the sample is above both neighbours, or below both
    }
    for (std::size_t k = 0; k < n; ++k) {
        if (deviation[k] > 0) deviations_.add(deviation[k]);
        if (!(isolation[k] > 0)) continue;
        isolations_.add(isolation[k]);
        if (min_isolation_ == 0 || isolation[k] < min_isolation_) min_isolation_ = isolation[k];
    }
    examined_ += static_cast<std::int64_t>(n);
    if (n > 0) chunk_.erase(chunk_.begin(), chunk_.end() - 6);
}

/// Retains every stride_-th sample. When 128 samples are retained, removes every second one of them and doubles the stride.
void OutlierDetector::retain(std::span<const double> x) {
    for (std::int64_t k = next_retained_ - seen_; k < static_cast<std::int64_t>(x.size()); k = next_retained_ - seen_) {
        retained_.push_back(x[static_cast<std::size_t>(k)]);
        next_retained_ += stride_;
        if (retained_.size() < 128) continue;
        for (std::size_t n = 0; n < 64; ++n) retained_[n] = retained_[2 * n];
        retained_.resize(64), stride_ *= 2;
        next_retained_ = 64 * stride_;
    }
}

void OutlierDetector::add(std::span<const double> x) {
    while (!x.empty()) {
        const std::int64_t number = seen_ / samples_per_chunk, left = samples_per_chunk - seen_ % samples_per_chunk;
        const auto now = x.first(std::min(x.size(), static_cast<std::size_t>(left)));
        if (seen_ % samples_per_chunk == 0) chunk_.clear();
        if (is_examined(number)) examine(now);
        retain(now);
        seen_ += static_cast<std::int64_t>(now.size());
        x = x.subspan(now.size());
    }
}

double OutlierDetector::interquartile_range() const {
    auto sorted = retained_;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[sorted.size() * 3 / 4] - sorted[sorted.size() / 4];
}

std::int64_t OutlierDetector::count() const {
    return isolations_.count_above(std::max({8 * deviations_.median(examined_), interquartile_range() / 10, 4 * min_isolation_}));
}

void SaturationDetector::add(std::span<const double> x) {
    double max = -1e308;
    double min = lowest_;
    for (const double value : x) min = value < min ? value : min, max = value > max ? value : max;
    lowest_ = min;
    seen_ += static_cast<std::int64_t>(x.size());
    if (max < highest_) {  // no sample of the block reaches the highest value so far
        if (!x.empty()) run_ = 0;
        return;
    }
    for (const double value : x) {
        if (value > highest_) highest_ = value, run_ = 0, runs_ = 0, at_highest_ = 0;
        run_ = value == highest_ ? run_ + 1 : 0;
        at_highest_ += value == highest_;
        runs_ += run_ == 3;  // counts a run once, at its third sample
    }
}

void SumDetector::add(const std::vector<std::vector<double>>& block, std::size_t channels) {
    channels = std::min(channels, block.size());
    if (channels > max_channels) return;
    first_.resize(channels);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t k = 0; k < block[c].size() && first_[c].size() < rows; ++k) first_[c].push_back(block[c][k]);
}

/// True if channel `c` is the sum of the channels `from` to `to` in every stored row, to within 0.1 %, and is not constant.
bool SumDetector::is_sum(std::size_t c, std::size_t from, std::size_t to) const {
    bool varies = false;
    for (std::size_t k = 0; k < first_[c].size(); ++k) {
        double sum = 0;
        for (std::size_t n = from; n <= to; ++n) sum += first_[n][k];
        if (!(std::abs(sum - first_[c][k]) <= 1e-3 * std::abs(sum))) return false;
        varies = varies || first_[c][k] != first_[c][0];
    }
    return varies;
}

/// At least two of the summed channels must have values other than zero. Otherwise two equal channels would count as a sum if the channels
/// next to one of them are zero, as most channels of a tactile skin are.
std::vector<SumDetector::Sum> SumDetector::find_sums() const {
    std::vector<Sum> sums;
    std::vector<std::size_t> active(first_.size() + 1);  // active[c]: number of channels before c that have a value other than 0
    for (std::size_t c = 0; c < first_.size(); ++c)
        active[c + 1] = active[c] + std::any_of(first_[c].begin(), first_[c].end(), [](double x) { return x != 0; });
    for (std::size_t c = 0; c < first_.size(); ++c)
        for (std::size_t from = 0; from < first_.size(); ++from)
            for (std::size_t to = from + 1; to < first_.size(); ++to)
                if ((c < from || c > to) && active[to + 1] - active[from] > 1 && is_sum(c, from, to)) sums.push_back({c, from, to});
    return sums;
}

HumTable::HumTable(const Clock& clock) {
    decimation = std::max<std::int64_t>(1, static_cast<std::int64_t>(clock.rate() / 1000));
    const double rate = clock.rate() / static_cast<double>(decimation);  // of the decimated samples, Hz
    if (rate < 2) return;
    const auto length = static_cast<std::size_t>(rate);
    for (std::size_t n = 0; n < length; ++n) {
        const double at = static_cast<double>(n),
                     window = 1 - num::cos_turns(at / static_cast<double>(length));  // Hann window with a mean of 1
        Phasors phasors{};
        for (std::size_t l = 0; l < line_count; ++l) {
            const double f = mains[l / 3] + 6 * (static_cast<double>(l % 3) - 1), turns = f / rate * at;
            phasors.re[l] = window * num::cos_turns(turns - std::floor(turns));
            phasors.im[l] = window * num::sin_turns(turns - std::floor(turns));
        }
        phasors_of_second.push_back(phasors);
    }
}

void HumDetector::end_second() {
    const auto n = static_cast<double>(table_.phasors_of_second.size());
    if (is_examined(second_)) {
        variance_ += squares_ / n - total_ / n * (total_ / n);
        for (std::size_t l = 0; l < HumTable::line_count; ++l) {  // a sinusoid of amplitude A has the power A^2 / 2, its variance
            const double re = sum_.re[l] / n, im = sum_.im[l] / n;
            power_[l] += 2 * (re * re + im * im);
        }
    }
    ++second_, at_ = 0, sum_ = {}, total_ = squares_ = 0;
}

void HumDetector::add_decimated(double x) {
    if (at_ == 0) first_ = x;
    const double y = x - first_;
    if (is_examined(second_)) {
        const auto& phasors = table_.phasors_of_second[at_];
        for (std::size_t l = 0; l < HumTable::line_count; ++l) sum_.re[l] += phasors.re[l] * y, sum_.im[l] += phasors.im[l] * y;
        total_ += y, squares_ += y * y;
    }
    if (++at_ == table_.phasors_of_second.size()) end_second();
}

void HumDetector::add(std::span<const double> x) {
    if (!table_.covers(0) && !table_.covers(1)) return;
    for (const double value : x) {
        decimated_ += value;
        if (++in_group_ < table_.decimation) continue;
        add_decimated(decimated_ / static_cast<double>(table_.decimation));
        decimated_ = 0, in_group_ = 0;
    }
}

bool HumDetector::is_significant(std::size_t mains_index) const {
    const double* p = power_ + 3 * mains_index;  // p[1]: at the mains frequency; p[0], p[2]: 6 Hz below and above it
    return table_.covers(mains_index) && p[1] > 4 * (p[0] + p[2]);
}

HumDetector::Hum HumDetector::result() const {
    Hum best;
    for (std::size_t mains_index = 0; mains_index < 2; ++mains_index)
        if (const double fraction = variance_ > 0 ? std::min(1.0, power_[3 * mains_index + 1] / variance_) : 0;
            is_significant(mains_index) && fraction > best.fraction)
            best = {table_.mains[mains_index], fraction};
    return best;
}

}  // namespace corpuscle
