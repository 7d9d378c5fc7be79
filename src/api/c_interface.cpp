// The C interface of LiveSkin. Its functions never throw; errors are returned.

#include <algorithm>
#include <cstring>

#include "corpuscle.h"
#include "corpuscle.hpp"

struct corpuscle_skin {
    corpuscle::LiveSkin skin;
    std::vector<std::string> names = {};                // of the afferents; returned as C strings
    std::vector<corpuscle::LiveSkin::Site> sites = {};  // of which the names are returned as C strings
    std::string error = {};                             // message of the last error
};

namespace corpuscle {
namespace {

/// Copies a text, shortened if necessary, to a buffer of `size` bytes, and terminates it. Does nothing without a buffer.
void copy_text(const char* text, char* to, std::size_t size) {
    if (!to || size == 0) return;
    const auto length = std::min(std::strlen(text), size - 1);
    std::memcpy(to, text, length);
    to[length] = '\0';
}

/// Calls the sink, unless it is null, for each event.
void call_sink(std::span<const LiveSkin::Event> events, corpuscle_sink sink, void* user) {
    if (!sink) return;
    for (const auto& e : events) {
        const corpuscle_spike spike{e.time, e.afferent_index, e.address};
        sink(user, &spike);
    }
}

/// Returns the result of `work`. If it throws, stores the message in skin->error and returns `failed`. Without a skin returns `failed`.
template <class T, class Work>
T catch_errors(corpuscle_skin* skin, T failed, const Work& work) noexcept {
    if (!skin) return failed;
    try {
        return work();
    } catch (const std::exception& e) {
        try {
            skin->error = e.what();
        } catch (...) {
            skin->error.clear();  // out of memory for the message
        }
    } catch (...) {
        skin->error.clear();
    }
    return failed;
}

/// The settings as texts. Throws InputError for a null pointer.
std::vector<std::string> settings_of(const char* const* settings, std::size_t count) {
    if (!settings && count > 0) throw InputError("settings is NULL, but count is not 0");
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < count; ++k) {
        if (!settings[k]) throw InputError("setting " + std::to_string(k) + " is NULL");
        texts.emplace_back(settings[k]);
    }
    return texts;
}

/// The skin that `make` returns, with its names as C strings. If it throws, writes the message into `error` and returns null.
template <class Make>
corpuscle_skin* create_skin(char* error, std::size_t error_size, const Make& make) noexcept {
    copy_text("", error, error_size);
    try {
        auto made = std::unique_ptr<corpuscle_skin>(new corpuscle_skin{make()});
        for (std::uint32_t u = 0; u < made->skin.afferents(); ++u) made->names.push_back(made->skin.afferent_name(u));
        for (std::size_t s = 0; s < made->skin.sites(); ++s) made->sites.push_back(made->skin.site(s));
        return made.release();
    } catch (const std::exception& e) {
        copy_text(e.what(), error, error_size);
    } catch (...) {
        copy_text("unknown error", error, error_size);
    }
    return nullptr;
}

}  // namespace
}  // namespace corpuscle

using corpuscle::catch_errors;

corpuscle_skin* corpuscle_create(const char* population, double rate_hz, size_t channels, char* error, size_t error_size) {
    return corpuscle_create_with(population, rate_hz, channels, nullptr, 0, error, error_size);
}

corpuscle_skin* corpuscle_create_with(const char* population, double rate_hz, size_t channels, const char* const* settings, size_t count,
                                      char* error, size_t error_size) {
    return corpuscle::create_skin(error, error_size, [&] {
        if (!population) throw corpuscle::InputError("population is NULL");
        return corpuscle::LiveSkin(population, rate_hz, channels, corpuscle::settings_of(settings, count));
    });
}

corpuscle_skin* corpuscle_create_taxels(const char* population, const char* taxels, double rate_hz, const char* const* settings,
                                        size_t count, char* error, size_t error_size) {
    return corpuscle::create_skin(error, error_size, [&] {
        if (!population || !taxels) throw corpuscle::InputError(population ? "taxels is NULL" : "population is NULL");
        return corpuscle::LiveSkin::with_taxels(population, taxels, rate_hz, corpuscle::settings_of(settings, count));
    });
}

void corpuscle_destroy(corpuscle_skin* skin) { delete skin; }

size_t corpuscle_frame_size(const corpuscle_skin* skin) { return skin ? skin->skin.frame_size() : 0; }
size_t corpuscle_sites(const corpuscle_skin* skin) { return skin ? skin->skin.sites() : 0; }
const char* corpuscle_site_name(const corpuscle_skin* skin, size_t site) {
    return skin && site < skin->sites.size() ? skin->sites[site].name.c_str() : nullptr;
}
int corpuscle_site_position(const corpuscle_skin* skin, size_t site, double* x, double* y) {
    if (!skin || site >= skin->sites.size()) return -1;
    if (x) *x = skin->sites[site].x;
    if (y) *y = skin->sites[site].y;
    return 0;
}
size_t corpuscle_afferents(const corpuscle_skin* skin) { return skin ? skin->names.size() : 0; }
const char* corpuscle_afferent_name(const corpuscle_skin* skin, uint32_t index) {
    return skin && index < skin->names.size() ? skin->names[index].c_str() : nullptr;
}
const char* corpuscle_error(const corpuscle_skin* skin) { return skin ? skin->error.c_str() : "skin is NULL"; }

int corpuscle_push(corpuscle_skin* skin, const double* frame, size_t sites, corpuscle_sink sink, void* user) {
    return catch_errors(skin, -1, [&] {
        if (!frame) throw corpuscle::InputError("frame is NULL");
        corpuscle::call_sink(skin->skin.respond({frame, sites}), sink, user);
        return 0;
    });
}

int corpuscle_finish(corpuscle_skin* skin, corpuscle_sink sink, void* user) {
    return catch_errors(skin, -1, [&] { return corpuscle::call_sink(skin->skin.finish(), sink, user), 0; });
}

size_t corpuscle_save(corpuscle_skin* skin, void* bytes, size_t size) {
    return catch_errors(skin, std::size_t{0}, [&] {
        const auto state = skin->skin.save();
        if (bytes && size < state.size())
            throw corpuscle::InputError("a state of " + std::to_string(state.size()) + " bytes does not fit into a buffer of " +
                                        std::to_string(size));
        if (bytes) std::memcpy(bytes, state.data(), state.size());
        return state.size();
    });
}

int corpuscle_resume(corpuscle_skin* skin, const void* bytes, size_t size) {
    return catch_errors(skin, -1, [&] {
        if (!bytes) throw corpuscle::InputError("the state is NULL");
        skin->skin.resume({static_cast<const std::byte*>(bytes), size});
        return 0;
    });
}
