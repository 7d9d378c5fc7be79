/* Corpuscle in C, and for every language that calls C: force in, spikes out, as a whole (corpuscle_respond) or one frame at a time
 * (corpuscle_push). doc/library.md has examples in C and with Python's ctypes.
 *
 * Failure. A function that returns a pointer returns NULL. One that returns an int returns a negative code, and one that returns a number of
 * items returns 0. corpuscle_error() then has the text, which is that of the command line, and corpuscle_error_code() has the code. No
 * exception leaves a function. NULL, and an object that has been destroyed, are CORPUSCLE_BAD_CALL.
 *
 * Memory. A text or array that a function returns belongs to the object that it was asked of, and is valid until that is destroyed.
 *
 * Threads. One object must not be used by two threads at the same time. Different objects are independent.
 *
 * Binary interface. A program that was linked against libcorpuscle.so.N runs with every later library of this name, N = CORPUSCLE_ABI. With
 * the same N functions are only added, never changed or removed. A structure whose first member is `size` may grow at its end: a program
 * sets `size` to sizeof of the structure that it was compiled with, and sets members that it does not use to 0. Other structures and the
 * values of constants stay as they are. The C++ headers do not make this promise (doc/library.md). */
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

/* The binary interface that this header describes. corpuscle_abi() returns that of the library in use. */
#define CORPUSCLE_ABI 0
CORPUSCLE_API int corpuscle_abi(void);
CORPUSCLE_API const char* corpuscle_version(void); /* "0.1.0" */

/* Codes of failure. */
#define CORPUSCLE_OK 0
#define CORPUSCLE_BAD_INPUT (-1)     /* a name, a value or a file is wrong; the text says which, and what would be right */
#define CORPUSCLE_BAD_CALL (-2)      /* NULL, a destroyed object, a buffer that is too small, a structure of the wrong size */
#define CORPUSCLE_NOT_CONVERGED (-3) /* a circuit has no solution that the solver finds */
#define CORPUSCLE_OUT_OF_MEMORY (-4)
#define CORPUSCLE_STOPPED (-5) /* the progress function asked to stop */

/* The last call of this thread that failed: its text, valid until the next failure in this thread ("" if none has failed), and its code. */
CORPUSCLE_API const char* corpuscle_error(void);
CORPUSCLE_API int corpuscle_error_code(void);

/* ---- Force: a stimulus of the catalogue, or a recording. A force in an array of your own needs no object. ---- */

typedef struct corpuscle_force corpuscle_force;

/* A stimulus ("press"), or a sum ("press+noise"), with settings such as "press.F_max=2N". `seed` is for random stimuli. */
CORPUSCLE_API corpuscle_force* corpuscle_stimulus(const char* name, const char* const* settings, size_t count, double rate_hz,
                                                  uint64_t seed);
/* Reads a recording. Options are those of `corpuscle respond --help-all` for recordings, without dashes: "unit=mN", "abs=true". */
CORPUSCLE_API corpuscle_force* corpuscle_read(const char* path, const char* const* options, size_t count);
CORPUSCLE_API void corpuscle_force_destroy(corpuscle_force* force); /* NULL is allowed */

CORPUSCLE_API double corpuscle_force_rate(const corpuscle_force* force);  /* Hz */
CORPUSCLE_API double corpuscle_force_start(const corpuscle_force* force); /* s, time of the first sample */
CORPUSCLE_API size_t corpuscle_force_channels(const corpuscle_force* force);
CORPUSCLE_API size_t corpuscle_force_samples(const corpuscle_force* force); /* of each channel */
CORPUSCLE_API const char* corpuscle_force_channel_name(const corpuscle_force* force, size_t channel);
CORPUSCLE_API const double* corpuscle_force_channel(const corpuscle_force* force, size_t channel); /* its samples, N */
/* A text about how a recording was read, and about a fault that makes responses doubtful. They count from 0; NULL: there are no more. */
CORPUSCLE_API const char* corpuscle_force_note(const corpuscle_force* force, size_t number);
CORPUSCLE_API const char* corpuscle_force_warning(const corpuscle_force* force, size_t number);

/* ---- Force in, spikes out, as a whole. ---- */

