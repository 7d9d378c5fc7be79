#pragma once
// The built-in hand at the first contact of a sphere, and while a rough surface slides over it.

#include <string>
#include <vector>

#include "reproduction/skin/skin_touch.hpp"

namespace corpuscle {

/// How a sphere of 5 mm radius meets the skin: its force, N, rises linearly from 0.
inline constexpr double contact_rise = 5e-3, contact_felt_within = 40e-3;   // s; from the contact to a spike that counts
inline constexpr double contact_under = 2e-3, contact_near_radius = 30e-3;  // m: an afferent this close is under the sphere, or near it

/// The afferents that fire at a contact, as fractions of the afferents at this distance.
struct ContactResponse {
    double fa1_under = 0, fa2_near = 0, fa2_hand = 0;  ///< FA-I under the sphere; FA-II near it; all FA-II
    double fa1_latency = 0, fa2_latency = 0;           ///< s, median over the FA-I under it and the FA-II near it that fire
    std::size_t fa1_count = 0, fa2_count = 0;          ///< number of FA-I under it and FA-II near it
};
/// The response to a force (N) in the middle of a region of the hand ("index.tip").
Result<ContactResponse> measure_contact(const std::shared_ptr<const Innervation>& hand, const std::string& region, double force);

/// Spikes of one class while a surface slides over the hand.
struct SlidingResponse {
    std::string afferent;        ///< name of the class: "sa1"
    double spikes = 0;           ///< during 1.5 s of the movement
    double rate = 0;             ///< Hz, the mean of all afferents of the class in the hand
    double silent_fraction = 0;  ///< of the bins of 20 ms, those without a spike of the class
};
/// The touch `texture`, with a surface of this roughness. Returns each class of the hand.
Result<std::vector<SlidingResponse>> measure_sliding(const std::shared_ptr<const Innervation>& hand, double roughness);

}  // namespace corpuscle
