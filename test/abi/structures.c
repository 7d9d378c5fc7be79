/* The layout of the structures of corpuscle.h on 64-bit systems. A member may be added at the end of corpuscle_simulation, with a line here.
 * No other line may change: programs that are in use depend on it. */

#include <corpuscle.h>

#define AT(type, member, offset) _Static_assert(offsetof(type, member) == (offset), #type "." #member " has moved")

AT(corpuscle_simulation, size, 0);
AT(corpuscle_simulation, afferents, 8);
AT(corpuscle_simulation, population, 16);
AT(corpuscle_simulation, contact, 24);
AT(corpuscle_simulation, taxels, 32);
AT(corpuscle_simulation, settings, 40);
AT(corpuscle_simulation, setting_count, 48);
AT(corpuscle_simulation, spreads, 56);
AT(corpuscle_simulation, spread_count, 64);
AT(corpuscle_simulation, seed, 72);
AT(corpuscle_simulation, noise, 80);
AT(corpuscle_simulation, copies, 88);
AT(corpuscle_simulation, threads, 92);
AT(corpuscle_simulation, flags, 96);
AT(corpuscle_simulation, unused, 100);
AT(corpuscle_simulation, progress, 104);
AT(corpuscle_simulation, user, 112);
_Static_assert(sizeof(corpuscle_simulation) == 120, "a new member needs a line above");

AT(corpuscle_spike, time, 0);
AT(corpuscle_spike, afferent, 8);
AT(corpuscle_spike, address, 12);
_Static_assert(sizeof(corpuscle_spike) == 16, "corpuscle_spike has no size of its own, so it cannot grow");

_Static_assert(CORPUSCLE_OK == 0 && CORPUSCLE_BAD_INPUT == -1 && CORPUSCLE_BAD_CALL == -2 && CORPUSCLE_NOT_CONVERGED == -3 &&
                   CORPUSCLE_OUT_OF_MEMORY == -4 && CORPUSCLE_STOPPED == -5,
               "codes are kept");
_Static_assert(CORPUSCLE_BACKWARD_EULER == 1 && CORPUSCLE_SAMPLED == 2 && CORPUSCLE_SINGLE_PRECISION == 4, "flags are kept");
