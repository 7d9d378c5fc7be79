#pragma once
// The named afferents, the catalogue of models and components, and the plan of an afferent of equations.

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// An afferent with a name of its own: its receptor, its neuron, and the parameters whose values differ from the defaults of these models.
struct NamedAfferent {
    std::string_view name, receptor, neuron;
    std::vector<Setting> settings;
    std::vector<std::string_view> aliases;  ///< other names that the user may type, in upper or lower case
    std::string_view description, source;
    std::string_view front_end = {};  ///< sensor, transducer and converter before the receptor: "fsr+f2v+adc"; "": none
    double min_rate = 0;              ///< Hz, see AfferentPlan::min_rate; 0: that of the receptor
};
const std::vector<NamedAfferent>& named_afferents();

std::vector<CatalogEntry> sensor_entries();  ///< each entry includes the parameter of the calibration, F_cal
std::vector<CatalogEntry> transducer_entries();
std::vector<CatalogEntry> converter_entries();
std::vector<CatalogEntry> receptor_entries();
std::vector<CatalogEntry> neuron_entries();

/// The names of components that an afferent has, "fsr+f2v", without those that are "".
std::string join_components(std::initializer_list<std::string_view> names);

/// The text that specifies an afferent, such as "fsr+f2v+adc+sa1a+lif-a", as components, in the order in which the signal passes them.
struct AfferentComponents {
    std::string_view sensor, transducer, converter;  ///< "": the afferent has none
    const NamedAfferent* named = nullptr;            ///< null if the text names a receptor and a neuron instead of an afferent
    std::string_view receptor, neuron;               ///< those of the named afferent, if there is one

    /// The components before the receptor: "fsr+f2v+adc", or "".
    std::string front_end() const { return join_components({sensor, transducer, converter}); }
};

/// Parses a text such as "fsr+f2v+sa1". The front end of a named afferent, if it has one, is among the components.
Result<AfferentComponents> parse_components(std::string_view text);

/// True if `name`, the target of an override, means this plan: if it is the plan's name, or a text that specifies the same afferent.
bool matches_name(const AfferentPlan&, std::string_view name);

/// All order constraints on a plan's parameters.
std::vector<ParameterOrder> order_constraints_of(const AfferentPlan&);

/// Checks everything about the parameters except the range of each one: that order constraints hold, that integer parameters are integers,
/// that the front end can measure its range of force, and that fixed-point words are long enough.
Result<void> check_plan(const AfferentPlan&);

/// Reads the text that specifies an afferent of equations: "sa1", "SA1", "sa1b+izhikevich", "fsr+f2i+sa1".
Result<std::shared_ptr<const AfferentSpec>> read_model_spec(std::string_view text);

/// The plan of the afferent that `text` specifies, with the overrides applied whose target is `text`, the plan's name or an alias.
Result<AfferentPlan> plan_afferent(std::string_view text);
Result<Applied<AfferentPlan>> plan_afferent(std::string_view text, std::span<const ParameterOverride> overrides);

}  // namespace corpuscle
