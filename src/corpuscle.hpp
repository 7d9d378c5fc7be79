#pragma once
// The library's face: name an afferent, hand it force, get spikes. Errors are exceptions here, and only here.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace corpuscle {

/// Thrown by the functions of this header; what() is the sentence, with file, line and column if there are some.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Force over time, evenly sampled.
struct Touch {
    double rate = 10e3;         ///< Hz
    std::vector<double> force;  ///< N, one value a sample
};

/// A stimulus by name, or a sum ("press+noise"), with settings such as "press.F_max=2N". Throws Refused.
Touch stimulus(const std::string& name, const std::vector<std::string>& settings = {}, double rate = 10e3, std::uint64_t seed = 0);

/// What an afferent answered.
struct Response {
    std::vector<double> spikes;         ///< s, in order; sample 0 is at 0 s
    std::vector<double> rates() const;  ///< Hz, 1 / (t[k+1] - t[k]) at spike k (thesis 3.3); one fewer than spikes
};

/// All of one touch through one afferent ("sa1", "sa1b+izhikevich"), with settings such as "sa1.f_B=25Hz". Throws Refused.
Response respond(const std::string& afferent, const Touch&, const std::vector<std::string>& settings = {});

/// A skin that answers as force comes, frame by frame: for robots (doc/live.md). Once made it asks for no memory and takes no lock; the
/// same frames give the same spikes as a recording answered as a whole. To be used by one thread at a time.
class LiveSkin {
public:
    struct Event {
        double time = 0;            ///< s; the first frame is at 0
        std::uint32_t unit = 0;     ///< which afferent: name(unit)
        std::uint32_t address = 0;  ///< of it (doc/events.md)
    };

    /// Where a force of a frame is felt; m, x to the right and y away from the wrist.
    struct Site {
        std::string name;  ///< "r1c2", "index.tip.17"
        double x = 0, y = 0;
    };

    /// "hand", "fingertip", "grid 8x8", a population file; or afferents by name ("sa1,fa1"), each on all of so many channels; with settings
    /// of its classes such as "sa1.f_B=25Hz". Throws Refused, and so do the rest.
    explicit LiveSkin(const std::string& population, double rate = 1e3, std::size_t channels = 1,
                      const std::vector<std::string>& settings = {});
    LiveSkin(LiveSkin&&) noexcept;
    LiveSkin& operator=(LiveSkin&&) noexcept;
    ~LiveSkin();

    std::size_t sites() const;                   ///< forces of a frame
    Site site(std::size_t number) const;         ///< which is force `number` of a frame, from 0
    std::size_t units() const;                   ///< afferents
    std::int64_t frames() const;                 ///< answered so far
    std::string name(std::uint32_t unit) const;  ///< "sa1#17"

    /// One force (N) a site; sink(event) is called for each spike that arrives in this frame, in order.
    template <class Sink>
    void push(std::span<const double> frame, Sink&& sink) {
        for (const auto& e : answer(frame)) sink(e);
    }
    /// The same as a list, valid until the next call.
    std::span<const Event> answer(std::span<const double> frame);
    /// At the end of it all: spikes still on their way to where the nerve is listened to.
    std::span<const Event> last();

    /// Where it stands; one made alike goes on from there.
    std::vector<std::byte> save() const;
    void resume(std::span<const std::byte>);

private:
    struct Held;
    std::unique_ptr<Held> held_;
};

}  // namespace corpuscle
