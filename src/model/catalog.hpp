#pragma once
// What can stand before a transduction, and the afferents that have a name. To add a sensor: its include and its name here.

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
#include "signal/settings.hpp"

namespace corpuscle {

/// What stands before a transduction; these know no kind of number but double.
template <class... M>
struct PartList {};
template <class M>
struct Part {};
template <class... M, class F>
void each(PartList<M...>, const F& f) {
    (f(Part<M>{}), ...);
}

using Sensors = PartList<Fsr>;
using Transducers = PartList<F2v, F2i>;
using Converters = PartList<Adc>;

/// An afferent with a name: a transduction, a neuron, and the parameters that differ from theirs.
struct NamedAfferent {
    std::string_view name, receptor, neuron;
    std::vector<Setting> settings;
    std::vector<std::string_view> other_names;  ///< accepted in any case
    std::string_view sentence, source;
    std::string_view front = {};  ///< sensor, transducer, converter before it
};
const std::vector<NamedAfferent>& named_afferents();

std::vector<Card> sensor_cards();  ///< each with its calibration's rows
std::vector<Card> transducer_cards();
std::vector<Card> converter_cards();
std::vector<Card> receptor_cards();
std::vector<Card> neuron_cards();

/// One parameter of an afferent.
struct Parameter {
    Row row;
    std::string_view of;  ///< the part it belongs to
    bool set = false;     ///< by the user
};

/// Of two parameters of an afferent, one must stay below the other.
struct Order {
    std::string_view lesser, greater;
    bool or_equal = false;
};

/// What an afferent is, before it is given a clock.
struct AfferentPlan {
    std::string name;  ///< as asked for: "sa1", "sa1b+izhikevich"
    std::string_view receptor, neuron, sentence, source;
    std::shared_ptr<const std::vector<Parameter>> parameters;       ///< what they are; copies share it
    std::vector<double> values;                                     ///< of each parameter, SI
    double least_rate = 0;                                          ///< Hz; below it the answer is not to be trusted
    std::string_view sensor = {}, transducer = {}, converter = {};  ///< "": there is none
    std::uint32_t copy = 0;                                         ///< its number among its copies, from 1; 0: it is none
    std::string of = {};                                            ///< the name of what it is a copy of
    std::shared_ptr<const Design> design = {};                      ///< what it is, where no model is: then there is no neuron either
    std::optional<double> value(std::string_view parameter) const;
    std::string made_of() const;  ///< "fsr+f2v+adc+sa1a+lif-a"
};

/// Whether the plan that was asked for as `asked` goes by this name.
bool goes_by(const AfferentPlan&, std::string_view asked, std::string_view name);

/// Which of its parameters must stand in which order.
std::vector<Order> orders_of(const AfferentPlan&);

/// What the rows alone cannot say: orders, whole numbers, a front that cannot measure its own range, words too short.
std::optional<Error> refusal(const AfferentPlan&);

/// The values of a plan's parameters, for `with`.
std::vector<Setting> settings_of(const AfferentPlan&);

/// Reads "sa1", "SA1", "sa1b+izhikevich", "fsr+f2i+sa1"; wishes name it as it was asked for or by its own name.
Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const Wish> wishes);

/// The afferent of a plan, for samples T = run.dt apart.
std::unique_ptr<Afferent> make_afferent(const AfferentPlan&, const Run&);

}  // namespace corpuscle
