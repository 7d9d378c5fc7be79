// The response of a slowly adapting afferent to the thesis's press. One parameter of the stimulus and one of the afferent are changed.

#include <corpuscle.hpp>
#include <cstdio>

int main() {
    const auto press = corpuscle::stimulus("press", {"press.F_max=2N"});
    const auto response = corpuscle::respond("sa1", press, {"sa1.f_B=25Hz"});
    for (const double t : response.times) std::printf("%.4f s\n", t);
    return response.times.empty();
}
