// The live skin of corpuscle.h.

#include <cstring>

#include "api/c/c_handle.hpp"
#include "corpuscle/live.hpp"

namespace corpuscle::api {
namespace {

struct CSkin {
    LiveSkin skin;
    std::vector<std::string> names = {};     // of the afferents; returned as C strings
    std::vector<LiveSkin::Site> sites = {};  // of which the names are returned as C strings
};
using Skins = HandleTable<CSkin, 3>;

CSkin& of(const corpuscle_skin* handle) { return object_of<Skins>(handle, "skin"); }

/// The skin that `make` returns, with its names as C strings. If it throws, stores the failure and returns null.
template <class Make>
corpuscle_skin* create_skin(const Make& make) noexcept {
    return or_failed<corpuscle_skin*>(nullptr, [&] {
        auto made = std::make_unique<CSkin>(CSkin{make()});
        for (std::uint32_t u = 0; u < made->skin.afferents(); ++u) made->names.push_back(made->skin.afferent_name(u));
        for (std::size_t s = 0; s < made->skin.sites(); ++s) made->sites.push_back(made->skin.site(s));
        return static_cast<corpuscle_skin*>(Skins::all().add(std::move(made)));
    });
}

/// A site of the skin. Throws BadCall.
const LiveSkin::Site& site_of(const corpuscle_skin* handle, std::size_t site) {
    const auto& all = of(handle).sites;
    if (site < all.size()) return all[site];
    throw BadCall("there is no site " + std::to_string(site) + "; the skin has " + std::to_string(all.size()) + ", which count from 0");
}

/// Calls the sink, unless it is null, for each event.
void call_sink(std::span<const LiveSkin::Event> events, corpuscle_sink sink, void* user) {
    if (!sink) return;
    for (const auto& e : events) {
        const corpuscle_spike spike{e.time, e.afferent_index, e.address};
        sink(user, &spike);
    }
}

/// Copies a state into a buffer, if there is one. Returns its size.
std::size_t copy_state(std::span<const std::byte> state, void* bytes, std::size_t size) {
    if (bytes && size < state.size())
        throw BadCall("a state of " + std::to_string(state.size()) + " bytes does not fit into a buffer of " + std::to_string(size));
    if (bytes) std::memcpy(bytes, state.data(), state.size());
    return state.size();
}

}  // namespace
}  // namespace corpuscle::api

using namespace corpuscle::api;

corpuscle_skin* corpuscle_create(const char* population, double rate_hz, size_t channels) {
    return corpuscle_create_with(population, rate_hz, channels, nullptr, 0);
}

corpuscle_skin* corpuscle_create_with(const char* population, double rate_hz, size_t channels, const char* const* settings, size_t count) {
    return create_skin([&] {
        return corpuscle::LiveSkin(required_text(population, "population"), rate_hz, channels, texts_of(settings, count, "settings"));
    });
}

corpuscle_skin* corpuscle_create_taxels(const char* population, const char* taxels, double rate_hz, const char* const* settings,
                                        size_t count) {
    return create_skin([&] {
        return corpuscle::LiveSkin::with_taxels(required_text(population, "population"), required_text(taxels, "taxels"), rate_hz,
                                                texts_of(settings, count, "settings"));
    });
}

void corpuscle_destroy(corpuscle_skin* skin) { destroy<Skins>(skin, "skin"); }

size_t corpuscle_frame_size(const corpuscle_skin* skin) {
    return or_failed(size_t{0}, [&] { return of(skin).skin.frame_size(); });
}
size_t corpuscle_sites(const corpuscle_skin* skin) {
    return or_failed(size_t{0}, [&] { return of(skin).sites.size(); });
}
const char* corpuscle_site_name(const corpuscle_skin* skin, size_t site) {
    return or_failed<const char*>(nullptr, [&] { return site_of(skin, site).name.c_str(); });
}
int corpuscle_site_position(const corpuscle_skin* skin, size_t site, double* x, double* y) {
    return to_code([&] {
        const auto& at = site_of(skin, site);
        if (x) *x = at.x;
        if (y) *y = at.y;
    });
}
size_t corpuscle_afferents(const corpuscle_skin* skin) {
    return or_failed(size_t{0}, [&] { return of(skin).names.size(); });
}
const char* corpuscle_afferent_name(const corpuscle_skin* skin, uint32_t index) {
    return or_failed<const char*>(nullptr, [&] {
        const auto& names = of(skin).names;
        if (index >= names.size()) throw BadCall("there is no afferent " + std::to_string(index));
        return names[index].c_str();
    });
}

int corpuscle_push(corpuscle_skin* skin, const double* frame, size_t sites, corpuscle_sink sink, void* user) {
    return to_code([&] {
        auto& pushed = of(skin).skin;
        if (!frame) throw BadCall("frame is NULL");
        call_sink(pushed.respond({frame, sites}), sink, user);
    });
}

int corpuscle_finish(corpuscle_skin* skin, corpuscle_sink sink, void* user) {
    return to_code([&] { call_sink(of(skin).skin.finish(), sink, user); });
}

size_t corpuscle_save(corpuscle_skin* skin, void* bytes, size_t size) {
    return or_failed(size_t{0}, [&] { return copy_state(of(skin).skin.save(), bytes, size); });
}

int corpuscle_resume(corpuscle_skin* skin, const void* bytes, size_t size) {
    return to_code([&] {
        auto& resumed = of(skin).skin;
        if (!bytes) throw BadCall("the state is NULL");
        resumed.resume({static_cast<const std::byte*>(bytes), size});
    });
}
