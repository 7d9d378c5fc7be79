#include "circuit/device/source_waveform.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/element_reader.hpp"
#include "core/number/elementary.hpp"
#include "core/random.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double no_time = std::numeric_limits<double>::infinity();
using Shape = Waveform::Shape;

const WaveformSyntax* shape_of(std::string_view word) {
    if (word == "sine") word = "sin";  // ngspice has both
    for (const auto& row : waveform_syntaxes)
        if (row.name == word) return &row;
    return nullptr;
}

/// Reads the specification of a V or I source: DC, AC and time waveform.
class SourceLine {
    ElementReader& line_;
    Waveform& out_;
    std::size_t k_ = 3;                      // index of the next word; at first, the one after the name and two nodes
    std::vector<std::size_t> number_words_;  // for each of out_.numbers, the index of its word

public:
    explicit SourceLine(ElementReader& line) : line_(line), out_(line.element.waveform) {}

    Result<void> read() {
        if (is_number_next()) TRY(dc());
        while (!is_done()) TRY(next_item());
        for (const std::string_view name : {"dc", "ac", "r", "td"})
            if (const auto* pair = line_.find(name)) TRY(named(name, *pair));
        return {};
    }

private:
    bool is_done() const { return k_ >= line_.word_count(); }
    bool is_keyword(std::size_t k) const {
        const auto w = line_.text(k);
        return line_.is_plain(k) && (w == "dc" || w == "ac" || w == "distof1" || w == "distof2" || shape_of(w));
    }
    /// True if the next word is the phase in ac=MAGNITUDE,PHASE.
    bool is_phase_of_ac() const {
        const auto* ac = line_.find("ac");
        if (ac == nullptr || is_done() || line_.word(k_).at < ac->value.at || line_.word(k_ - 1).at > ac->value.at) return false;
        return line_.is_after_comma(k_);
    }
    bool is_number_next() const {
        if (is_done() || is_keyword(k_) || is_phase_of_ac()) return false;
        return !line_.is_plain(k_) || parse_number(line_.text(k_)) || line_.is_parameter(k_);
    }
    Result<double> number() { return line_.number(k_++); }

    Result<void> dc() {
        if (is_done() || is_keyword(k_)) return line_.error_at(k_, "dc must be followed by a number");
        if (out_.has_dc) line_.warn(k_, "dc is given twice; this value is used");
        const auto value = TRY(number());
        out_.dc = value, out_.has_dc = true;
        return {};
    }

    Result<void> ac() {
        out_.ac_magnitude = 1;
        for (double* to : {&out_.ac_magnitude, &out_.ac_phase}) {
            if (is_done() || is_keyword(k_)) return {};
            *to = TRY(number());
        }
        return {};
    }

    /// Skips the magnitude and phase of an input of .disto, an analysis that we do not have.
    Result<void> skip_distortion() {
        ++k_;
        for (int k = 0; k < 2 && is_number_next(); ++k) TRY(number());
        return {};
    }

    /// Reads dc, ac or a time waveform with its numbers.
    Result<void> next_item() {
        const auto w = line_.text(k_);
        if (is_phase_of_ac()) {
            out_.ac_phase = TRY(number());
            return {};
        }
        if (w == "dc") return ++k_, dc();
        if (w == "ac") return ++k_, ac();
        if (w == "distof1" || w == "distof2") return skip_distortion();
        const auto* row = shape_of(w);
        if (!row) return line_.number_with_decimal_comma(k_).empty() ? line_.error_at(k_, "{}", unknown(w)) : line_.too_many(k_);
        if (out_.shape != Shape::none) return line_.error_at(k_, "only one time waveform is allowed, not also '{}'", w);
        ++k_;
        return shape(*row);
    }

    static std::string unknown(std::string_view w) {
        constexpr std::string_view known[] = {"dc", "ac", "pulse", "sin", "exp", "pwl", "sffm", "am", "trnoise", "force"};
        if (w == "trrandom" || w == "external")
            return fmt::format("{} sources are not supported; known are pulse, sin, exp, pwl, sffm, am, trnoise and force", w);
        return fmt::format("unknown word '{}'{}", w, did_you_mean(w, known));
    }

