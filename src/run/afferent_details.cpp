#include "run/afferent_details.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace corpuscle {
namespace {

/// Collects parameters of the same name and unit in one column.
class Columns {
    std::vector<ParameterColumn> columns_;
    std::map<std::pair<std::string_view, std::string_view>, std::size_t> index_;  // by name and unit
    std::map<const void*, std::vector<std::size_t>> known_;                       // the columns of the parameters of plans that share them
    std::size_t afferents_;

    std::size_t column_of(const ParameterInfo& p) {
        const auto [at, is_new] = index_.try_emplace({p.name, p.unit}, columns_.size());
        if (is_new)
            columns_.push_back({std::string(p.name), std::string(p.unit), std::string(p.description),
                                std::vector<double>(afferents_, std::numeric_limits<double>::quiet_NaN())});
        return at->second;
    }

public:
    explicit Columns(std::size_t afferents) : afferents_(afferents) {}

    void set(std::size_t afferent, const AfferentPlan& plan) {
        auto& places = known_[plan.parameters.get()];
        if (places.empty())
            for (const auto& p : *plan.parameters) places.push_back(column_of(p.info));
        for (std::size_t k = 0; k < places.size(); ++k) columns_[places[k]].values[afferent] = plan.values[k];
    }
    std::vector<ParameterColumn> take() { return std::move(columns_); }
};

std::string properties_of(const AfferentPlan& plan) {
    std::vector<std::string> out;
    for (const auto& [name, value] : plan.factory->labels(plan)) out.push_back(fmt::format("{} = {}", name, value));
    return fmt::format("{}", fmt::join(out, ", "));
}

/// A name that is not yet among `taken`, to which it is added. NWB takes a name that ends in "_index" for that of an index.
std::string free_name(std::string name, std::set<std::string>& taken) {
    std::replace(name.begin(), name.end(), '/', '-');
    while (name.ends_with("_index") || taken.contains(name)) name += "_parameter";
    taken.insert(name);
    return name;
}

}  // namespace

AfferentDetails details_of(const PlanTable& table) {
    AfferentDetails out;
    std::vector<std::string> models, properties;  // of each plan
    for (const auto& plan : table.plans) models.push_back(plan.composition()), properties.push_back(properties_of(plan));
    Columns columns(table.plan_of.size());
    for (std::size_t u = 0; u < table.plan_of.size(); ++u) {
        const auto p = table.plan_of[u];
        out.models.push_back(models[p]), out.properties.push_back(properties[p]);
        columns.set(u, table.plans[p]);
    }
    out.parameters = columns.take();
    return out;
}

std::vector<NwbColumn> nwb_columns(AfferentNames afferents, AfferentDetails details) {
    std::vector<NwbColumn> out = {
        {"afferent", "name of the afferent", std::move(afferents.names)},
        {"afferent_type", "afferent or class, without the number of the copy", std::move(afferents.types)},
        {"channel", afferents.x.empty() ? "channel of the force" : "region of the skin", std::move(afferents.channels)},
        {"model", "components of the model", std::move(details.models)},
        {"model_properties", "properties of the model that are not numbers", std::move(details.properties)}};
    if (!afferents.x.empty()) {
        out.push_back({"x", "position in the skin, m", {}, std::move(afferents.x)});
        out.push_back({"y", "position in the skin, m", {}, std::move(afferents.y)});
    }
    std::set<std::string> taken = {"id",          "spike_times", "obs_intervals", "electrodes", "electrode_group", "waveform_mean",
                                   "waveform_sd", "waveforms"};
    for (const auto& c : out) taken.insert(c.name);
    for (auto& p : details.parameters)
        out.push_back({free_name(p.name, taken),
                       fmt::format("parameter {}{}: {}", p.name, p.unit.empty() ? "" : fmt::format(" ({})", p.unit), p.description),
                       {},
                       std::move(p.values)});
    return out;
}

}  // namespace corpuscle
