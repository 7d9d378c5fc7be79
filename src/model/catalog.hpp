#pragma once
// The components that can come before a receptor, and the named afferents. To add a sensor, add its include and its name here.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/chain.hpp"
#include "model/models.hpp"
#include "model/sensor/adc.hpp"
#include "model/sensor/f2i.hpp"
#include "model/sensor/f2v.hpp"
#include "model/sensor/fsr.hpp"
#include "signal/parameter_override.hpp"

namespace corpuscle {

/// A list of components that can come before a receptor. They are computed in double only, not on lanes.
template <class... M>
struct ComponentList {};
template <class M>
struct ComponentTag {};
template <class... M, class F>
void for_each_type(ComponentList<M...>, const F& f) {
    (f(ComponentTag<M>{}), ...);
}

using Sensors = ComponentList<Fsr>;
using Transducers = ComponentList<F2v, F2i>;
using Converters = ComponentList<Adc>;

/// An afferent with a name: a receptor, a neuron, and the parameters that differ from their defaults.
struct NamedAfferent {
    std::string_view name, receptor, neuron;
    std::vector<Setting> settings;
    std::vector<std::string_view> aliases;  ///< matched without regard to case
    std::string_view description, source;
    std::string_view front_end = {};  ///< sensor, transducer and converter before it: "fsr+f2v+adc"
};
const std::vector<NamedAfferent>& named_afferents();

std::vector<CatalogEntry> sensor_entries();  ///< each includes the parameters of its calibration
std::vector<CatalogEntry> transducer_entries();
std::vector<CatalogEntry> converter_entries();
std::vector<CatalogEntry> receptor_entries();
std::vector<CatalogEntry> neuron_entries();

/// One parameter of an afferent.
struct AfferentParameter {
    ParameterInfo info;
    std::string_view component;  ///< the component that it belongs to
    bool set_by_user = false;
};

/// The first of two parameters of an afferent must be below the second.
struct ParameterOrder {
    std::string_view lower, upper;
    bool or_equal = false;
};

/// A complete description of an afferent, before its sampling interval is known.
struct AfferentPlan {
    std::string name;  ///< in outputs: "sa1", "sa1b+izhikevich"
    std::string_view receptor, neuron, description, source;
    std::shared_ptr<const std::vector<AfferentParameter>> parameters;  ///< descriptions of the parameters, shared by all copies
    std::vector<double> values;                                        ///< of each parameter, SI
    double min_rate = 0;                                               ///< Hz; below this sampling rate the response is not reliable
    std::string_view sensor = {}, transducer = {}, converter = {};     ///< "": none
    std::uint32_t copy_number = 0;                                     ///< number among its copies, from 1; 0: not a copy
    std::string original_name = {};                                    ///< of a copy: the name of the original
    /// Set if the afferent is not made of model equations but, for example, a circuit; receptor and neuron are then empty.
    std::shared_ptr<const AfferentFactory> factory = {};
    std::optional<double> value(std::string_view parameter) const;
    std::string composition() const;  ///< "fsr+f2v+adc+sa1a+lif-a"
};

/// True if `name` refers to the plan that was requested as `requested`.
bool matches_name(const AfferentPlan&, std::string_view requested, std::string_view name);

/// The pairs of a plan's parameters whose order is constrained.
std::vector<ParameterOrder> order_constraints_of(const AfferentPlan&);

/// Checks conditions beyond the range of a single parameter: order constraints, integers, whether the front end can measure its range of
/// force, and whether fixed-point words are long enough.
Result<void> check_plan(const AfferentPlan&);

/// The values of a plan's parameters, as with_settings() takes them.
std::vector<Setting> settings_of(const AfferentPlan&);

/// Parses "sa1", "SA1", "sa1b+izhikevich", "fsr+f2i+sa1". Overrides may use the requested name or the plan's own name.
Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides);

/// Builds the afferent of a plan, for the sampling interval in the options.
std::unique_ptr<Afferent> make_afferent(const AfferentPlan&, const SimulationOptions&);

}  // namespace corpuscle