    Result<void> shape(const WaveformSyntax& row) {
        out_.shape = row.shape;
        const auto keyword = k_ - 1;
        while (!is_done() && !is_keyword(k_)) {
            if (is_phase_of_ac()) break;
            number_words_.push_back(k_);
            const bool is_relative =
                row.shape == Shape::piecewise_linear && out_.numbers.size() % 2 == 0 && line_.text(k_).starts_with('+');
            const double previous = is_relative && out_.numbers.size() > 1 ? out_.numbers[out_.numbers.size() - 2] : 0;
            out_.numbers.push_back(previous + TRY(number()));
        }
        const auto n = out_.numbers.size();
        if (n < row.min_numbers || n > row.max_numbers)
            return line_.error_at(keyword, "{} has {} number{}; expected {}{}", row.name, n, n == 1 ? "" : "s", row.usage,
                                  n > row.max_numbers ? fmt::format(" with at most {}", row.max_numbers) : "");
        if (row.shape != Shape::piecewise_linear) warn_about_decimal_commas();
        if (row.shape == Shape::force && n == 0) out_.numbers = {1};
        if (row.shape == Shape::noise) TRY(check_noise());
        return row.shape == Shape::piecewise_linear ? check_points() : Result<void>();
    }

    /// Warns about "sin(0 0,5 1k)": if blanks separate the numbers, a comma between two digits was probably meant as a decimal point.
    void warn_about_decimal_commas() {
        std::size_t commas = 0, separating = 0, with_comma = 0;
        for (const auto k : number_words_ | std::views::drop(1)) {
            separating += line_.is_after_comma(k);
            if (!line_.number_with_decimal_comma(k).empty()) ++commas, with_comma = k;
        }
        if (commas == 0 || separating + 1 >= number_words_.size()) return;
        line_.warn(with_comma, fmt::format("'{},{}' is two numbers; the decimal point is a dot: {}", line_.text(with_comma - 1),
                                           line_.text(with_comma), line_.number_with_decimal_comma(with_comma)));
    }

    Result<void> check_noise() {
        if (!(out_.numbers[1] > 0)) return line_.error_at(number_words_[1], "trnoise: the interval of the noise must be above 0 s");
        for (std::size_t k = 2; k < out_.numbers.size(); ++k)
            if (out_.numbers[k] != 0)
                return line_.error_at(number_words_[k],
                                      "trnoise: only white noise is supported, trnoise(na nt 0 0); 1/f noise comes from devices with kf, "
                                      "by .options noisefmax");
        return {};
    }

    /// Checks the points of a pwl.
    Result<void> check_points() {
        const auto& x = out_.numbers;
        if (x.size() % 2) return line_.error_at(number_words_.back(), "pwl has {} numbers; expected pairs of a time and a value", x.size());
        for (std::size_t k = 2; k < x.size(); k += 2)
            if (x[k] <= x[k - 2]) return line_.error_at(number_words_[k], "pwl: time {:g} must be later than {:g}", x[k], x[k - 2]);
        return {};
    }

    void delay(double by) {
        for (std::size_t k = 0; k < out_.numbers.size(); k += 2) out_.numbers[k] += by;
        if (out_.repeats_from) *out_.repeats_from += by;
    }

    /// Reads r= of a pwl: the time from which it repeats, that of a point; -1 for none.
    Result<void> repeat(double from, const NameValue& pair) {
        if (from == -1) return {};
        const auto& x = out_.numbers;
        bool is_point = false;
        for (std::size_t k = 0; k + 2 < x.size(); k += 2) is_point |= x[k] == from;
        if (!is_point) return line_.error_at(pair.value, "pwl: r = {:g} s is not the time of a point before the last", from);
        out_.repeats_from = from;
        return {};
    }

    /// Reads dc=, ac=, or td= or r= of a pwl.
    Result<void> named(std::string_view name, const NameValue& pair) {
        const auto value = TRY(line_.number(pair));
        if (name == "dc" && !out_.has_dc)
            out_.dc = value, out_.has_dc = true;
        else if (name == "ac" && out_.ac_magnitude == 0)
            out_.ac_magnitude = value;
        else if (name == "td" && out_.shape == Shape::piecewise_linear)
            delay(value);
        else if (name == "r" && out_.shape == Shape::piecewise_linear)
            return repeat(value, pair);
        else if (name == "td" || name == "r")
            return line_.error_at(pair.name, "{}= is allowed only with pwl", name);
        else if (name == "dc" || name == "ac")
            return line_.error_at(pair.name, "{} is given twice", name);
        return {};
    }
};

}  // namespace

