// How long after a frame of forces do its spikes come from `corpuscle stream`, how much of a core does this take, and is it stable over
// time?
//   bench-live MODE [SECONDS [PROGRAM [POPULATION]]]
// - delay: "grid 64x64" (4096 sites, 8192 afferents) at 5.2 kHz, the densest published skin: 2.1e7 forces per second
// - sleep: as delay, without --busy-poll: the program, the sender and the reader sleep until a frame comes
// - share: "hand" (17,000 afferents) at 1 kHz under a stroke: the fraction of a core that the program uses
// - together: as share, with --batch-frames 16, over loopback: the program sleeps until 16 frames have arrived
// - noise: as share, with noise that keeps every afferent active
// - soak: "grid 16x16" at 1 kHz over loopback, frames numbered: memory, drift, lost events
//
// Defaults: 60 s (3600 s are recommended for soak) and ./corpuscle. POPULATION replaces that of the mode; soak has no other. PROGRAM is run
// as `PROGRAM stream`, on the last core only; it is called "the program" here. The sender of the frames and the reader of the spikes are
// threads of this process, on the other cores.
//
// In the mode delay, the program (--busy-poll) and the sender busy-wait, which excludes the time to wake a thread.
// In all modes but soak, frames are binary float32 through a pipe, or through TCP in the mode together. Each is written at its scheduled
// time (clock_nanosleep to absolute times). Events are binary through another pipe. The delay of a frame is from just before its write to
// the read of its first spike. The table of delays omits frames without a spike. The program measures the time of every frame itself, and
// prints the number of frames and these times before it exits. For comparison, an idle loop runs first, as long as the measurement: a
// thread sleeps until scheduled times of the same rate and records how late it wakes, which is the machine's own delay. A round contact
// moves over the skin, and every site has noise of some mN in every frame, so that no afferent can be skipped. In the modes share and
// together there is no noise, and the contact is a fingertip that rubs the palm in circles of 1 cm. The fraction of a core (user and system
// time) excludes the first 3 s, in which the program builds its skin. The mode soak compares every received byte with the result of the
// same frames in this process.

#include <sys/prctl.h>
#include <sys/socket.h>
#include <csignal>

#include "live/latency_histogram.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"
#include "live_program.hpp"

