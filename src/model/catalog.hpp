#pragma once
// The components that can come before a receptor, the named afferents, and the plan of an afferent. To add a sensor, transducer or
// converter, add its include and its name here.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter_override.hpp"
#include "model/chain.hpp"
#include "model/models.hpp"
#include "model/sensor/adc.hpp"
#include "model/sensor/f2i.hpp"
#include "model/sensor/f2v.hpp"
#include "model/sensor/fsr.hpp"

namespace corpuscle {

/// A list of components that can come before a receptor. They are computed in double only, not on lanes.
template <class... M>
struct ComponentList {};
/// The type of a component, to be passed to a function.
template <class M>
struct ComponentTag {};
/// Calls f with the tag of each component of the list.
template <class... M, class F>
void for_each_type(ComponentList<M...>, const F& f) {
    (f(ComponentTag<M>{}), ...);
}

using Sensors = ComponentList<Fsr>;
using Transducers = ComponentList<F2v, F2i>;
using Converters = ComponentList<Adc>;

/// An afferent with a name of its own: its receptor, its neuron, and the parameters whose values differ from the defaults of these models.
struct NamedAfferent {
    std::string_view name, receptor, neuron;
    std::vector<Setting> settings;
    std::vector<std::string_view> aliases;  ///< other names that the user may type, in upper or lower case
    std::string_view description, source;
    std::string_view front_end = {};  ///< sensor, transducer and converter before the receptor: "fsr+f2v+adc"; "": none
};
const std::vector<NamedAfferent>& named_afferents();

std::vector<CatalogEntry> sensor_entries();  ///< each entry includes the parameter of the calibration, F_cal
std::vector<CatalogEntry> transducer_entries();
std::vector<CatalogEntry> converter_entries();
std::vector<CatalogEntry> receptor_entries();
std::vector<CatalogEntry> neuron_entries();

/// One parameter of an afferent.
struct AfferentParameter {
    ParameterInfo info;
    std::string_view component;  ///< the component that the parameter belongs to
    bool set_by_user = false;    ///< true if an override has set the value
};

/// A constraint on an afferent's parameters: the value of `lower` must be below the value of `upper`.
struct ParameterOrder {
    std::string_view lower, upper;  ///< names of parameters
    bool or_equal = false;          ///< true: the two values may also be equal
};

/// A complete description of an afferent, before its sampling interval is known.
struct AfferentPlan {
    std::string name;  ///< the name that outputs show: "sa1", "sa1b+izhikevich"
    std::string_view receptor, neuron, description, source;
    std::shared_ptr<const std::vector<AfferentParameter>> parameters;  ///< descriptions of the parameters, shared by all copies
    std::vector<double> values;                                        ///< values of the parameters, in the same order; SI
    double min_rate = 0;                                               ///< Hz; below this sampling rate the response is not reliable
    std::string_view sensor = {}, transducer = {}, converter = {};     ///< "": the afferent has none
    std::uint32_t copy_number = 0;                                     ///< number among the copies of one original, from 1; 0: not a copy
    std::string original_name = {};                                    ///< of a copy: the name of the original; otherwise empty
    /// Set if the afferent is not made of model equations but, for example, a circuit; receptor and neuron are then empty.
    std::shared_ptr<const AfferentFactory> factory = {};
    /// The value of the parameter with this name; no value if the afferent has no such parameter.
    std::optional<double> value(std::string_view parameter) const;
    std::string composition() const;  ///< the components, "fsr+f2v+adc+sa1a+lif-a", or the kind of the factory, "netlist"
};

/// True if `name`, the target of an override, means this plan: if it is the plan's name, an alias of it, or `requested`, the text from
/// which the user had the plan made.
bool matches_name(const AfferentPlan&, std::string_view requested, std::string_view name);

/// All order constraints on a plan's parameters.
std::vector<ParameterOrder> order_constraints_of(const AfferentPlan&);

/// Checks everything about the parameters except the range of each one: that order constraints hold, that integer parameters are integers,
/// that the front end can measure its range of force, and that fixed-point words are long enough.
Result<void> check_plan(const AfferentPlan&);

/// The names and values of a plan's parameters, as with_settings() takes them.
std::vector<Setting> settings_of(const AfferentPlan&);

/// Makes the plan of the afferent that `text` specifies: "sa1", "SA1", "sa1b+izhikevich", "fsr+f2i+sa1". Applies the overrides whose target
/// is `text`, the plan's name or an alias, and marks them used; other overrides are ignored.
Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides);

/// Builds the afferent of a plan. The plan must have passed check_plan().
std::unique_ptr<Afferent> make_afferent(const AfferentPlan&, const SimulationOptions&);

}  // namespace corpuscle
