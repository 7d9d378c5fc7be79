#pragma once
// The plan of an afferent: everything that is known about it before its sampling interval; and its specification by the user. Equations
// (model/catalog.cpp) and netlists (circuit/afferent/netlist_plan.cpp) are specified differently, and run/afferent_plan.cpp reads the text
// of either. Other code asks the plan's factory what it needs to know; it never asks which of the two it has.

#include <nlohmann/json_fwd.hpp>

#include "core/afferent.hpp"
#include "core/parameter_override.hpp"
#include "core/simulation_options.hpp"

namespace corpuscle {

struct AfferentPlan;

/// Properties of an afferent on which its treatment depends.
struct AfferentTraits {
    bool can_use_lanes = true;              ///< its equations can run on SIMD lanes, without noise
    bool can_search_factor = true;          ///< it is quick enough to be simulated again and again with stronger forces
    bool may_diverge = false;               ///< its solver may fail to converge; the run then continues without it
    bool is_implementation = false;         ///< it implements a model, as a circuit does, and is compared with models of its type
    bool ignores_case = false;              ///< of the names of its parameters
    bool is_irregular = false;              ///< its spikes depend on SimulationOptions::seed even without noise
    std::string_view lane_obstacles = {};   ///< for messages: the properties of such afferents that prevent lanes, "netlists"
    std::string_view spike_probe = {};      ///< of a circuit: the quantity that spikes when it crosses spike_level; it need not be a probe
    double spike_level = 0;                 ///< V or A
    std::string_view reason_no_chips = {};  ///< why all its chips are equal although they were requested; "" if they differ, or were not
    std::string_view reason_no_noise = {};  ///< why SimulationOptions::noise has no effect; "" if it has one
};

/// Makes the afferents of a plan, and describes them. One object serves all copies that differ only in their values.
class AfferentFactory {
public:
    AfferentFactory() = default;
    AfferentFactory(const AfferentFactory&) = delete;
    AfferentFactory& operator=(const AfferentFactory&) = delete;
    virtual ~AfferentFactory() = default;

    /// Creates an afferent. The plan must be valid.
    virtual std::unique_ptr<Afferent> make(const AfferentPlan&, const SimulationOptions&) const = 0;
    virtual AfferentTraits traits(const AfferentPlan&) const = 0;
    /// The components, "fsr+f2v+adc+sa1a+lif-a", or "netlist".
    virtual std::string composition(const AfferentPlan&) const = 0;
    /// Properties that are not numbers, as pairs of name and value: {"receptor", "sa1b"}, {"corner", "ss"}.
    virtual std::vector<std::pair<std::string, std::string>> labels(const AfferentPlan&) const = 0;
    /// The factory for a copy of `original` whose values have been changed; null: the same factory serves the copy.
    virtual Result<std::shared_ptr<const AfferentFactory>> rebuilt(const AfferentPlan& copy, const AfferentPlan& original) const;
    /// Power, area and leakage at rest under a force (N), and the mean power over `used` if its time is not 0; null if they are not known.
    virtual nlohmann::ordered_json cost(double rest_force, const EnergyUse& used) const;
    /// The values that overrides can set beside the plan's parameters; empty for equations.
    virtual Result<std::vector<SettableValue>> settable_values() const { return std::vector<SettableValue>(); }
    /// A drawing of the circuit as SVG. `block`: "" for its top level, or the name of a block, "summer". An error for equations.
    virtual Result<std::string> schematic(std::string_view block) const;
};

/// One parameter of an afferent.
struct AfferentParameter {
    ParameterInfo info;
    std::string_view component;  ///< the component that the parameter belongs to
    bool set_by_user = false;    ///< true if an override has set the value
};

/// A complete description of an afferent, before its sampling interval is known.
struct AfferentPlan {
    std::string name;                                                  ///< the name that outputs show: "sa1", "sa1b+izhikevich"
    std::string_view receptor, neuron, description, source;            ///< receptor, neuron: "" if it is not made of model equations
    std::shared_ptr<const std::vector<AfferentParameter>> parameters;  ///< descriptions of the parameters, shared by all copies
    std::vector<double> values;                                        ///< values of the parameters, in the same order; SI
    double min_rate = 0;                                               ///< Hz; below this sampling rate the response is not reliable
    std::string_view sensor = {}, transducer = {}, converter = {};     ///< "": the afferent has none
    std::uint32_t copy_number = 0;                                     ///< number among the copies of one original, from 1; 0: not a copy
    std::string original_name = {};                                    ///< of a copy: the name of the original; otherwise empty
    std::shared_ptr<const AfferentFactory> factory = {};               ///< makes its afferents; never null in a plan that is used

    /// The value of the parameter with this name; no value if the afferent has no such parameter.
    std::optional<double> value(std::string_view parameter) const;
    std::string composition() const { return factory->composition(*this); }  ///< see AfferentFactory
    AfferentTraits traits() const { return factory->traits(*this); }
};

/// The declarations of a plan's parameters.
std::vector<ParameterInfo> parameter_infos(const AfferentPlan&);

/// Sets values of a plan. The parameters must exist.
void set_values(AfferentPlan&, std::span<const Setting>);

/// A probe that the user requests, and what became of it.
struct RequestedProbe {
    std::optional<std::string> name;  ///< its name among Afferent::probes(); no value: the afferent has no such probe
    std::string hint;                 ///< in that case: a similar name, "; did you mean 'vf'?", or the first names
};

/// A plan with the overrides that are for it.
struct PlannedAfferent : Applied<AfferentPlan> {
    std::vector<RequestedProbe> probes;  ///< one for each requested probe; empty if the probes of this afferent cannot be selected
};

/// Builds the afferent of a plan. The plan must be valid; see check_plan() in model/catalog.hpp.
inline std::unique_ptr<Afferent> make_afferent(const AfferentPlan& plan, const SimulationOptions& options) {
    return plan.factory->make(plan, options);
}

/// The specification of an afferent: the text of the user, already read, without the overrides.
class AfferentSpec {
    std::string text_;

public:
    explicit AfferentSpec(std::string_view text) : text_(text) {}
    AfferentSpec(const AfferentSpec&) = delete;
    AfferentSpec& operator=(const AfferentSpec&) = delete;
    virtual ~AfferentSpec() = default;

    /// The text: "SA1", "sa1b+izhikevich", "path/own.cir". It is one of the targets of overrides for this afferent.
    const std::string& text() const { return text_; }
    /// Plans the afferent with the overrides that are for it. `probes`: recorded instead of the .save quantities of a netlist that has at
    /// least one of them.
    virtual Result<PlannedAfferent> plan(std::span<const ParameterOverride>, std::span<const std::string> probes) const = 0;
};

}  // namespace corpuscle
