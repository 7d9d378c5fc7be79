#include "circuit/afferent/force_waveform.hpp"

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/expression/spice_number.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_bend = 2e-3;       // smallest bend of a breakpoint, as a fraction of the largest force
constexpr double min_bend_ratio = 4;    // smallest ratio of its bend to the smaller of the bends two samples before and after
constexpr double max_deviation = 0.05;  // from the line from the last breakpoint, as a fraction of the largest force

/// Limits a number of samples to the range in which a double represents every integer; a damaged state may contain larger ones.
double to_exact_range(double samples) { return samples >= -0x1p53 && samples <= 0x1p53 ? samples : samples > 0 ? 0x1p53 : -0x1p53; }

constexpr double max_samples = 1e8;

template <class... Arguments>
Error error_in(const Directive& c, std::size_t word, fmt::format_string<Arguments...> message, Arguments&&... arguments) {
    return error_at(c.location_of(word), ".force: {}", fmt::format(message, std::forward<Arguments>(arguments)...));
}

/// The parameter's name with its capital letters, as the stimulus declares it. A parsed netlist has all names in small letters.
std::string spelling_of(std::string_view stimulus, std::string_view parameter) {
    for (const auto& card : stimulus_catalog())
        for (const auto& row : card.parameters)
            if (card.name == stimulus && equal_ignoring_case(row.name, parameter)) return std::string(row.name);
    return std::string(parameter);
}

struct ForceSpec {
    std::vector<ParameterOverride> overrides;  // parameters of the stimulus
    double rate = 10e3;                        // Hz
};

Result<ForceSpec> parse_force_spec(const Directive& c) {
    ForceSpec out;
    for (std::size_t k = 1; k < c.words.size(); ++k) {
        const std::string_view word = c.words[k];
        const auto equals = std::min(word.find('='), word.size()), dot = word.substr(0, equals).rfind('.');
        const auto value = equals < word.size() ? parse_number(word.substr(equals + 1)) : std::nullopt;
        if (!value) return error_in(c, k, "'{}' must be PARAMETER=VALUE, such as f_max=2", word);
        const auto name = word.substr(0, equals);
        if (name == "rate") {
            out.rate = value->value;
            continue;
        }
        const std::string stimulus(dot == std::string_view::npos ? std::string_view(c.words[0]) : name.substr(0, dot));
        const auto parameter = dot == std::string_view::npos ? name : name.substr(dot + 1);
        out.overrides.push_back({stimulus, spelling_of(stimulus, parameter), fmt::format("{}", value->value), std::string(word)});
    }
    return out;
}

Result<ForceWaveform> read_waveform_of(ForceSource& source, const Directive& c) {
    ForceWaveform waveform(source.clock().T());
    double count = 0, last = 0;
    for (Frames block(source.channels().size(), 4096);;) {  // a stimulus has one channel
        TRY(source.read(block));
        if (block.count == 0) {
            waveform.append(std::vector<double>(ForceWaveform::lookahead + 1, last));  // decides on breakpoints among the last samples
            return waveform;
        }
        if ((count += static_cast<double>(block.count)) > max_samples)
            return error_in(c, 0, "more than {:g} samples; lower the rate or shorten the stimulus", max_samples);
        waveform.append(std::span(block.force[0]).first(block.count));
        last = block.force[0][block.count - 1];
    }
}

Result<std::unique_ptr<ForceSource>> source_of(const Directive& c) {
    if (c.words.empty()) return error_in(c, 0, "a stimulus is missing, such as '.force press f_max=2'");
    const auto spec = TRY(parse_force_spec(c));
    auto source = make_stimulus(c.words[0], spec.overrides, spec.rate, 0);  // seed 0
    if (!source) return error_in(c, 0, "{}", source.error().message);
    if (auto ok = check_all_used(source->unused, stimulus_members(c.words[0])); !ok) return error_in(c, 0, "{}", ok.error().message);
    return std::move(source->result);
}

/// The .force line; null if there is none. A second one is an error.
Result<const Directive*> find_force_line(const Circuit& circuit) {
    const Directive* found = nullptr;
    for (const auto& c : circuit.directives_named("force")) {
        if (found) return error_at(c.location, ".force: only one is allowed; the first is in line {}", found->location.line);
        found = &c;
    }
    return found;
}

constexpr double max_error = 1e-4;  // as a fraction of the largest force
constexpr int points_per_line = 6;

/// Numbers, from 0 to `last`, of the samples through which a piecewise linear curve passes that stays within `tolerance` (N) of all
/// samples. Each line is as long as possible.
std::vector<std::int64_t> select_breakpoints(const ForceWaveform& waveform, std::int64_t last, double tolerance) {
    const auto at = [&](std::int64_t k) { return waveform.at(static_cast<double>(k) * waveform.T()); };
    std::vector<std::int64_t> out{0};
    for (std::int64_t from = 0; from < last;) {
        double min_slope = -std::numeric_limits<double>::infinity(), max_slope = -min_slope;  // N per sample
        std::int64_t to = from + 1;
        for (std::int64_t k = from + 1; k <= last; ++k) {
            const auto length = static_cast<double>(k - from);
            const double slope = (at(k) - at(from)) / length;
            if (slope < min_slope || slope > max_slope)
                break;  // a line to this sample would miss an earlier one by more than the tolerance
            to = k;
            min_slope = std::max(min_slope, slope - tolerance / length), max_slope = std::min(max_slope, slope + tolerance / length);
        }
        out.push_back(from = to);
    }
    return out;
}

}  // namespace

