// Once a live skin is made, it asks for no memory: whatever comes, nothing is allocated while frames are pushed. A program of its own, for
// it counts in the place of operator new.

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "io/events.hpp"
#include "live/frame_decoder.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"

namespace {
std::atomic<long> asked = 0;

void* counted(std::size_t size, std::size_t alignment) {
    ++asked;
    void* at = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (!at) throw std::bad_alloc();
    return at;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted(size, static_cast<std::size_t>(alignment)); }
void operator delete(void* at) noexcept { std::free(at); }
void operator delete(void* at, std::size_t) noexcept { std::free(at); }
void operator delete(void* at, std::align_val_t) noexcept { std::free(at); }
void operator delete(void* at, std::size_t, std::align_val_t) noexcept { std::free(at); }

int main() {
    using namespace corpuscle;
    const Clock clock{1000, 1};
    long all = 0;
    for (const char* population : {"grid 16x16", "sa1,fa1", "fingertip"}) {
        auto plan = make_live_plan(population, 16);
        if (!plan) return std::puts(plan.error().text().c_str()), 1;
        const auto skin = innervate(std::move(*plan));
        auto stream = SkinStream::make(*skin, clock);
        const double felt =
            (*skin)->plan.felt_area > 0 ? (*skin)->plan.sites.area / (*skin)->plan.felt_area : 1;  // N at a site that feel as 1 N
        const auto format = make_event_format("lines", make_event_afferents(**skin, clock));
        if (!stream || !format) return std::puts("refused"), 1;
        FrameDecoder decoder({FrameKind::f64, FrameStamp::none, (*stream)->sites()});
        std::vector<double> sent((*stream)->sites()), force((*stream)->sites());
        std::vector<char> event((*format)->max_bytes());
        long spikes = 0, bytes = 0;
        const long before = asked;
        for (int k = 0; k < 3000; ++k) {
            for (std::size_t s = 0; s < sent.size(); ++s) {
                const auto varied = static_cast<double>((s * 31 + 17 * static_cast<std::size_t>(k / 50)) % 300) * 0.01;
                sent[s] = felt * (k % 500 < 100 ? 0 : k % 7 == 0 ? 5 : varied);
            }
            const auto* const from = reinterpret_cast<const char*>(sent.data());
            const auto size = sent.size() * sizeof(double);
            for (std::size_t at = 0; at < size;) {
                const auto room = decoder.buffer();
                const auto count = std::min(room.size(), size - at);
                std::copy_n(from + at, count, room.data());
                decoder.add_bytes(count), at += count;
                for (; decoder.next() == FrameDecoder::Status::frame;) {
                    decoder.read_forces(force);
                    const auto pushed = (*stream)->push(force);
                    if (!pushed) return std::puts(pushed.error().text().c_str()), 1;
                    for (const auto& s : *pushed) bytes += static_cast<long>((*format)->write(s, event.data())), ++spikes;
                }
            }
        }
        const long times = asked - before;
        std::printf("%s: %ld spikes, %ld bytes, memory asked for %ld times\n", population, spikes, bytes, times);
        if (spikes == 0) return 1;
        all += times;
    }
    return all != 0;
}
