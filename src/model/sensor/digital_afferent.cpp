#include "model/sensor/digital_afferent.hpp"

#include <algorithm>

namespace corpuscle {
namespace {

constexpr std::size_t values_before_words = 7;  // number of state values before the words of the chain, see pack_state()
constexpr double max_count = 0x1p53;            // up to here a double holds every integer exactly

}  // namespace

struct DigitalAfferent::TypedState {
    ChannelSlot slot;
    ConversionTimes times;
    ConversionTimes::SamplePosition next;                      ///< position of the next conversion, from the start of the simulation
    double before = 0, sensed = 0;                             ///< force of the last sample, N: before and after the sensor's hysteresis
    std::int64_t code = -1;                                    ///< code of the last conversion; -1: no conversion yet
    std::array<Word, FixedChain::max_words> state = {};        ///< state of the chain
    std::array<Word, FixedChain::max_recordables> shown = {};  ///< recordable values after the last conversion
};

DigitalAfferent::DigitalAfferent(std::string name, Converter converter, std::unique_ptr<const FixedChain> chain, double f_s, bool shared,
                                 double dt)
    : name_(std::move(name)), converter_(std::move(converter)), chain_(std::move(chain)), source_rate_(1 / dt), f_s_(f_s), shared_(shared) {
    const auto format = chain_->constants.format();
    for (std::int64_t code = 0; code <= converter_.max_code(); ++code) rom_.push_back(format.nearest(converter_.force(code)));
    format_ = fmt::format("{} in words of {}.{}/1, T = {} s", name_, format.word, format.frac, dt);
    for (const auto& stage : converter_.front_end().stages()) probes_.push_back(stage.output);
    probes_.push_back({"code", ""});
    probes_.push_back({"F_read", "N"});
    for (const auto& [shown, unit] : chain_->recordables) probes_.push_back({shown, unit});
}

ConversionTimes DigitalAfferent::conversion_times(std::uint32_t channels) const { return {source_rate_, f_s_, channels}; }

State DigitalAfferent::start(ChannelSlot slot) const {
    if (!shared_ || slot.channel_count == 0) slot = {};
    TypedState h{slot, conversion_times(slot.channel_count), {}};
    h.next = h.times.first(slot.channel);
    Arithmetic a{chain_->constants.format()};
    chain_->start(0, h.state);
    auto trial = h.state;  // the state after this step is discarded; h.shown gets the values at rest, shown until the first conversion
    chain_->step(trial, 0, h.shown, a);
    State state{format_, 0, std::vector<double>(values_before_words + chain_->words() + chain_->recordables.size())};
    pack_state(h, state);
    return state;
}

void DigitalAfferent::pack_state(const TypedState& h, State& state) const {
    auto to = state.values.begin();
    for (const double x : {static_cast<double>(h.slot.channel), static_cast<double>(h.slot.channel_count), static_cast<double>(h.next.step),
                           static_cast<double>(h.next.remainder), h.before, h.sensed, static_cast<double>(h.code)})
        *to++ = x;
    for (std::size_t w = 0; w < chain_->words(); ++w) *to++ = static_cast<double>(h.state[w]);
    for (std::size_t w = 0; w < chain_->recordables.size(); ++w) *to++ = static_cast<double>(h.shown[w]);
}

/// Returns nullopt if a value cannot have been written by pack_state().
std::optional<DigitalAfferent::TypedState> DigitalAfferent::unpack_state(const State& state) const {
    const auto& v = state.values;
    const auto is_count = [](double x, double low, double high) { return x >= low && x <= high && x == std::floor(x); };
    if (!is_count(v[1], 1, 0x1p20) || !is_count(v[0], 0, v[1] - 1) || !is_count(v[2], 0, max_count) || !is_count(v[3], 0, max_count))
        return {};
    if (!std::isfinite(v[4]) || !std::isfinite(v[5]) || !is_count(v[6], -1, static_cast<double>(converter_.max_code()))) return {};
    const ChannelSlot slot{static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1])};
    TypedState h{slot, conversion_times(slot.channel_count), {static_cast<std::int64_t>(v[2]), static_cast<std::int64_t>(v[3])}, v[4],
                 v[5], static_cast<std::int64_t>(v[6])};
    if (h.next.remainder >= h.times.parts_per_sample()) return {};
    const auto max_word = static_cast<double>(chain_->constants.format().max());
    for (std::size_t w = 0; w < v.size() - values_before_words; ++w) {
        const double word = v[values_before_words + w];
        if (!is_count(word, -max_word - 1, std::max(max_word, 1e7))) return {};  // 1e7: refractory steps in 10 s at 1 MHz
        (w < chain_->words() ? h.state[w] : h.shown[w - chain_->words()]) = static_cast<Word>(word);
    }
    return h;
}