/* Bits of corpuscle_simulation.flags. */
#define CORPUSCLE_BACKWARD_EULER 1u   /* the thesis's integration; default: exact */
#define CORPUSCLE_SAMPLED 2u          /* spikes have the times of samples, as in the thesis */
#define CORPUSCLE_SINGLE_PRECISION 4u /* float instead of double: faster, but spike times change */

/* The subject of a run and its options, each text as on the command line. 0 or NULL is the default of each member except `size`. */
typedef struct corpuscle_simulation {
    size_t size;                 /* sizeof(corpuscle_simulation) */
    const char* afferents;       /* on every channel: "sa1,fa1", the default; not used with a population */
    const char* population;      /* a skin: "hand", "fingertip", "grid 8x8" or a file; default: afferents on channels */
    const char* contact;         /* how one channel presses a skin: "flat", "sphere", "edge", "grating" */
    const char* taxels;          /* path of the layout of the taxels that the channels are (doc/taxels.md) */
    const char* const* settings; /* "sa1.f_B=25Hz", "contact.radius=5mm" */
    size_t setting_count;
    const char* const* spreads; /* how copies vary: "sa1.f_B=10%" */
    size_t spread_count;
    uint64_t seed;                                /* of all random numbers */
    double noise;                                 /* A, of the current of each afferent */
    uint32_t copies;                              /* of each afferent; 0: the afferents themselves */
    uint32_t threads;                             /* 0: one for each core; the response does not depend on it */
    uint32_t flags;                               /* CORPUSCLE_SAMPLED ... */
    uint32_t unused;                              /* 0 */
    int (*progress)(void* user, double fraction); /* called with the completed fraction, 0 to 1; a result other than 0 stops the run */
    void* user;
} corpuscle_simulation;

/* The spikes of all afferents of a run. */
typedef struct corpuscle_response corpuscle_response;

/* Simulates a force in memory: `force[sample * channels + channel]`, N. A NULL simulation is that of "sa1,fa1". */
CORPUSCLE_API corpuscle_response* corpuscle_respond(const double* force, size_t samples, size_t channels, double rate_hz,
                                                    const corpuscle_simulation* simulation);
CORPUSCLE_API corpuscle_response* corpuscle_respond_force(const corpuscle_force* force, const corpuscle_simulation* simulation);
/* The same under a stimulus or a named touch of a skin ("press", "stroke"). `rate_hz` 0: 10 kHz on channels, 1 kHz in a skin. */
CORPUSCLE_API corpuscle_response* corpuscle_respond_stimulus(const char* name, double rate_hz, const corpuscle_simulation* simulation);
CORPUSCLE_API void corpuscle_response_destroy(corpuscle_response* response); /* NULL is allowed */

CORPUSCLE_API size_t corpuscle_response_spikes(const corpuscle_response* response);           /* number of spikes */
CORPUSCLE_API const double* corpuscle_response_times(const corpuscle_response* response);     /* of each spike, s, in order */
CORPUSCLE_API const uint32_t* corpuscle_response_indices(const corpuscle_response* response); /* of each spike's afferent */
CORPUSCLE_API size_t corpuscle_response_afferents(const corpuscle_response* response);        /* number of afferents */
CORPUSCLE_API const char* corpuscle_response_afferent_name(const corpuscle_response* response, size_t index);    /* "sa1", "sa1#17" */
CORPUSCLE_API const char* corpuscle_response_afferent_type(const corpuscle_response* response, size_t index);    /* without the number */
CORPUSCLE_API const char* corpuscle_response_afferent_channel(const corpuscle_response* response, size_t index); /* of a skin: its region */
/* Position in a skin, m: x to the right, y away from the wrist; NaN on channels. Returns CORPUSCLE_OK, or a code. */
CORPUSCLE_API int corpuscle_response_afferent_position(const corpuscle_response* response, size_t index, double* x, double* y);
CORPUSCLE_API double corpuscle_response_start(const corpuscle_response* response);                    /* s, of the force */
CORPUSCLE_API double corpuscle_response_duration(const corpuscle_response* response);                 /* s */
CORPUSCLE_API const char* corpuscle_response_note(const corpuscle_response* response, size_t number); /* as for a force */
CORPUSCLE_API const char* corpuscle_response_warning(const corpuscle_response* response, size_t number);
CORPUSCLE_API const char* corpuscle_response_summary(corpuscle_response* response); /* the JSON text of summary.json: every measure */

