#pragma once
// The skin of a session: its afferents, and the indenter that presses it.

#include <atomic>

#include "page/object_reader.hpp"
#include "skin/contact/contact.hpp"

namespace corpuscle::page {

/// A skin as a request names it.
struct SkinRequest {
    std::string population;            ///< "fingertip", "hand", "grid 8x8"
    std::vector<std::string> set;      ///< "sa1.f_B=25Hz"
    std::string indenter;              ///< "sphere"
    std::vector<std::string> contact;  ///< "radius=5mm"
};
Result<SkinRequest> read_skin_request(ObjectReader&);

class PressedSkin {
    std::string population_, indenter_;
    std::unique_ptr<Skin> skin_;
    std::unique_ptr<Contact> contact_;
    std::vector<std::string> warnings_;
    Position middle_;           // of the first region, where the contact is in the beginning
    std::int64_t samples_ = 0;  // that were simulated

public:
    static Result<PressedSkin> make(const SkinRequest&, const SimulationOptions&, const Clock&);

    const Innervation& innervation() const { return skin_->innervation(); }
    std::size_t afferents() const { return innervation().afferents.size(); }
    const Position& middle() const { return middle_; }
    const Contact& contact() const { return *contact_; }
    std::int64_t samples() const { return samples_; }                    ///< that were simulated
    std::span<const std::string> warnings() const { return warnings_; }  ///< of make()

    /// Adds the description of the skin, and its arrays, to an answer. `first_unit`: unit number of the first afferent.
    void describe(MessageWriter& answer, std::size_t first_unit) const;
    /// The parameters that can be set for this indenter: [{"name", "value"}].
    Json contact_parameters() const;
    /// Replaces the indenter.
    Result<void> change_contact(const std::string& indenter, std::span<const std::string> set, const Clock&);
    /// Simulates a block of any length. Appends the spikes; afferent indexes are increased by `first_unit`. Ends with an error when
    /// `is_stopped`. After an error of a part of the block, the parts before it have been simulated.
    Result<void> press(const ContactForce&, const std::atomic<bool>& is_stopped, std::uint32_t first_unit, std::vector<Spike>&);
};

}  // namespace corpuscle::page