Result<void> DigitalAfferent::respond(std::span<const double> force, State& state, ResponseBlock& response) const {
    return respond_and_report(force, state, response, [](const Conversion&) {});
}

Result<void> DigitalAfferent::respond_and_report(std::span<const double> force, State& state, ResponseBlock& response,
                                                 const ConversionCallback& on_conversion) const {
    const auto size = values_before_words + chain_->words() + chain_->recordables.size();
    TRY(check_block(name_, format_, size, state, force));
    auto unpacked = unpack_state(state);
    if (!unpacked) return bad_input(name_ + ": a saved state is damaged: it contains values that are neither words nor counts");
    if (force.empty()) return {};
    auto& h = *unpacked;
    // The force before the first sample is assumed to be the same.
    if (state.step == 0) h.before = h.sensed = force[0];
    const auto& front = converter_.front_end();
    for (std::size_t k = 0; k < force.size(); ++k) {
        const std::int64_t sample = state.step + static_cast<std::int64_t>(k);
        // All conversions after the previous sample, up to and at this one.
        for (; !h.next.is_after(sample); h.times.advance(h.next)) {
            const bool on_sample = h.next.remainder == 0;
            // x: position of the conversion between the previous sample (0) and this one (1); it is the spike's offset
            const double x = on_sample ? 1 : static_cast<double>(h.next.remainder) / static_cast<double>(h.times.parts_per_sample());
            const double F = on_sample ? force[k] : h.before + x * (force[k] - h.before);
            convert_once(h, front.apply_hysteresis(h.sensed, F), {h.next.step + !on_sample, x, response.afferent_index}, response,
                         on_conversion);
        }
        h.sensed = front.apply_hysteresis(h.sensed, force[k]);
        h.before = force[k];
        if (!response.probes.empty()) record(h, h.sensed, k, response);
    }
    pack_state(h, state);
    state.step += static_cast<std::int64_t>(force.size());
    return {};
}

/// One conversion of a force (N, after hysteresis) and one step of the algorithms. `at`: the spike to append for each neuron that fires.
void DigitalAfferent::convert_once(TypedState& h, double sensed, Spike at, ResponseBlock& response,
                                   const ConversionCallback& on_conversion) const {
    const auto [code, saturated] = converter_.convert(sensed);
    const Word F = rom_[static_cast<std::size_t>(code)];
    if (h.code < 0) chain_->start(F, h.state);
    h.code = code;
    Arithmetic a{chain_->constants.format()};
    const auto stepped = chain_->step(h.state, F, h.shown, a);
    for (const bool spike : stepped.fired)
        if (spike) response.spikes.push_back(at);
    response.truncated_steps += stepped.truncated_neurons, response.saturated += saturated, response.overflowed += a.overflowed;
    on_conversion({code, F, std::span(h.shown).first(chain_->recordables.size()),
                   std::span(stepped.fired).first(static_cast<std::size_t>(chain_->outputs()))});
}

/// Records the probes at sample k of the block: the outputs of the front end for this sample's force, and the values of the last
/// conversion.
void DigitalAfferent::record(const TypedState& h, double sensed, std::size_t k, ResponseBlock& response) const {
    const auto format = chain_->constants.format();
    std::vector<double> shown(converter_.front_end().stages().size());
    (void)converter_.front_end().read(sensed, shown.data());
    shown.push_back(static_cast<double>(std::max<std::int64_t>(h.code, 0)));
    shown.push_back(h.code < 0 ? 0 : format.value(rom_[static_cast<std::size_t>(h.code)]));
    for (std::size_t w = 0; w < chain_->recordables.size(); ++w)
        shown.push_back(format.value(h.shown[w]) * (chain_->recordables[w].second == "A" ? 1e-6 : 1));  // currents are in uA
    for (std::size_t p = 0; p < shown.size(); ++p) response.probes[p][k] = shown[p];
}

}  // namespace corpuscle