SourceWaveform::SourceWaveform(Waveform wave, double step, double stop, std::uint64_t seed)
    : wave_(std::move(wave)), step_(step), stop_(stop), seed_(seed) {
    if (wave_.shape == Shape::piecewise_linear)
        for (std::size_t k = 0; k + 1 < wave_.numbers.size(); k += 2) breakpoints_.push_back(wave_.numbers[k]);
    if (wave_.shape == Shape::exponential) {
        const double rise_delay = number(2, 0);
        breakpoints_ = {rise_delay, number(4, rise_delay + step_)};
    }
    if (wave_.shape == Shape::sine) breakpoints_ = {number(3, 0)};
    if (wave_.shape == Shape::sine && number(6, 0) > 0) breakpoints_.push_back(number(3, 0) + number(6, 0) / frequency());
    if (wave_.shape == Shape::amplitude_modulated) breakpoints_ = {number(4, 0)};
}

double SourceWaveform::at(double t) const {
    if (wave_.shape == Shape::pulse) return pulse(t);
    if (wave_.shape == Shape::sine) return sine(t);
    if (wave_.shape == Shape::exponential) return exponential(t);
    if (wave_.shape == Shape::frequency_modulated) return frequency_modulated(t);
    if (wave_.shape == Shape::amplitude_modulated) return amplitude_modulated(t);
    if (wave_.shape == Shape::noise) return noise(t);
    return wave_.shape == Shape::piecewise_linear ? piecewise_linear(t) : wave_.dc;
}

/// The arguments of PULSE are v1 v2 td tr tf pw per np; np is the number of pulses; 0: no limit.
SourceWaveform::PulseTimes SourceWaveform::pulse_times() const {
    PulseTimes out{positive_or(3, step_), positive_or(4, step_), number(5, stop_), 0};
    out.period = positive_or(6, std::max(stop_, out.rise + out.width + out.fall));
    return out;
}

double SourceWaveform::pulse(double t) const {
    const auto [rise, fall, width, period] = pulse_times();
    const double v1 = number(0, 0), v2 = number(1, 0);
    if (t < number(2, 0)) return v1;
    const double cycle = std::floor((t - number(2, 0)) / period);
    if (const double cycles = number(7, 0); cycles > 0 && cycle >= cycles) return v1;
    // Breakpoints are computed exactly as in next_breakpoint(): on a steep edge one unit in the last place of a time is visible.
    const double start = number(2, 0) + cycle * period, down = start + (rise + width);
    if (t < start + rise) return v1 + (v2 - v1) * ((t - start) / rise);
    if (t < down) return v2;
    return t < start + (rise + width + fall) ? v2 + (v1 - v2) * ((t - down) / fall) : v1;
}

/// The arguments of SIN are vo va freq td theta phase ncycles. After `ncycles` cycles it has its initial value; 0: no limit.
double SourceWaveform::sine(double t) const {
    const double elapsed = t - number(3, 0), phase = number(5, 0) / 360, cycles = number(6, 0);
    if (elapsed < 0 || (cycles > 0 && elapsed >= cycles / frequency())) return number(0, 0) + number(1, 0) * num::sin_turns(phase);
    const double turns = frequency() * elapsed + phase;
    return number(0, 0) + number(1, 0) * num::sin_turns(turns - std::floor(turns)) * num::exp(-elapsed * number(4, 0));
}

/// The arguments of EXP are v1 v2 td1 tau1 td2 tau2.
double SourceWaveform::exponential(double t) const {
    const double v1 = number(0, 0), v2 = number(1, 0), up = number(2, 0), down = number(4, up + step_);
    const auto approach = [](double s) { return s * num::exprel(-s); };  // 1 - e^-s, accurate also for small s
    double v = v1;
    if (t > up) v += (v2 - v1) * approach((t - up) / positive_or(3, step_));
    if (t > down) v += (v1 - v2) * approach((t - down) / positive_or(5, step_));
    return v;
}

/// The arguments of SFFM are vo va fc mdi fs phasec phases.
double SourceWaveform::frequency_modulated(double t) const {
    const double carrier = positive_or(2, 1 / stop_) * t + number(5, 0) / 360, signal = positive_or(4, 1 / stop_) * t + number(6, 0) / 360;
    const double turns = carrier + number(3, 0) / (2 * std::numbers::pi) * num::sin_turns(signal - std::floor(signal));
    return number(0, 0) + number(1, 0) * num::sin_turns(turns - std::floor(turns));
}

