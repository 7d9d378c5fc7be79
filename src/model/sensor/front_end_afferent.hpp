#pragma once
// An afferent behind a sensor. Its input is not the force, but the calibrated reading of the sensor. Any afferent can be used, unchanged.

#include <memory>

#include "model/sensor/front_end.hpp"

namespace corpuscle {

class FrontEndAfferent final : public Afferent {
    FrontEnd front_end_;
    std::unique_ptr<Afferent> inner_;
    std::string name_, inner_format_, format_;
    std::vector<Probe> probes_;  // those of the front end, the calibrated force, those of the inner afferent
    std::size_t inner_values_;

    std::vector<double> calibrated_block(std::span<const double> force, State&, ResponseBlock&) const;

public:
    FrontEndAfferent(FrontEnd, std::unique_ptr<Afferent>);
    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override;
    Result<void> respond(std::span<const double> force, State&, ResponseBlock&) const override;
};

}  // namespace corpuscle
