/* Force in, spikes out, in C: two afferents on a force of your own. */

#include <corpuscle.h>
#include <stdio.h>

int main(void) {
    double force[1000]; /* N, 1 s at 1 kHz: a press of 2 N that rises within 0.1 s */
    for (int k = 0; k < 1000; ++k) force[k] = k < 100 ? 0.02 * k : 2;

    const char* settings[] = {"sa1-nerve.V_th=450mV"};
    corpuscle_simulation simulation = {
        .size = sizeof simulation, .afferents = "sa1-nerve,fa1-nerve", .settings = settings, .setting_count = 1};
    corpuscle_response* response = corpuscle_respond(force, 1000, 1, 1000, &simulation);
    if (!response) return puts(corpuscle_error()), 1;

    const double* times = corpuscle_response_times(response);
    const uint32_t* afferents = corpuscle_response_indices(response);
    const size_t spikes = corpuscle_response_spikes(response);
    for (size_t k = 0; k < spikes; ++k) printf("%.4f s %s\n", times[k], corpuscle_response_afferent_name(response, afferents[k]));
    corpuscle_response_destroy(response);
    return spikes == 0;
}
