#pragma once
// The netlist of a sweep in all its variety: what is set of it, what varies, and the files that it is read from, once.

#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "circuit/knobs.hpp"
#include "study/sweep/axis.hpp"

namespace corpuscle::sweeps {

class NetlistMaker {
    struct Files;
    std::string name_, folder_, file_, orders_;
    bool carried_ = false;
    std::vector<circuit::Knob> set_;
    struct Varied {
        std::string knob;
        std::size_t axis;
        std::vector<std::string> words;
    };
    std::vector<Varied> varied_;
    std::vector<std::string> saved_;
    std::shared_ptr<Files> files_;

    Result<std::string> text_of(const std::string& path) const;
    Result<circuit::Netlist> open(const std::string& corner) const;
    Result<circuit::Netlist> tuned(std::span<const circuit::Knob>) const;

public:
    /// "sa1-circuit", a path as seen from the folder, or that of a netlist that the program carries; `orders` go in place of its own.
    static Result<NetlistMaker> of(const Said& name, const std::string& folder, const std::string& orders = "");

    const std::string& name() const { return name_; }
    Result<void> set(const SaidSetting&);
    Result<Target> target(const Said& what) const;
    void vary(const std::string& what, std::size_t axis, std::vector<std::string> words);
    bool varies() const { return !varied_.empty(); }
    /// Saved in place of every .save.
    void save(std::vector<std::string> curves) { saved_ = std::move(curves); }

    /// With nothing varied.
    Result<circuit::Netlist> nominal() const { return tuned(set_); }
    /// For the values of a unit; from several threads at once.
    Result<circuit::Netlist> at(std::span<const double> values) const;
    /// Those of the values that it depends on.
    std::vector<double> own(std::span<const double> values) const;

    /// Every file that was read.
    std::vector<Sweep::Fact> facts() const;
};

/// Two circuits with the same devices at the same nodes: what differs is numbers.
bool same_devices(const circuit::Circuit&, const circuit::Circuit&);

}  // namespace corpuscle::sweeps