/// The arguments of AM are va vo mf fc td phase.
double SourceWaveform::amplitude_modulated(double t) const {
    const double elapsed = t - number(4, 0);
    if (elapsed <= 0) return 0;
    const double phase = number(5, 0) / 360, signal = positive_or(2, 1 / stop_) * elapsed + phase,
                 carrier = positive_or(3, 1 / stop_) * elapsed + phase;
    return number(0, 0) * (number(1, 0) + num::sin_turns(signal - std::floor(signal))) * num::sin_turns(carrier - std::floor(carrier));
}

/// The number of the interval of TRNOISE in which t is. A time is in the interval that begins there.
std::int64_t SourceWaveform::noise_interval(double t) const {
    constexpr double rounding = 1e-9;
    return static_cast<std::int64_t>(std::floor(std::max(t, 0.0) / number(1, 0) + rounding));
}

/// The arguments of TRNOISE are na, the standard deviation, and nt, the interval of normal deviates, between which the value is linear.
double SourceWaveform::noise(double t) const {
    const auto k = noise_interval(t);
    const auto deviate = [&](std::int64_t index) {
        return normal(seed_, 0, static_cast<std::uint32_t>(stream_id("trnoise")), static_cast<std::uint64_t>(index));
    };
    const double part = std::clamp(t / number(1, 0) - static_cast<double>(k), 0.0, 1.0);
    return wave_.dc + number(0, 0) * ((1 - part) * deviate(k) + part * deviate(k + 1));
}

double SourceWaveform::in_first_cycle(double t) const {
    if (!wave_.repeats_from || t <= breakpoints_.back()) return t;
    const double from = *wave_.repeats_from, period = breakpoints_.back() - from;
    return t - std::floor((t - from) / period) * period;
}

/// The netlist reader guarantees at least one point, and ascending times.
double SourceWaveform::piecewise_linear(double time) const {
    const auto& x = wave_.numbers;
    const double t = in_first_cycle(time);
    const auto after = static_cast<std::size_t>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t) - breakpoints_.begin());
    if (after == 0) return x[1];
    if (after == breakpoints_.size()) return x[2 * after - 1];
    const double t0 = x[2 * after - 2], v0 = x[2 * after - 1], t1 = x[2 * after], v1 = x[2 * after + 1];
    return v0 + (v1 - v0) * ((t - t0) / (t1 - t0));
}

double SourceWaveform::max_step() const {
    if (wave_.shape == Shape::sine) return 0.1 / frequency();
    if (wave_.shape == Shape::amplitude_modulated) return 0.1 / std::max(positive_or(2, 1 / stop_), positive_or(3, 1 / stop_));
    if (wave_.shape != Shape::frequency_modulated) return no_time;
    const double signal = positive_or(4, 1 / stop_);
    return 0.1 / (positive_or(2, 1 / stop_) + std::abs(number(3, 0)) * signal + signal);
}

/// The next breakpoint of a repeated PWL after its first cycle.
double SourceWaveform::next_repeated_breakpoint(double t) const {
    const double from = *wave_.repeats_from, period = breakpoints_.back() - from;
    // From one cycle earlier, since the quotient is rounded.
    for (double cycle = std::max(1.0, std::floor((t - from) / period) - 1);; ++cycle)
        for (const double point : breakpoints_)
            if (const double breakpoint = point + cycle * period; point > from && breakpoint > t) return breakpoint;
}

double SourceWaveform::next_breakpoint(double t) const {
    if (wave_.shape == Shape::noise) return static_cast<double>(noise_interval(t) + 1) * number(1, 0);
    if (wave_.shape != Shape::pulse) {
        const auto next = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t);
        if (next != breakpoints_.end()) return *next;
        return wave_.repeats_from ? next_repeated_breakpoint(t) : no_time;
    }
    const auto [rise, fall, width, period] = pulse_times();
    const double delay = number(2, 0), cycles = number(7, 0);
    if (t < delay) return delay;
    // From one cycle earlier, since the quotient is rounded.
    for (double cycle = std::max(0.0, std::floor((t - delay) / period) - 1);; ++cycle) {
        if (cycles > 0 && cycle > cycles) return no_time;
        for (const double offset : {0.0, rise, rise + width, rise + width + fall})
            if (const double breakpoint = delay + cycle * period + offset; breakpoint > t) return breakpoint;
    }
}

Result<void> read_waveform(ElementReader& line) { return SourceLine(line).read(); }

}  // namespace corpuscle::circuit
