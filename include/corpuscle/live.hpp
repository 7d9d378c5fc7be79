#pragma once
// A live skin: one frame of force at a time.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// A simulated skin for robots: force frames in, spikes out, one frame at a time (doc/live.md). After construction push() and respond()
/// allocate no memory and take no lock. The spikes are the same as if the frames were simulated as one recording. It must not be used by
/// two threads at the same time.
class CORPUSCLE_API LiveSkin {
public:
    struct Event {
        double time = 0;                   ///< s; the first frame is at time 0
        std::uint32_t afferent_index = 0;  ///< index of the afferent, from 0; afferent_name() gives its name
        std::uint32_t address = 0;         ///< the afferent's address in event files (doc/events.md)
    };

    /// The point of the skin to which one force of a frame applies. Coordinates in m, x to the right and y away from the wrist.
    struct Site {
        std::string name;  ///< "r1c2", "index.tip.17"
        double x = 0, y = 0;
    };

    /// `population` is "hand", "fingertip", "grid 8x8", a population file, or afferents by name ("sa1,fa1"). `rate` is in
    /// frames per second. Afferents by name are created on each of `channels` channels; other populations ignore `channels`.
    /// `settings` are parameters such as "sa1.f_B=25Hz". Throws InputError, as do the other members.
    explicit LiveSkin(const std::string& population, double rate = 1e3, std::size_t channels = 1,
                      const std::vector<std::string>& settings = {});
    /// A skin whose frames are the forces of taxels, which a file lays out on it (doc/taxels.md). The order of the forces is that of the
    /// taxels in the file, or of its channel numbers; if the file has axes, there are three for each taxel. Throws InputError.
    static LiveSkin with_taxels(const std::string& population, const std::string& taxels, double rate = 1e3,
                                const std::vector<std::string>& settings = {});
    LiveSkin(LiveSkin&&) noexcept;
    LiveSkin& operator=(LiveSkin&&) noexcept;
    ~LiveSkin();

    std::size_t frame_size() const;                        ///< number of forces in a frame: of the taxels, or of the sites
    std::size_t sites() const;                             ///< number of sites of the skin
    Site site(std::size_t number) const;                   ///< site with this number, from 0; without taxels, of this force in a frame
    std::size_t afferents() const;                         ///< number of afferents
    std::int64_t frames() const;                           ///< frames simulated so far
    std::string afferent_name(std::uint32_t index) const;  ///< "sa1#17"

    /// Simulates one frame: one force (N) for each site, or taxel. Calls sink(event), in order, for each spike that arrives, after its
    /// conduction delay, during this frame.
    template <class Sink>
    void push(std::span<const double> frame, Sink&& sink) {
        for (const auto& e : respond(frame)) sink(e);
    }
    /// The same, but returns the events as a list that is valid until the next call.
    std::span<const Event> respond(std::span<const double> frame);
    /// Call after the last frame: returns the spikes that are still travelling along the nerve; the list is valid until the next call.
    std::span<const Event> finish();

    /// The state as bytes.
    std::vector<std::byte> save() const;
    /// Restores a saved state. The LiveSkin must have been constructed with the same arguments.
    void resume(std::span<const std::byte>);

private:
    struct Impl;
    explicit LiveSkin(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

}  // namespace corpuscle
