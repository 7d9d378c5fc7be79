/* A simulated skin for other languages: force frames in, spikes out, one frame at a time (doc/live.md). Plain C; no exception leaves a
 * function. A skin must not be used by two threads at the same time. Different skins are independent. */
#ifndef CORPUSCLE_H
#define CORPUSCLE_H

#include <stddef.h>
#include <stdint.h>

#ifndef CORPUSCLE_API
#define CORPUSCLE_API __attribute__((visibility("default"))) /* what the shared library shows */
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct corpuscle_skin corpuscle_skin;

typedef struct corpuscle_spike {
    double time;       /* s; the first frame is at time 0 */
    uint32_t afferent; /* index of the afferent, from 0; corpuscle_afferent_name gives its name */
    uint32_t address;  /* the afferent's address in event files (doc/events.md) */
} corpuscle_spike;

/* Called for each spike, in time order. `user` is the pointer that was passed together with the sink. It must not throw or call longjmp. */
typedef void (*corpuscle_sink)(void* user, const corpuscle_spike* spike);

/* `population` is "hand", "fingertip", "grid 8x8", a population file, or afferents by name ("sa1,fa1"). `rate_hz` is in frames per second.
 * Afferents by name are created on each of `channels` channels; other populations ignore `channels`. Returns NULL on failure
 * and writes the reason into `error`, a buffer of `error_size` bytes, which may be NULL. */
CORPUSCLE_API corpuscle_skin* corpuscle_create(const char* population, double rate_hz, size_t channels, char* error, size_t error_size);
/* The same, with `settings`, an array of `count` parameter settings such as "sa1.f_B=25Hz". */
CORPUSCLE_API corpuscle_skin* corpuscle_create_with(const char* population, double rate_hz, size_t channels, const char* const* settings, size_t count,
                                      char* error, size_t error_size);
/* The same, but frames are the forces of taxels, which the file `taxels` lays out on the skin (doc/taxels.md). */
CORPUSCLE_API corpuscle_skin* corpuscle_create_taxels(const char* population, const char* taxels, double rate_hz, const char* const* settings,
                                        size_t count, char* error, size_t error_size);
CORPUSCLE_API void corpuscle_destroy(corpuscle_skin* skin); /* NULL is allowed */

CORPUSCLE_API size_t corpuscle_frame_size(const corpuscle_skin* skin);                  /* number of forces in a frame: of the taxels, or of the sites */
CORPUSCLE_API size_t corpuscle_sites(const corpuscle_skin* skin);                       /* number of sites of the skin */
CORPUSCLE_API const char* corpuscle_site_name(const corpuscle_skin* skin, size_t site); /* such as "r1c2"; sites count from 0; NULL if unknown */
/* Position of a site in metres: x to the right, y away from the wrist. Returns 0, or -1 if there is no such site. */
CORPUSCLE_API int corpuscle_site_position(const corpuscle_skin* skin, size_t site, double* x, double* y);
CORPUSCLE_API size_t corpuscle_afferents(const corpuscle_skin* skin);                          /* number of afferents */
CORPUSCLE_API const char* corpuscle_afferent_name(const corpuscle_skin* skin, uint32_t index); /* "sa1#17"; NULL: no such afferent */

/* corpuscle_push, corpuscle_finish and corpuscle_resume return 0, or -1 on failure. corpuscle_error then returns the message. */

/* Simulates one frame: one force (N) for each site, or taxel; `sites` is the number of forces. Spikes that arrive during this frame, after
 * their conduction delay, are passed to `sink`, which may be NULL. */
CORPUSCLE_API int corpuscle_push(corpuscle_skin* skin, const double* frame, size_t sites, corpuscle_sink sink, void* user);
/* Call after the last frame: passes the spikes that are still travelling along the nerve to `sink`. */
CORPUSCLE_API int corpuscle_finish(corpuscle_skin* skin, corpuscle_sink sink, void* user);

/* Writes the state into `bytes`, a buffer of `size` bytes. Returns the number of bytes needed, or 0 on failure. If `bytes` is NULL,
 * nothing is written, and only the number is returned. A buffer that is too small is a failure. */
CORPUSCLE_API size_t corpuscle_save(corpuscle_skin* skin, void* bytes, size_t size);
/* Restores a saved state. The skin must have been created with the same arguments. */
CORPUSCLE_API int corpuscle_resume(corpuscle_skin* skin, const void* bytes, size_t size);

CORPUSCLE_API const char* corpuscle_error(const corpuscle_skin* skin); /* message of the last call that failed; "" if none has failed */

#ifdef __cplusplus
}
#endif
#endif
