#pragma once
// A skin with its afferents placed: the position and class of each, and the sites in its receptive field.

#include <memory>

#include "skin/skin_plan.hpp"

namespace corpuscle {

/// One afferent of a skin.
struct SkinAfferent {
    std::uint32_t class_index = 0;  ///< index of its class
    std::uint32_t number = 0;       ///< number within its class, from 1: "sa1#17"
    std::uint32_t region = 0;
    Position position = {};  ///< m
    double delay = 0;        ///< conduction delay to the recording point, s
};

/// The receptive fields of a class, site by site. Entries [begin[s], begin[s + 1]) are the afferents that respond to site s, and the
/// weights of its force. Afferents are counted from the first one of the class, and are in ascending order within each site.
struct ReceptiveFields {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> afferent;
    std::vector<double> weight;
    bool operator==(const ReceptiveFields&) const = default;
};

struct Innervation {
    SkinPlan plan;
    std::vector<SkinAfferent> afferents;                 ///< class after class; neighbours within a class are close together
    std::vector<std::size_t> class_begin;                ///< index of the first afferent of each class, then the total
    std::vector<ReceptiveFields> fields;                 ///< of each class
    std::string afferent_name(std::size_t index) const;  ///< "sa1#17"
};

/// Number of afferents of a class in each region.
std::vector<std::uint64_t> afferents_by_region(const SkinPlan&, std::uint32_t class_index);

/// Places the afferents of a plan and computes their receptive fields. The result for a plan is the same on every machine. Refuses a skin
/// without afferents and one with more than 2^24.
Result<std::shared_ptr<const Innervation>> innervate(SkinPlan);

}  // namespace corpuscle
