// A live skin allocates no memory while frames are pushed, for any forces. This is a separate program, because it replaces operator new to
// count allocations.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "io/spikes/events.hpp"
#include "live/input/frame_decoder.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"

namespace {
std::atomic<long> allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
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
    long total = 0;
    for (const char* population : {"grid 16x16", "sa1,fa1", "fingertip"}) {
        auto plan = make_live_plan(population, 16);
        if (!plan) return std::puts(plan.error().text().c_str()), 1;
        const auto skin = innervate(std::move(plan->result));
        auto stream = SkinStream::make(*skin, clock);
        const double full_force =
            (*skin)->plan.felt_area > 0 ? (*skin)->plan.sites.area / (*skin)->plan.felt_area : 1;  // N at every site: acts as 1 N
        const auto format = make_event_format("lines", make_event_addressing(**skin, clock));
        if (!stream || !format) return std::puts("refused"), 1;
        FrameDecoder decoder({FrameKind::f64, FrameStamp::none, (*stream)->sites()});
        std::vector<double> sent((*stream)->sites()), force((*stream)->sites());
        std::vector<char> event((*format)->max_bytes());
        long spikes = 0, bytes = 0;
        const long before = allocations;
        for (int k = 0; k < 3000; ++k) {
            for (std::size_t s = 0; s < sent.size(); ++s) {
                const auto varied = static_cast<double>((s * 31 + 17 * static_cast<std::size_t>(k / 50)) % 300) * 0.01;
                sent[s] = full_force * (k % 500 < 100 ? 0 : k % 7 == 0 ? 5 : varied);
            }
            const auto* const from = reinterpret_cast<const char*>(sent.data());
            const auto size = sent.size() * sizeof(double);
            for (std::size_t at = 0; at < size;) {
                const auto buffer = decoder.buffer();
                const auto count = std::min(buffer.size(), size - at);
                std::copy_n(from + at, count, buffer.data());
                decoder.add_bytes(count), at += count;
                for (; decoder.next() == FrameDecoder::Status::frame;) {
                    decoder.read_forces(force);
                    const auto pushed = (*stream)->push(force);
                    if (!pushed) return std::puts(pushed.error().text().c_str()), 1;
                    for (const auto& s : *pushed) bytes += static_cast<long>((*format)->write(s, event.data())), ++spikes;
                }
            }
        }
        const long times = allocations - before;
        std::printf("%s: %ld spikes, %ld bytes, %ld allocations\n", population, spikes, bytes, times);
        if (spikes == 0) return 1;
        total += times;
    }
    return total != 0;
}
