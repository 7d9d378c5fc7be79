// A robot's control loop at 1 kHz: the forces of 64 taxels go in, and their spikes come out within the same millisecond.

#include <chrono>
#include <corpuscle.hpp>
#include <cstdio>
#include <thread>

int main() {
    corpuscle::LiveSkin skin("grid 8x8", 1e3);
    std::vector<double> frame(skin.sites());  // N
    long spikes = 0;
    auto next = std::chrono::steady_clock::now();
    for (int k = 0; k < 500; ++k) {
        for (std::size_t s = 0; s < frame.size(); ++s) frame[s] = k < 100 ? 0 : s % 8 < 4 ? 1.5 : 0;  // a real robot reads its sensors here
        skin.push(frame, [&](const corpuscle::LiveSkin::Event& e) {
            if (spikes++ < 10) std::printf("%.4f s  %s\n", e.time, skin.afferent_name(e.afferent_index).c_str());
        });
        std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
    }
    std::printf("%ld spikes of %zu afferents\n", spikes, skin.afferents());
    return spikes == 0;
}
