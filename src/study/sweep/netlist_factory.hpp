#pragma once
// Makes the netlist variants of a sweep: fixed settings, varied parameters, and the source files, each read once.

#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "circuit/netlist_overrides.hpp"
#include "study/sweep/axis.hpp"

namespace corpuscle::sweeps {

class NetlistFactory {
    struct Files;
    std::string name_, folder_, file_, directives_;
    bool is_embedded_ = false;
    std::vector<circuit::NetlistOverride> overrides_;
    struct VariedParameter {
        std::string name;
        std::size_t axis;
        std::vector<std::string> labels;
    };
    std::vector<VariedParameter> varied_;
    std::vector<std::string> saved_curves_;
    std::shared_ptr<Files> files_;

    Result<std::string> text_of(const std::string& path) const;
    Result<circuit::Netlist> open(const std::string& corner) const;
    Result<circuit::Netlist> with_overrides(std::span<const circuit::NetlistOverride>) const;

public:
    /// "sa1-circuit", a path relative to the folder, or the path of an embedded netlist. `directives` replace the netlist's.
    static Result<NetlistFactory> of(const LocatedText& name, const std::string& folder, const std::string& directives = "");

    const std::string& name() const { return name_; }
    Result<void> set(const LocatedSetting&);
    Result<VariedQuantity> find_quantity(const LocatedText& quantity) const;
    void vary(const std::string& quantity, std::size_t axis, std::vector<std::string> labels);
    bool varies() const { return !varied_.empty(); }
    /// Replaces every .save.
    void save(std::vector<std::string> curves) { saved_curves_ = std::move(curves); }

    /// Without varied values.
    Result<circuit::Netlist> nominal() const { return with_overrides(overrides_); }
    /// The netlist for an item's values. Thread-safe.
    Result<circuit::Netlist> at(std::span<const double> values) const;
    /// The values on which this netlist depends.
    std::vector<double> netlist_values(std::span<const double> values) const;

    /// One entry for every file that was read.
    std::vector<Sweep::MetadataText> metadata() const;
};

/// True if two circuits have the same devices at the same nodes and differ only in numbers.
bool same_devices(const circuit::Circuit&, const circuit::Circuit&);

}  // namespace corpuscle::sweeps