double ForceWaveform::sample(std::int64_t k) const {
    if (samples_.empty()) return 0;
    return samples_[static_cast<std::size_t>(std::clamp<std::int64_t>(k - first_, 0, static_cast<std::int64_t>(samples_.size()) - 1))];
}

void ForceWaveform::append(std::span<const double> force) {
    samples_.insert(samples_.end(), force.begin(), force.end());
    while (next_to_check_ + lookahead < first_ + static_cast<std::int64_t>(samples_.size())) check_next_sample();
}

/// Adds the next sample to the breakpoints if it is one.
void ForceWaveform::check_next_sample() {
    const std::int64_t k = next_to_check_++;
    const auto begin_line = [&](std::int64_t from) {
        line_from_ = static_cast<double>(from), line_at_ = sample(from), line_slope_ = sample(from + 1) - sample(from);
    };
    largest_ = std::max({largest_, std::abs(sample(k - 1)), std::abs(sample(k)), std::abs(sample(k + lookahead))});
    if (k == 1) begin_line(0);  // before the first breakpoint
    const double nearby_bend = std::min(std::abs(bend(k - 2)), std::abs(bend(k + 2)));
    const bool is_sharp = std::abs(bend(k)) > std::max(min_bend * largest_, min_bend_ratio * nearby_bend);
    const double line = line_at_ + line_slope_ * (static_cast<double>(k) - line_from_);
    if (!is_sharp && std::abs(sample(k) - line) <= max_deviation * largest_) return;
    breakpoints_.push_back(k);
    begin_line(k);
}

double ForceWaveform::at(double t) const {
    const double position = to_exact_range(t / T_), before = std::floor(position);
    const auto k = static_cast<std::int64_t>(before);
    const double a = sample(k);
    return a + (position - before) * (sample(k + 1) - a);
}

double ForceWaveform::next_breakpoint(double t) const {
    const auto after = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t,
                                        [&](double time, std::int64_t k) { return time < static_cast<double>(k) * T_; });
    return after == breakpoints_.end() ? std::numeric_limits<double>::infinity() : static_cast<double>(*after) * T_;
}

void ForceWaveform::discard_before(double t) {
    const auto from = std::min(static_cast<std::int64_t>(std::floor(to_exact_range(t / T_))) - 1, next_to_check_ - lookahead);
    if (from <= first_) return;
    const auto count = std::min<std::int64_t>(from - first_, static_cast<std::int64_t>(samples_.size()));
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(count));
    first_ += count;
    breakpoints_.erase(breakpoints_.begin(), std::lower_bound(breakpoints_.begin(), breakpoints_.end(), from));
}

void ForceWaveform::shift_origin(std::int64_t samples) {
    first_ -= samples, next_to_check_ -= samples, line_from_ -= static_cast<double>(samples);
    for (auto& k : breakpoints_) k -= samples;
}

void ForceWaveform::archive(StateArchive& a) {
    auto breakpoints = breakpoints_.size();
    for (auto* n : {&first_, &next_to_check_}) a.integer(*n, -max_exact_integer, max_exact_integer);
    a.integer(breakpoints, 0, a.is_reader() ? static_cast<double>(a.rest()) : max_exact_integer);
    for (double* x : {&line_from_, &line_at_, &line_slope_, &largest_}) a.number(*x);
    breakpoints_.resize(breakpoints);
    for (auto& k : breakpoints_) a.integer(k, -max_exact_integer, max_exact_integer);
    a.numbers(samples_, a.is_reader() ? a.rest() : samples_.size());
}

Result<std::vector<Phase>> force_phases(const Circuit& circuit) {
    const auto line = TRY(find_force_line(circuit));
    if (!line) return std::vector<Phase>();
    const auto source = TRY(source_of(*line));
    return source->phases();
}

Result<std::optional<ForceWaveform>> force_directive(const Circuit& circuit) {
    const auto line = TRY(find_force_line(circuit));
    if (!line) return std::optional<ForceWaveform>();
    auto source = TRY(source_of(*line));
    return std::optional<ForceWaveform>(TRY(read_waveform_of(*source, *line)));
}

Result<std::string> pwl_force(const Circuit& circuit, double scale) {
    const auto force = TRY(force_directive(circuit));
    if (!force) return std::string();
    const ForceWaveform& waveform = *force;
    // force_directive() appends lookahead + 1 samples with a constant force.
    const std::int64_t last = waveform.end_sample() - 1 - (ForceWaveform::lookahead + 1);
    double largest = 0;
    for (std::int64_t k = 0; k <= last; ++k) largest = std::max(largest, std::abs(waveform.at(static_cast<double>(k) * waveform.T())));
    std::string out = "pwl(";
    int count = 0;
    for (const auto k : select_breakpoints(waveform, last, max_error * largest)) {
        const double t = static_cast<double>(k) * waveform.T();
        out += fmt::format("{}{:.9g} {:.9g}", count == 0 ? "" : count % points_per_line == 0 ? "\n+ " : " ", t, scale * waveform.at(t));
        ++count;
    }
    return out + ')';
}

}  // namespace corpuscle::circuit
