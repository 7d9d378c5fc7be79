// The force of corpuscle.h.

#include "api/c/c_force.hpp"

namespace corpuscle::api {
namespace {

Force& force_of(const corpuscle_force* handle) { return object_of<Forces>(handle, "force"); }

corpuscle_force* add_force(Force force) {
    return static_cast<corpuscle_force*>(Forces::all().add(std::make_unique<Force>(std::move(force))));
}

/// "unit=mN" as {"unit", "mN"}.
Options options_of(const std::vector<std::string>& texts) {
    Options out;
    for (const auto& text : texts) {
        const auto at = text.find('=');
        if (at == text.npos) throw InputError("'" + text + "' is not an option with a value, such as unit=mN or abs=true");
        out.emplace_back(text.substr(0, at), text.substr(at + 1));
    }
    return out;
}

/// The index of a channel of the force. Throws BadCall.
std::size_t channel_of(const Force& force, std::size_t channel) {
    if (channel < force.channels.size()) return channel;
    throw BadCall("there is no channel " + std::to_string(channel) + "; the force has " + std::to_string(force.channels.size()) +
                  ", which count from 0");
}

}  // namespace
}  // namespace corpuscle::api

using namespace corpuscle::api;

corpuscle_force* corpuscle_stimulus(const char* name, const char* const* settings, size_t count, double rate_hz, uint64_t seed) {
    return or_failed<corpuscle_force*>(nullptr, [&] {
        return add_force(corpuscle::stimulus(required_text(name, "name"), texts_of(settings, count, "settings"), rate_hz, seed));
    });
}

corpuscle_force* corpuscle_read(const char* path, const char* const* options, size_t count) {
    return or_failed<corpuscle_force*>(nullptr, [&] {
        return add_force(corpuscle::read_recording(required_text(path, "path"), options_of(texts_of(options, count, "options"))));
    });
}

void corpuscle_force_destroy(corpuscle_force* force) { destroy<Forces>(force, "force"); }

double corpuscle_force_rate(const corpuscle_force* force) {
    return or_failed(not_a_number, [&] { return force_of(force).rate; });
}
double corpuscle_force_start(const corpuscle_force* force) {
    return or_failed(not_a_number, [&] { return force_of(force).start; });
}
size_t corpuscle_force_channels(const corpuscle_force* force) {
    return or_failed(size_t{0}, [&] { return force_of(force).channels.size(); });
}
size_t corpuscle_force_samples(const corpuscle_force* force) {
    return or_failed(size_t{0}, [&] { return force_of(force).samples.empty() ? 0 : force_of(force).samples[0].size(); });
}
const char* corpuscle_force_channel_name(const corpuscle_force* force, size_t channel) {
    return or_failed<const char*>(nullptr, [&] { return force_of(force).channels[channel_of(force_of(force), channel)].c_str(); });
}
const double* corpuscle_force_channel(const corpuscle_force* force, size_t channel) {
    return or_failed<const double*>(nullptr, [&] { return force_of(force).samples[channel_of(force_of(force), channel)].data(); });
}
const char* corpuscle_force_note(const corpuscle_force* force, size_t number) {
    return or_failed<const char*>(nullptr, [&] { return text_or_null(force_of(force).notes, number); });
}
const char* corpuscle_force_warning(const corpuscle_force* force, size_t number) {
    return or_failed<const char*>(nullptr, [&] { return text_or_null(force_of(force).warnings, number); });
}