namespace {

using namespace corpuscle;

constexpr int start_up = 3;  // s in which the program builds its skin and warms up

/// A row of the table: number of delays, their quantiles and maximum (us), and the percentage of delays below 1 ms.
std::string row(const char* name, const LatencyHistogram& d) {
    std::uint64_t within = 0;
    for (int b = 0; b < LatencyHistogram::bin_count() && LatencyHistogram::end_of(b) <= 1'000'000; ++b) within += d.count_in(b);
    const auto us = [&](double q) { return static_cast<double>(d.quantile(q)) * 1e-3; };
    return fmt::format("{:28} {:9} {:8.1f} {:8.1f} {:8.1f} {:9.1f}   {:.4f} %\n", name, d.count(), us(0.5), us(0.99), us(0.999),
                       static_cast<double>(d.max()) * 1e-3,
                       100 * static_cast<double>(within) / static_cast<double>(std::max<std::uint64_t>(1, d.count())));
}

/// Both histograms, in bins of one octave, as percentages of their counts.
void print_histograms(const LatencyHistogram& idle, const LatencyHistogram& delay) {
    fmt::print("\n  up to us     idle %    delay %\n");
    std::uint64_t a = 0, b = 0;
    std::int64_t edge = 1024;  // ns
    for (int k = 0; k < LatencyHistogram::bin_count(); ++k) {
        a += idle.count_in(k), b += delay.count_in(k);
        if (LatencyHistogram::end_of(k) < edge) continue;
        if (a + b > 0)
            fmt::print("{:10.1f} {:10.4f} {:10.4f}\n", static_cast<double>(edge) * 1e-3,
                       100 * static_cast<double>(a) / static_cast<double>(idle.count()),
                       100 * static_cast<double>(b) / static_cast<double>(std::max<std::uint64_t>(1, delay.count())));
        a = b = 0, edge *= 2;
    }
}

/// Delays (ns) with which this thread wakes at its scheduled times, `rate` per second, without other work.
LatencyHistogram idle_loop(int rate, int seconds) {
    LatencyHistogram late;
    const auto begin = steady_now() + 10'000'000;
    for (std::int64_t k = 0; k < std::int64_t{rate} * seconds; ++k) {
        const auto due = begin + k * 1'000'000'000 / rate;
        sleep_until(due);
        late.add(steady_now() - due);
    }
    return late;
}

std::shared_ptr<const Innervation> skin_of(const std::string& population) {
    auto plan = make_live_plan(population, 1);
    auto skin = plan ? innervate(std::move(plan->result)) : Result<std::shared_ptr<const Innervation>>(plan.error());
    if (!skin) fmt::print("{}\n", skin.error().text()), std::exit(1);
    return *skin;
}

/// All modes but soak. `rate` is in Hz. contact_radius (m), noise and circle_radius (m) are those of frames_of_a_second(). With
/// `batch_frames` above 1, frames come over TCP, and the program gets --batch-frames.
int measure_delay(const std::string& program, const std::string& population, int rate, int seconds, double contact_radius, bool busy_poll,
                  bool noise, int batch_frames = 1, double circle_radius = 0) {
    const auto skin = skin_of(population);
    const auto sites = skin->plan.sites.size();
    const auto header = (*make_event_format("aer", make_event_addressing(*skin, {rate, 1})))->header().size();
    const auto frames = frames_of_a_second(skin->plan, rate, contact_radius, noise, circle_radius);
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    if (cores > 1) bind_to(0, cores - 2);
    const auto idle = idle_loop(rate, seconds);
    const std::int64_t count = std::int64_t{rate} * seconds;
    std::vector<std::string> arguments = {"--population", population, "--rate",   fmt::format("{}Hz", rate),
                                          "--frames",     "f32",      "--format", "aer"};
    if (busy_poll) arguments.push_back("--busy-poll");
    if (batch_frames > 1)
        arguments.insert(arguments.end(), {"--batch-frames", std::to_string(batch_frames), "--in", "tcp:0", "--clients", "1"});
    Program child(program, arguments, cores - 1);
    if (batch_frames > 1) child.in = connect_to(child);
    double processor_seconds_at_start = 0;
    std::thread watch([&] {
        std::this_thread::sleep_for(std::chrono::seconds(start_up));
        processor_seconds_at_start = child.processor_seconds();
    });
    Sender sender(frames, sites, rate, count, false);
    LatencyHistogram delay;
    std::int64_t last = 0, spikes = 0;  // last: step of the last spike read
    EventReader reader(child.out.get(), header, [&](const address_events::EncodedSpike& spike, std::int64_t now) {
        ++spikes;
        if (spike.step == last || spike.step >= count) return;
        last = spike.step;
        delay.add(now - sender.sent(spike.step));
    });
    if (busy_poll) {
        ::fcntl(child.out.get(), F_SETFL, O_NONBLOCK);
        for (std::int64_t k = 0; k < count; ++k) {
            while (steady_now() < sender.due(k)) reader.read();
            sender.send(child.in.get(), k);
        }
        ::fcntl(child.out.get(), F_SETFL, 0);  // the last reads block
        child.in.close();
        while (reader.read()) {
        }
    } else {
        std::thread sending([&] { sender.send_all(child.in.get()), child.in.close(); });
        while (reader.read()) {
        }
        sending.join();
    }
    const auto summary = child.read_output(child.err.get());
    const int status = child.wait();
    watch.join();
    fmt::print("{}: {} sites, {} afferents, {} frames of {} Hz sent, {} spikes read\n\n{:28} {:>9} {:>8} {:>8} {:>8} {:>9}   within 1 ms\n",
               population, sites, skin->afferents.size(), count, rate, spikes, "us", "number", "50 %", "99 %", "99.9 %", "longest");
    fmt::print("{}{}", row("idle loop, late", idle), row("frame written to spike read", delay));
    print_histograms(idle, delay);
    fmt::print(
        "\nSummary of the program (status {}):\n{}\nIt used {:.2f} % of one core after the first {} s, and {:.2f} s in total of {} s; "
        "{} MB at peak.\n",
        status, summary, 100 * (child.final_processor_seconds() - processor_seconds_at_start) / std::max(1, seconds - start_up), start_up,
        child.final_processor_seconds(), seconds, child.used.ru_maxrss / 1024);
    return status;
}

/// Resident memory of a process.
std::int64_t resident_kB(pid_t pid) {
    std::ifstream in(fmt::format("/proc/{}/statm", pid));
    std::int64_t size = 0, resident = 0;
    in >> size >> resident;
    return resident * ::sysconf(_SC_PAGESIZE) / 1024;
}

int soak(const std::string& program, int seconds) {
    constexpr int rate = 1000;
    const auto skin = skin_of("grid 16x16");
    const auto sites = skin->plan.sites.size();
    const auto format = make_event_format("aer", make_event_addressing(*skin, {rate, 1}));
    const auto frames = frames_of_a_second(skin->plan, rate, 8e-3, true);
    Endpoint endpoint;
    auto listener = open_listening_socket(endpoint);
    Program child(program,
                  {"--population", "grid 16x16", "--rate", "1kHz", "--frames", "f32", "--stamp", "sequence", "--format", "aer", "--in",
                   "tcp:0", "--clients", "1", "--to", std::to_string(endpoint.port)},
                  static_cast<int>(std::thread::hardware_concurrency()) - 1);
    pollfd wait = {listener->get(), POLLIN, 0};
    ::poll(&wait, 1, 10000);
    Descriptor events(::accept(listener->get(), nullptr, nullptr));
    auto to = connect_to(child);
    const std::int64_t count = std::int64_t{rate} * seconds;
    Sender sender(frames, sites, rate, count, true);
    std::thread sending([&] { sender.send_all(to.get()), to.close(); });
    // This process simulates the same frames. expected[at] is the next event to receive; if all expected events have been received,
    // simulate_to() goes on until a frame has spikes, at most to the given step.
    auto reference = SkinStream::make(skin, {rate, 1});
    std::vector<double> frame(sites);
    std::vector<address_events::EncodedSpike> expected;
    std::size_t at = 0;
    const auto simulate_to = [&](std::int64_t step) {
        while (at == expected.size() && (*reference)->frames() < std::min(count, step + 1)) {
            const auto* from = frames.data() + static_cast<std::size_t>((*reference)->frames() % rate) * sites;
            std::copy_n(from, sites, frame.begin());
            expected.clear(), at = 0;
            const auto spikes_here = (*reference)->push(frame);
            for (const auto& s : *spikes_here) {
                address_events::EncodedSpike packed;
                (*format)->write(s, reinterpret_cast<char*>(&packed));
                expected.push_back(packed);
            }
        }
    };
    std::vector<LatencyHistogram> minutes(static_cast<std::size_t>(seconds) / 60 + 1);  // delays of each minute
    std::int64_t spikes = 0, wrong = 0, next_report = 0, last = -1;
    EventReader reader(events.get(), (*format)->header().size(), [&](const address_events::EncodedSpike& spike, std::int64_t now) {
        simulate_to(spike.step);
        wrong += at == expected.size() || std::memcmp(&expected[at], &spike, sizeof spike) != 0;
        ++spikes, at += at < expected.size();
        if (spike.step != last && spike.step < count)
            minutes[static_cast<std::size_t>(spike.step / rate / 60)].add(now - sender.sent(spike.step));
        last = spike.step;
        if (spike.step < next_report) return;
        fmt::print("{:6} s  {:9} events  {:6} kB resident\n", spike.step / rate, spikes, resident_kB(child.pid));
        std::fflush(stdout);
        next_report += std::max(10, seconds / 12) * rate;
    });
    while (reader.read()) {
    }
    sending.join();
    simulate_to(count);
    const auto summary = child.read_output(child.err.get());
    const int status = child.wait();
    fmt::print("\n{:28} {:>9} {:>8} {:>8} {:>8} {:>9}   within 1 ms\n", "us", "number", "50 %", "99 %", "99.9 %", "longest");
    fmt::print("{}{}", row("first minute", minutes.front()),
               row("last complete minute", minutes[minutes.size() > 1 ? minutes.size() - 2 : 0]));
    fmt::print("\n{} events, {} wrong, {} missing at the end; status {}\n{}", spikes, wrong, expected.size() - at, status, summary);
    return wrong != 0 || at != expected.size() ? 1 : status;
}

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);
    ::prctl(PR_SET_TIMERSLACK, 1);  // ns; new threads inherit it
    const std::string mode = argc > 1 ? argv[1] : "";
    const int seconds = argc > 2 ? std::atoi(argv[2]) : 60;
    const std::string program = argc > 3 ? argv[3] : "./corpuscle";
    const auto population = [&](const char* usual) { return std::string(argc > 4 ? argv[4] : usual); };
    if (mode == "delay") return measure_delay(program, population("grid 64x64"), 5200, seconds, 12e-3, true, true);
    if (mode == "sleep") return measure_delay(program, population("grid 64x64"), 5200, seconds, 12e-3, false, true);
    if (mode == "share") return measure_delay(program, population("hand"), 1000, seconds, 4e-3, false, false, 1, 5e-3);
    if (mode == "together") return measure_delay(program, population("hand"), 1000, seconds, 4e-3, false, false, 16, 5e-3);
    if (mode == "noise") return measure_delay(program, population("hand"), 1000, seconds, 12e-3, false, true);
    if (mode == "soak") return soak(program, seconds);
    return fmt::print("bench-live delay|sleep|share|together|noise|soak [SECONDS [PROGRAM [POPULATION]]]\n"), 2;
}
