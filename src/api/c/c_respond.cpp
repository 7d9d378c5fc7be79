// Runs and responses of corpuscle.h.

#include "api/c/c_force.hpp"
#include "api/c/c_simulation.hpp"

namespace corpuscle::api {
namespace {

/// A response, and its summary as a C string once it has been asked for.
struct CResponse {
    Response response;
    std::string summary = {};
};
using Responses = HandleTable<CResponse, 2>;

CResponse& of(const corpuscle_response* handle) { return object_of<Responses>(handle, "response"); }

corpuscle_response* add_response(Response response) {
    return static_cast<corpuscle_response*>(Responses::all().add(std::make_unique<CResponse>(CResponse{std::move(response)})));
}

/// An afferent of the response. Throws BadCall.
const RespondingAfferent& afferent_of(const corpuscle_response* handle, std::size_t index) {
    const auto& all = of(handle).response.afferents;
    if (index < all.size()) return all[index];
    throw BadCall("there is no afferent " + std::to_string(index) + "; the response has " + std::to_string(all.size()) +
                  ", which count from 0");
}

/// A force in memory of the caller.
ForceView view_of(const double* force, std::size_t samples, std::size_t channels, double rate) {
    if (!force && samples > 0) throw BadCall("force is NULL, but the number of its samples is not 0");
    ForceView view;
    view.rate = rate, view.count = samples, view.stride = static_cast<std::ptrdiff_t>(channels);
    for (std::size_t c = 0; c < channels; ++c) view.samples.push_back(force + c);
    return view;
}

template <class Get>
const char* text_of(const corpuscle_response* handle, const Get& get) {
    return or_failed<const char*>(nullptr, [&] { return get(handle); });
}

}  // namespace
}  // namespace corpuscle::api

using namespace corpuscle::api;

corpuscle_response* corpuscle_respond(const double* force, size_t samples, size_t channels, double rate_hz,
                                      const corpuscle_simulation* simulation) {
    return or_failed<corpuscle_response*>(
        nullptr, [&] { return add_response(corpuscle::respond(view_of(force, samples, channels, rate_hz), simulation_of(simulation))); });
}

corpuscle_response* corpuscle_respond_force(const corpuscle_force* force, const corpuscle_simulation* simulation) {
    return or_failed<corpuscle_response*>(
        nullptr, [&] { return add_response(corpuscle::respond(object_of<Forces>(force, "force"), simulation_of(simulation))); });
}

corpuscle_response* corpuscle_respond_stimulus(const char* name, double rate_hz, const corpuscle_simulation* simulation) {
    return or_failed<corpuscle_response*>(
        nullptr, [&] { return add_response(corpuscle::respond_to(required_text(name, "name"), simulation_of(simulation), rate_hz)); });
}

void corpuscle_response_destroy(corpuscle_response* response) { destroy<Responses>(response, "response"); }

size_t corpuscle_response_spikes(const corpuscle_response* response) {
    return or_failed(size_t{0}, [&] { return of(response).response.times.size(); });
}
const double* corpuscle_response_times(const corpuscle_response* response) {
    return or_failed<const double*>(nullptr, [&] { return of(response).response.times.data(); });
}
const uint32_t* corpuscle_response_indices(const corpuscle_response* response) {
    return or_failed<const uint32_t*>(nullptr, [&] { return of(response).response.indices.data(); });
}
size_t corpuscle_response_afferents(const corpuscle_response* response) {
    return or_failed(size_t{0}, [&] { return of(response).response.afferents.size(); });
}
const char* corpuscle_response_afferent_name(const corpuscle_response* response, size_t index) {
    return text_of(response, [&](auto* r) { return afferent_of(r, index).name.c_str(); });
}
const char* corpuscle_response_afferent_type(const corpuscle_response* response, size_t index) {
    return text_of(response, [&](auto* r) { return afferent_of(r, index).type.c_str(); });
}
const char* corpuscle_response_afferent_channel(const corpuscle_response* response, size_t index) {
    return text_of(response, [&](auto* r) { return afferent_of(r, index).channel.c_str(); });
}
int corpuscle_response_afferent_position(const corpuscle_response* response, size_t index, double* x, double* y) {
    return to_code([&] {
        const auto& afferent = afferent_of(response, index);
        if (x) *x = afferent.x;
        if (y) *y = afferent.y;
    });
}
double corpuscle_response_start(const corpuscle_response* response) {
    return or_failed(not_a_number, [&] { return of(response).response.start; });
}
double corpuscle_response_duration(const corpuscle_response* response) {
    return or_failed(not_a_number, [&] { return of(response).response.duration; });
}
const char* corpuscle_response_note(const corpuscle_response* response, size_t number) {
    return text_of(response, [&](auto* r) { return text_or_null(of(r).response.notes, number); });
}
const char* corpuscle_response_warning(const corpuscle_response* response, size_t number) {
    return text_of(response, [&](auto* r) { return text_or_null(of(r).response.warnings, number); });
}
const char* corpuscle_response_summary(corpuscle_response* response) {
    return text_of(response, [&](auto* r) {
        auto& of_run = of(r);
        if (of_run.summary.empty()) of_run.summary = of_run.response.summary();
        return of_run.summary.c_str();
    });
}
