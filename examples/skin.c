/* A live skin in C: an SA-I and an FA-I afferent on each of four channels at 1 kHz, pressed for half a second. */

#include <corpuscle.h>
#include <stdio.h>

static void count(void* user, const corpuscle_spike* spike) {
    (void)spike;
    ++*(long*)user;
}

int main(void) {
    corpuscle_skin* skin = corpuscle_create("sa1,fa1", 1000, 4);
    if (!skin) return puts(corpuscle_error()), 1;
    long spikes = 0;
    for (int k = 0; k < 600; ++k) {
        double force = k < 100 ? 0 : 1.5; /* N */
        double frame[4] = {force, force, force / 2, 0};
        if (corpuscle_push(skin, frame, corpuscle_sites(skin), count, &spikes) != CORPUSCLE_OK) return puts(corpuscle_error()), 1;
    }
    printf("%ld spikes of %zu afferents, the first of them %s\n", spikes, corpuscle_afferents(skin), corpuscle_afferent_name(skin, 0));
    corpuscle_destroy(skin);
    return spikes == 0;
}
