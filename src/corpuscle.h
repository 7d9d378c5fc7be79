/* A skin that answers as force comes, frame by frame, for other languages (doc/live.md). Plain C; no exception leaves it. One skin is to
 * be used by one thread at a time; several skins are nothing to one another. */
#ifndef CORPUSCLE_H
#define CORPUSCLE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct corpuscle_skin corpuscle_skin;

typedef struct corpuscle_spike {
    double time;      /* s; the first frame is at 0 */
    uint32_t unit;    /* which afferent: corpuscle_unit_name */
    uint32_t address; /* of it (doc/events.md) */
} corpuscle_spike;

/* Called for each spike, in order; must not throw or leave by longjmp. */
typedef void (*corpuscle_sink)(void* user, const corpuscle_spike* spike);

/* "hand", "fingertip", "grid 8x8", a population file; or afferents by name ("sa1,fa1"), each on all of `channels`. NULL: the text in
 * `error`, which may be NULL, says why. */
corpuscle_skin* corpuscle_create(const char* population, double rate_hz, size_t channels, char* error, size_t error_size);
/* The same with `count` settings of its classes, such as "sa1.f_B=25Hz". */
corpuscle_skin* corpuscle_create_with(const char* population, double rate_hz, size_t channels, const char* const* settings, size_t count,
                                      char* error, size_t error_size);
void corpuscle_destroy(corpuscle_skin* skin); /* NULL is nothing */

size_t corpuscle_sites(const corpuscle_skin* skin);                         /* forces of a frame */
const char* corpuscle_site_name(const corpuscle_skin* skin, size_t site);   /* "r1c2"; site from 0; NULL: there is none */
/* Where force `site` of a frame is felt, in metres: x to the right, y away from the wrist. 0, or -1: there is no such site. */
int corpuscle_site_position(const corpuscle_skin* skin, size_t site, double* x, double* y);
size_t corpuscle_units(const corpuscle_skin* skin);                         /* afferents */
const char* corpuscle_unit_name(const corpuscle_skin* skin, uint32_t unit); /* "sa1#17"; NULL: there is none */

/* These give 0, or -1: then corpuscle_error says why. */

/* One force (N) a site; the spikes that arrive in this frame go to the sink, which may be NULL. */
int corpuscle_push(corpuscle_skin* skin, const double* frame, size_t sites, corpuscle_sink sink, void* user);
/* At the end of it all: spikes still on their way. */
int corpuscle_last(corpuscle_skin* skin, corpuscle_sink sink, void* user);

/* Where it stands, into `bytes`, which has room for `size`; returns how many bytes it takes (0: an error). With NULL it only tells. */
size_t corpuscle_save(corpuscle_skin* skin, void* bytes, size_t size);
/* One made alike goes on from there. */
int corpuscle_resume(corpuscle_skin* skin, const void* bytes, size_t size);

const char* corpuscle_error(const corpuscle_skin* skin); /* of the last call that failed; "" if none did */

#ifdef __cplusplus
}
#endif
#endif
