#pragma once
// A skin with its afferents placed: which unit is where, of which class, and which sites it feels.

#include <memory>

#include "skin/plan.hpp"

namespace corpuscle {

/// One afferent in the skin.
struct SkinUnit {
    std::uint32_t of = 0;    ///< its class
    std::uint32_t copy = 0;  ///< its number in the class, from 1: "sa1#17"
    std::uint32_t region = 0;
    Position at = {};  ///< m
    double delay = 0;  ///< s that a spike takes to where the nerve is listened to
};

/// The sites that a class feels, site by site: entries [begin[s], begin[s + 1]) say which units feel site s, and how much of its force.
/// Units are counted from the class's first; rising in each site.
struct ReceptiveFields {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> unit;
    std::vector<double> weight;
    bool operator==(const ReceptiveFields&) const = default;
};

struct Innervation {
    SkinPlan plan;
    std::vector<SkinUnit> units;                    ///< class after class; within one neighbours stand close together
    std::vector<std::size_t> first;                 ///< of each class; behind the last the end
    std::vector<ReceptiveFields> fields;            ///< of each class
    std::string unit_name(std::size_t unit) const;  ///< "sa1#17"
};

/// How many units of a class each region has.
std::vector<std::uint64_t> units_by_region(const SkinPlan&, std::uint32_t of);

/// Places a plan's units: where each stands, what it feels. The same for the same plan, on every machine. Refuses a skin without
/// units and one of more than 2^24.
Result<std::shared_ptr<const Innervation>> innervate(SkinPlan);

}  // namespace corpuscle