/* ---- A live skin: one frame at a time (doc/live.md). After its creation, a frame costs no memory and no lock. ---- */

typedef struct corpuscle_skin corpuscle_skin;

typedef struct corpuscle_spike {
    double time;       /* s; the first frame is at time 0 */
    uint32_t afferent; /* index of the afferent, from 0; corpuscle_afferent_name gives its name */
    uint32_t address;  /* the afferent's address in event files (doc/events.md) */
} corpuscle_spike;

/* Called for each spike, in time order. `user` is the pointer that was passed together with the sink. It must not throw or call longjmp. */
typedef void (*corpuscle_sink)(void* user, const corpuscle_spike* spike);

/* `population` is "hand", "fingertip", "grid 8x8", a population file, or afferents by name ("sa1,fa1"). `rate_hz` is in frames per second.
 * Afferents by name are created on each of `channels` channels; other populations ignore `channels`. */
CORPUSCLE_API corpuscle_skin* corpuscle_create(const char* population, double rate_hz, size_t channels);
/* The same, with `settings`, an array of `count` parameter settings such as "sa1.f_B=25Hz". */
CORPUSCLE_API corpuscle_skin* corpuscle_create_with(const char* population, double rate_hz, size_t channels, const char* const* settings,
                                                    size_t count);
/* The same, but frames are the forces of taxels, which the file `taxels` lays out on the skin (doc/taxels.md). */
CORPUSCLE_API corpuscle_skin* corpuscle_create_taxels(const char* population, const char* taxels, double rate_hz,
                                                      const char* const* settings, size_t count);
CORPUSCLE_API void corpuscle_destroy(corpuscle_skin* skin); /* NULL is allowed */

CORPUSCLE_API size_t corpuscle_frame_size(const corpuscle_skin* skin); /* number of forces in a frame: of the taxels, or of the sites */
CORPUSCLE_API size_t corpuscle_sites(const corpuscle_skin* skin);      /* number of sites of the skin */
CORPUSCLE_API const char* corpuscle_site_name(const corpuscle_skin* skin, size_t site); /* such as "r1c2"; sites count from 0 */
/* Position of a site in metres: x to the right, y away from the wrist. Returns CORPUSCLE_OK, or a code. */
CORPUSCLE_API int corpuscle_site_position(const corpuscle_skin* skin, size_t site, double* x, double* y);
CORPUSCLE_API size_t corpuscle_afferents(const corpuscle_skin* skin);                          /* number of afferents */
CORPUSCLE_API const char* corpuscle_afferent_name(const corpuscle_skin* skin, uint32_t index); /* "sa1#17" */

/* Simulates one frame: one force (N) for each site, or taxel; `sites` is the number of forces. Spikes that arrive during this frame, after
 * their conduction delay, are passed to `sink`, which may be NULL. Returns CORPUSCLE_OK, or a code. */
CORPUSCLE_API int corpuscle_push(corpuscle_skin* skin, const double* frame, size_t sites, corpuscle_sink sink, void* user);
/* Call after the last frame: passes the spikes that are still travelling along the nerve to `sink`. Returns CORPUSCLE_OK, or a code. */
CORPUSCLE_API int corpuscle_finish(corpuscle_skin* skin, corpuscle_sink sink, void* user);

/* Writes the state into `bytes`, a buffer of `size` bytes. Returns the number of bytes needed, or 0 on failure. If `bytes` is NULL,
 * nothing is written, and only the number is returned. A buffer that is too small is a failure. */
CORPUSCLE_API size_t corpuscle_save(corpuscle_skin* skin, void* bytes, size_t size);
/* Restores a saved state. The skin must have been created with the same arguments. Returns CORPUSCLE_OK, or a code. */
CORPUSCLE_API int corpuscle_resume(corpuscle_skin* skin, const void* bytes, size_t size);

#ifdef __cplusplus
}
#endif
#endif
